// A glTF file with a bit of everything that is read.
#pragma once

#include "image/image.h"
#include "support/gltf_files.h"

namespace sahl::testing {

/// A picture of 4 x 4 texels of many colours, as a PNG file.
inline std::string manyColours()
{
    Image8 image = {4, 4, {}};
    for (uint8_t i = 0; i < 48; i++) image.rgb.push_back(static_cast<uint8_t>(37 * i + 11));
    const std::vector<uint8_t> bytes = encodePng(image, {});
    return {bytes.begin(), bytes.end()};
}

/// Textured squares at three nodes, one of them stretched and mirrored; a metal, a lamp, a spot
/// light and a camera. A GLB file.
inline std::string gltfRoom()
{
    const std::string png = manyColours();
    const std::string buffer = squareBuffer() + bytesOf<float>({0, 0, 2, 0, 2, 2, 0, 2}) + png;
    return glbBytes(
        R"("bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12},
                       {"buffer": 0, "byteOffset": 60, "byteLength": 32}, {"buffer": 0, "byteOffset": 92, "byteLength": )" +
            std::to_string(png.size()) + R"(}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                      {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
                      {"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC2"}],
        "images": [{"bufferView": 3, "mimeType": "image/png"}], "textures": [{"source": 0}],
        "extensionsUsed": ["KHR_lights_punctual", "KHR_texture_transform"],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "intensity": 9, "spot": {"outerConeAngle": 1}}]}},
        "materials": [{"pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0.7, "baseColorTexture":
                         {"index": 0, "extensions": {"KHR_texture_transform": {"rotation": 0.3, "scale": [1.5, 1]}}}},
                       "normalTexture": {"index": 0, "scale": 0.5}},
                      {"pbrMetallicRoughness": {"baseColorFactor": [0.9, 0.6, 0.3, 1], "roughnessFactor": 0.2}},
                      {"emissiveFactor": [1, 1, 1]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 2}, "indices": 1, "material": 0}]},
                   {"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 1}]},
                   {"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 2}]}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}],
        "nodes": [{"mesh": 0, "translation": [-1, -0.5, 0]}, {"mesh": 0, "rotation": [0, 0.6, 0, 0.8], "scale": [-1, 2, 1]},
                  {"mesh": 0, "translation": [-2, -1, 2], "rotation": [-0.6, 0, 0, 0.8], "scale": [4, 4, 4]},
                  {"mesh": 1, "translation": [0.2, -0.5, 0.5]}, {"mesh": 2, "translation": [-1, 1.5, -0.5]},
                  {"translation": [0, 0.3, 3], "extensions": {"KHR_lights_punctual": {"light": 0}}, "camera": 0}],
        "scenes": [{"nodes": [0, 1, 2, 3, 4, 5]}])",
        buffer);
}

}  // namespace sahl::testing
