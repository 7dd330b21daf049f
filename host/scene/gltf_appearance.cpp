// How a material of a glTF file looks: Sahl's metallicRoughness, whose parameters are the format's.
#include "scene/gltf_scene.h"
#include "scene/numbers.h"
#include "scene/phong.h"
#include "scene/texture.h"

#include <algorithm>

namespace sahl {

namespace {

/// Adds the texture of one use; NO_TEXTURE where there is none.
uint32_t addTextureOf(Scene& scene, const GltfModel& model,
                      const std::optional<GltfTextureUse>& use, bool srgb, double strength = 1)
{
    if (!use) return NO_TEXTURE;
    const GltfTexture& texture = model.textures[use->texture];
    const GltfImage& image = model.images[*texture.image];
    TextureLook look;
    look.srgb = srgb;
    look.clampS = texture.clampS;
    look.clampT = texture.clampT;
    look.nearest = texture.nearest;
    look.strength = strength;
    // The file's map is for coordinates with v down, (u, 1 - v), and gives such ones.
    const glm::dmat2& m = use->linear;
    look.rowS = {m[0][0], -m[1][0], m[1][0] + use->offset.x};
    look.rowT = {-m[0][1], m[1][1], 1 - m[1][1] - use->offset.y};
    const StoredPicture picture =
        image.bytes.empty()
            ? pictureOfFile(scene, image.file)
            : pictureOnce(scene, image.what, [&] { return decodeTexels(image.what, image.bytes); });
    return addTexture(scene, picture, look);
}

/// A texture's alpha is compared without the factor before it.
float cutoffOf(const GltfMaterial& material)
{
    constexpr double ABOVE_ALL = 2;
    if (!(material.alphaCutoff > 0)) return 0;
    return toFloat(material.alpha > 0 ? std::min(material.alphaCutoff / material.alpha, ABOVE_ALL)
                                      : ABOVE_ALL);
}

}  // namespace

uint32_t addGltfMaterial(Scene& scene, const GltfModel& model, const GltfMaterial& material)
{
    Material result = {};
    result.baseColor = toFloat(material.baseColor);
    result.emission = toFloat(material.emission);
    result.eta = toFloat(material.eta);
    result.roughness = toFloat(material.roughness);
    result.metallic = toFloat(material.metallic);
    result.transmission = toFloat(material.transmission);
    result.alphaCutoff = cutoffOf(material);
    result.baseColorTexture = addTextureOf(scene, model, material.baseColorTexture, true);
    result.roughnessTexture = addTextureOf(scene, model, material.roughnessTexture, false);
    result.normalTexture =
        addTextureOf(scene, model, material.normalTexture, false, material.normalStrength);
    result.emissionTexture = addTextureOf(scene, model, material.emissionTexture, true);
    result.type = MATERIAL_METALLIC_ROUGHNESS;
    setPhongDefaults(result);
    return addMaterial(scene, material.name, result);
}

}  // namespace sahl
