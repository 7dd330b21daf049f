// The materials of a glTF file: metallic-roughness, with emission, index of refraction and
// transmission.
#include "scene/angles.h"
#include "scene/gltf_model.h"
#include "scene/scene_reading.h"

namespace sahl {

namespace {

constexpr Range SHARE = {0, 1};
constexpr double MAX_ETA = 4;  // of Sahl's metallicRoughness
constexpr double DEG_PER_RAD = 57.29577951308232087680;

/// KHR_texture_transform: coordinates are scaled, turned and moved, in this order.
void readTextureTransform(const JsonObject& transform, GltfTextureUse& use)
{
    const std::vector<double> scale = numbersOf(transform, "scale", {1, 1});
    const std::vector<double> offset = numbersOf(transform, "offset", {0, 0});
    const double angle = transform.number("rotation", 0, {-1e4, 1e4}) * DEG_PER_RAD;
    const double c = cosDeg(angle), s = sinDeg(angle);
    use.linear = glm::dmat2({c * scale[0], -s * scale[0]}, {s * scale[1], c * scale[1]});
    use.offset = {offset[0], offset[1]};
    use.texCoord = transform.uint("texCoord", use.texCoord, 0, 0xffffu);
}

std::optional<GltfTextureUse> readTextureUse(const GltfModel& model, const JsonObject& object,
                                             const std::string& key)
{
    const auto info = childOf(object, key);
    if (!info) return std::nullopt;
    GltfTextureUse use;
    use.texture = requiredIndex(*info, "index", model.textures.size(), "textures");
    use.texCoord = info->uint("texCoord", 0, 0, 0xffffu);
    if (const auto transform = extensionOf(*info, "KHR_texture_transform"))
        readTextureTransform(*transform, use);
    const bool isRead = model.textures[use.texture].image.has_value();
    return isRead ? std::optional(use) : std::nullopt;
}

void readMetallicRoughness(const GltfModel& model, const JsonObject& object, GltfMaterial& material)
{
    const auto pbr = childOf(object, "pbrMetallicRoughness");
    if (!pbr) return;
    const std::vector<double> color = numbersOf(*pbr, "baseColorFactor", {1, 1, 1, 1}, SHARE);
    material.baseColor = {color[0], color[1], color[2]};
    material.alpha = color[3];
    material.metallic = pbr->number("metallicFactor", 1, SHARE);
    material.roughness = pbr->number("roughnessFactor", 1, SHARE);
    material.baseColorTexture = readTextureUse(model, *pbr, "baseColorTexture");
    material.roughnessTexture = readTextureUse(model, *pbr, "metallicRoughnessTexture");
}

void readEmission(GltfModel& model, const JsonObject& object, GltfMaterial& material)
{
    material.emission = object.vector("emissiveFactor", glm::dvec3(0.0), SHARE);
    material.emissionTexture = readTextureUse(model, object, "emissiveTexture");
    if (const auto strength = extensionOf(object, "KHR_materials_emissive_strength"))
        material.emission *= strength->number("emissiveStrength", 1, LIGHT_RANGE);
}

void readAlpha(GltfModel& model, const JsonObject& object, GltfMaterial& material)
{
    const std::string mode = object.choice("alphaMode", {"OPAQUE", "MASK", "BLEND"});
    const double cutoff = object.number("alphaCutoff", 0.5, {0, 1e30});
    if (mode == "MASK") material.alphaCutoff = cutoff;
    if (mode == "BLEND")
        leaveOut(model.file, "alphaMode BLEND is not read: what it covers is opaque");
}

void readRefraction(GltfModel& model, const JsonObject& object, GltfMaterial& material)
{
    if (const auto ior = extensionOf(object, "KHR_materials_ior")) {
        material.eta = ior->number("ior", 1.5, {0, 1e6});
        if (material.eta < 1) {
            if (material.eta > 0) {
                throw errorAt(ior->document(), ior->at("ior"),
                              fmt::format("{}: ior is {}; it must be 0 or at least 1", ior->what(),
                                          material.eta));
            }
            material.eta = 1.5;
            leaveOut(model.file, "an ior of 0 is not read; 1.5 is used");
        }
        if (material.eta > MAX_ETA) {
            material.eta = MAX_ETA;
            leaveOut(model.file, "an ior above 4 is not read; 4 is used");
        }
    }
    const auto transmission = extensionOf(object, "KHR_materials_transmission");
    if (!transmission) return;
    material.transmission = transmission->number("transmissionFactor", 0, SHARE);
    if (readTextureUse(model, *transmission, "transmissionTexture"))
        leaveOut(model.file, "textures of transmission are left out");
}

/// Meshes keep one set of texture coordinates for each material.
void warnAboutSets(GltfModel& model, const GltfMaterial& material)
{
    std::optional<uint32_t> first;
    for (const auto* use : material.textures()) {
        if (!*use) continue;
        if (first.value_or((*use)->texCoord) != (*use)->texCoord) {
            leaveOut(model.file,
                     "textures of one material use different sets of texture coordinates: "
                     "the first one's set is used");
        }
        if (!first) first = (*use)->texCoord;
    }
}

GltfMaterial readMaterial(GltfModel& model, const JsonNode& node, size_t index)
{
    const JsonObject object(model.file.document, node, fmt::format("material {}", index));
    GltfMaterial material;
    material.name = object.string("name", fmt::format("material {}", index));
    readMetallicRoughness(model, object, material);
    readEmission(model, object, material);
    readAlpha(model, object, material);
    readRefraction(model, object, material);
    material.normalTexture = readTextureUse(model, object, "normalTexture");
    if (const auto normal = childOf(object, "normalTexture"))
        material.normalStrength = normal->number("scale", 1, {-1e6, 1e6});
    readTextureUse(model, object,
                   "occlusionTexture");  // checked; a path tracer finds what it tells
    object.boolean("doubleSided", false);
    warnAboutSets(model, material);
    return material;
}

}  // namespace

void readGltfMaterials(GltfModel& model)
{
    const auto& items = itemsOf(model.file.root(), "materials");
    for (size_t i = 0; i < items.size(); i++)
        model.materials.push_back(readMaterial(model, items[i], i));
    model.materials.emplace_back().name = "default";
}

}  // namespace sahl
