#include "saved/struct_json.h"

#include <array>
#include <limits>
#include <variant>

namespace sahl {

namespace {

using Json = nlohmann::ordered_json;

template <class Struct>
struct Field {
    const char* name;
    std::variant<vec3 Struct::*, float Struct::*, uint Struct::*> member;
};

// Every field but `type`, which is a word. A new field of the struct needs a line here.
constexpr std::array MATERIAL_FIELDS = {
    Field<Material>{"baseColor", &Material::baseColor},
    Field<Material>{"eta", &Material::eta},
    Field<Material>{"emission", &Material::emission},
    Field<Material>{"conductorEta", &Material::conductorEta},
    Field<Material>{"diffuseWeight", &Material::diffuseWeight},
    Field<Material>{"conductorK", &Material::conductorK},
    Field<Material>{"specularWeight", &Material::specularWeight},
    Field<Material>{"specularColor", &Material::specularColor},
    Field<Material>{"shininess", &Material::shininess},
    Field<Material>{"ambientColor", &Material::ambientColor},
    Field<Material>{"roughness", &Material::roughness},
    Field<Material>{"metallic", &Material::metallic},
    Field<Material>{"transmission", &Material::transmission},
    Field<Material>{"alphaCutoff", &Material::alphaCutoff},
    Field<Material>{"baseColorTexture", &Material::baseColorTexture},
    Field<Material>{"roughnessTexture", &Material::roughnessTexture},
    Field<Material>{"normalTexture", &Material::normalTexture},
    Field<Material>{"emissionTexture", &Material::emissionTexture},
};
constexpr std::array TEXTURE_FIELDS = {
    Field<Texture>{"firstTexel", &Texture::firstTexel}, Field<Texture>{"width", &Texture::width},
    Field<Texture>{"height", &Texture::height},         Field<Texture>{"flags", &Texture::flags},
    Field<Texture>{"rowS", &Texture::rowS},             Field<Texture>{"strength", &Texture::strength},
    Field<Texture>{"rowT", &Texture::rowT},             Field<Texture>{"mean", &Texture::mean},
};
constexpr std::array LIGHT_FIELDS = {
    Field<Light>{"position", &Light::position}, Field<Light>{"intensity", &Light::intensity},
    Field<Light>{"cosOuter", &Light::cosOuter}, Field<Light>{"direction", &Light::direction},
    Field<Light>{"cosInner", &Light::cosInner},
};

template <class Struct, size_t count>
constexpr size_t bytesOf(const std::array<Field<Struct>, count>& fields)
{
    size_t bytes = 0;
    for (const Field<Struct>& field : fields) {
        bytes +=
            std::holds_alternative<vec3 Struct::*>(field.member) ? sizeof(vec3) : sizeof(float);
    }
    return bytes;
}
constexpr size_t TYPE = sizeof(uint);
constexpr size_t UNUSED_IN_MATERIAL = sizeof(Material::unused0);
constexpr size_t UNUSED_IN_TEXTURE = sizeof(Texture::unused0) + sizeof(Texture::unused1);
// What a light's choice needs is made again when the scene is read.
constexpr size_t MADE_AGAIN_IN_LIGHT = 4 * sizeof(uint);
static_assert(TYPE + bytesOf(MATERIAL_FIELDS) + UNUSED_IN_MATERIAL == sizeof(Material),
              "a field of Material is not saved");
static_assert(TYPE + bytesOf(LIGHT_FIELDS) + MADE_AGAIN_IN_LIGHT == sizeof(Light),
              "a field of Light is not saved");
static_assert(bytesOf(TEXTURE_FIELDS) + UNUSED_IN_TEXTURE == sizeof(Texture),
              "a field of Texture is not saved");

// By their numbers, MATERIAL_* and LIGHT_*.
const std::vector<std::string> MATERIAL_TYPES = {"lambert", "mirror", "dielectric", "conductor",
                                                 "report", "roughConductor", "roughDielectric",
                                                 "thinDielectric", "plastic", "metallicRoughness"};
const std::vector<std::string> LIGHT_TYPES = {"point", "spot", "directional"};

std::string wordOf(uint type, const std::vector<std::string>& words)
{
    if (type < words.size()) return words[type];
    throw badInput("type {} of a material or light has no name to be saved by", type);
}

template <class Struct, size_t count>
void appendFields(Json& json, const Struct& object, const std::array<Field<Struct>, count>& fields)
{
    for (const Field<Struct>& field : fields) {
        if (const auto* scalar = std::get_if<float Struct::*>(&field.member)) {
            json[field.name] = double{object.**scalar};
        } else if (const auto* whole = std::get_if<uint Struct::*>(&field.member)) {
            json[field.name] = object.**whole;
        } else {
            const vec3 v = object.*std::get<vec3 Struct::*>(field.member);
            json[field.name] = {double{v.x}, double{v.y}, double{v.z}};
        }
    }
}

template <class Struct, size_t count>
KeySet keysFor(const std::array<Field<Struct>, count>& fields, std::vector<std::string> more)
{
    KeySet keys = {"", std::move(more), {}};
    for (const Field<Struct>& field : fields) keys.keys.emplace_back(field.name);
    keys.required = keys.keys;
    return keys;
}

template <class Struct, size_t count>
Struct readFields(const JsonObject& json, const std::array<Field<Struct>, count>& fields)
{
    constexpr uint32_t ANY = std::numeric_limits<uint32_t>::max();
    Struct object = {};
    for (const Field<Struct>& field : fields) {
        if (const auto* scalar = std::get_if<float Struct::*>(&field.member)) {
            object.** scalar = static_cast<float>(json.number(field.name, 0, {}));
        } else if (const auto* whole = std::get_if<uint Struct::*>(&field.member)) {
            object.** whole = json.uint(field.name, 0, 0, ANY);
        } else {
            object.*std::get<vec3 Struct::*>(field.member) = vec3(json.vector(field.name, {}));
        }
    }
    return object;
}

/// The same of a struct with a `type`, one of these words.
template <class Struct, size_t count>
Struct readFields(const JsonObject& json, const std::array<Field<Struct>, count>& fields,
                  const std::vector<std::string>& types)
{
    const std::string type = json.string("type", "");
    const auto found = std::find(types.begin(), types.end(), type);
    if (found == types.end()) {
        throw errorAt(
            json.document(), json.at("type"),
            fmt::format("\"type\" of {} is \"{}\", which is not known", json.what(), type));
    }
    Struct object = readFields(json, fields);
    object.type = static_cast<uint>(found - types.begin());
    return object;
}

}  // namespace

Json materialJson(const Material& material, const std::string& name)
{
    Json json = {{"name", name}, {"type", wordOf(material.type, MATERIAL_TYPES)}};
    appendFields(json, material, MATERIAL_FIELDS);
    return json;
}

Json lightJson(const Light& light)
{
    Json json = {{"type", wordOf(light.type, LIGHT_TYPES)}};
    appendFields(json, light, LIGHT_FIELDS);
    return json;
}

Json textureJson(const Texture& texture)
{
    Json json = Json::object();
    appendFields(json, texture, TEXTURE_FIELDS);
    return json;
}

Texture readTextureJson(const JsonDocument& document, const JsonNode& node)
{
    static const KeySet KEYS = keysFor(TEXTURE_FIELDS, {});
    return readFields(JsonObject(document, node, "a texture", KEYS), TEXTURE_FIELDS);
}

Material readMaterialJson(const JsonDocument& document, const JsonNode& node, std::string& name)
{
    static const KeySet KEYS = keysFor(MATERIAL_FIELDS, {"name", "type"});
    const JsonObject json(document, node, "a material", KEYS);
    name = json.string("name", "");
    return readFields(json, MATERIAL_FIELDS, MATERIAL_TYPES);
}

Light readLightJson(const JsonDocument& document, const JsonNode& node)
{
    static const KeySet KEYS = keysFor(LIGHT_FIELDS, {"type"});
    return readFields(JsonObject(document, node, "a light", KEYS), LIGHT_FIELDS, LIGHT_TYPES);
}

}  // namespace sahl
