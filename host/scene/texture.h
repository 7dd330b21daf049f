// Textures of a scene: pictures, each stored once, and the ways in which materials look them up.
#pragma once

#include "image/texel_image.h"
#include "scene/scene.h"

#include <array>
#include <functional>
#include <string>

namespace sahl {

/// How a material looks a picture up.
struct TextureLook {
    bool srgb =
        false;  ///< red, green and blue are sRGB-coded: those of colours are, numbers are not
    bool clampS = false, clampT = false;  ///< rather than repeated
    bool nearest = false;                 ///< rather than bilinear
    /// The texture coordinates (u, v), v up, are looked up at (s, t) = (rowS . (u, v, 1), rowT .
    /// (u, v, 1)).
    glm::dvec3 rowS = {1, 0, 0};
    glm::dvec3 rowT = {0, 1, 0};
    double strength = 1;  ///< of a normal map: red and green count so many times
};

/// Stores a picture and returns where it is. Throws badInput naming `name` when the scene's
/// pictures have more than MAX_SCENE_TEXELS together.
StoredPicture storePicture(Scene& scene, const TexelImage& image, const std::string& name);

/// The picture that is stored under `name`; made and stored the first time.
StoredPicture pictureOnce(Scene& scene, const std::string& name,
                          const std::function<TexelImage()>& make);

/// The picture of a file, which is read once.
StoredPicture pictureOfFile(Scene& scene, const fs::path& file);

/// Number for a material's ...Texture, counted from 1, of a texture that looks the picture up in
/// this way. Throws badInput when there are more than MAX_TEXTURES.
uint32_t addTexture(Scene& scene, const StoredPicture& picture, const TextureLook& look);

/// Whether the materials of the scene, as far as they are there, can have a use for texture
/// coordinates.
bool usesTextures(const Scene& scene);

/// The sRGB curve at 0 to 255, of 255, as the bits of floats.
const std::array<uint32_t, SRGB_TABLE_SIZE>& srgbTable();

constexpr uint64_t MAX_SCENE_TEXELS = uint64_t{1} << 30;
constexpr size_t MAX_TEXTURES = 65536;

}  // namespace sahl
