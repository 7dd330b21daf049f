// The textures of a scene file's materials.
#include "scene/numbers.h"
#include "scene/scene_reading.h"
#include "scene/texture.h"

namespace sahl {

namespace {

constexpr Range TEXTURE_SCALE = {-1e6, 1e6};

/// A pair of numbers, or one that stands for both.
glm::dvec2 readPair(const JsonObject& object, const std::string& key, const glm::dvec2& fallback)
{
    const JsonNode* node = object.find(key);
    if (!node) return fallback;
    const std::string what = "\"" + key + "\" of " + object.what();
    const JsonDocument& document = object.document();
    if (node->kind == JsonNode::Kind::number)
        return glm::dvec2(readNumber(document, *node, what, TEXTURE_SCALE));
    const auto& items = readArray(document, *node, what);
    if (items.size() != 2)
        throw errorAt(document, *node,
                      fmt::format("{} needs 2 numbers, found {}", what, items.size()));
    return {readNumber(document, items[0], what, TEXTURE_SCALE),
            readNumber(document, items[1], what, TEXTURE_SCALE)};
}

bool clampsAt(const JsonObject& object, const std::string& key)
{
    return object.choice(key, {"repeat", "clamp"}) == "clamp";
}

/// A texture's object, or the name of its file alone.
///   kind  "colorTexture", "numberTexture" or "normalTexture"
uint32_t readTexture(SceneReading& reading, const JsonNode& node, const std::string& what,
                     const std::string& kind)
{
    const JsonDocument& document = reading.document;
    TextureLook look;
    look.srgb = kind == "colorTexture";
    std::string name;
    if (node.kind == JsonNode::Kind::string) {
        name = node.text;
    } else {
        const JsonObject object(document, node, what, kind);
        name = object.string("file", "");
        look.clampS = clampsAt(object, object.has("wrapU") ? "wrapU" : "wrap");
        look.clampT = clampsAt(object, object.has("wrapV") ? "wrapV" : "wrap");
        look.nearest = object.choice("filter", {"bilinear", "nearest"}) == "nearest";
        const glm::dvec2 scale = readPair(object, "scale", {1, 1});
        const glm::dvec2 offset = readPair(object, "offset", {0, 0});
        look.rowS = {scale.x, 0, offset.x};
        look.rowT = {0, scale.y, offset.y};
        if (kind == "colorTexture")
            look.srgb = object.choice("colorSpace", {"srgb", "linear"}) == "srgb";
        if (kind == "normalTexture") look.strength = object.number("strength", 1, {0, 100});
    }
    const std::string where = document.where(node.offset);
    const fs::path file = resolvePath(reading.policy, reading.folder, name, where);
    std::error_code error;
    if (!fs::exists(file, error))
        throw errorAt(document, node, fmt::format("the file \"{}\" of {} is missing", name, what));
    return addTexture(reading.scene, pictureOfFile(reading.scene, file), look);
}

}  // namespace

void readMaterialTextures(SceneReading& reading, const JsonObject& object, Material& material)
{
    auto read = [&](const char* key, const char* kind) -> uint32_t {
        const JsonNode* node = object.find(key);
        if (!node) return NO_TEXTURE;
        return readTexture(reading, *node, fmt::format("\"{}\" of {}", key, object.what()), kind);
    };
    material.baseColorTexture = read("baseColorTexture", "colorTexture");
    material.emissionTexture = read("emissionTexture", "colorTexture");
    material.roughnessTexture = read("roughnessTexture", "numberTexture");
    material.normalTexture = read("normalTexture", "normalTexture");
    if (!object.has("alphaCutoff")) return;
    material.alphaCutoff = toFloat(object.number("alphaCutoff", 0.5, {0, 1}));
    if (material.baseColorTexture == NO_TEXTURE) {
        throw errorAt(
            object.document(), object.at("alphaCutoff"),
            fmt::format(
                "\"alphaCutoff\" of {} needs a \"baseColorTexture\", whose alpha it is about",
                object.what()));
    }
}

}  // namespace sahl
