// The materials of scene files.
#include "scene/numbers.h"
#include "scene/plastic.h"
#include "scene/primitives.h"
#include "scene/scene_reading.h"

#include <algorithm>

namespace sahl {

namespace {

constexpr Range SHARE = {0, 1};
constexpr Range INDEX_OF_REFRACTION = {1e-30, 1e6};
constexpr Range COAT_INDEX = {1, 4};
constexpr Range CONDUCTOR_INDEX = {0, 1e6};

/// Complex index of refraction eta + i k at red, green and blue.
struct Metal {
    const char* name;
    glm::dvec3 eta, k;
};

/// Gold, copper, silver: Johnson and Christy 1972, "Optical Constants of the Noble Metals",
/// Physical Review B 6, at 617, 549 and 451 nm. Aluminium: Rakic 1995, "Algorithm for the
/// determination of intrinsic optical constants of metal films", Applied Optics 34, at 620, 564 and
/// 443 nm.
const Metal METALS[] = {
    {"gold", {0.21, 0.43, 1.38}, {3.272, 2.455, 1.914}},
    {"copper", {0.30, 1.02, 1.24}, {3.205, 2.577, 2.397}},
    {"silver", {0.06, 0.06, 0.04}, {4.152, 3.586, 2.657}},
    {"aluminium", {1.3660, 1.0728, 0.6079}, {7.4052, 6.7839, 5.3676}},
};

void readConductor(const JsonObject& object, Material& material)
{
    const bool explicitly = object.has("conductorEta") || object.has("conductorK");
    if (explicitly && object.has("metal")) {
        throw errorAt(object.document(), object.at("metal"),
                      fmt::format("{} has both \"metal\" and \"conductorEta\" or \"conductorK\"; "
                                  "leave one out",
                                  object.what()));
    }
    if (!explicitly) {
        const std::string name = object.choice("metal", {"aluminium", "copper", "gold", "silver"});
        const Metal* metal = std::find_if(std::begin(METALS), std::end(METALS),
                                          [&](const Metal& m) { return m.name == name; });
        material.conductorEta = toFloat(metal->eta);
        material.conductorK = toFloat(metal->k);
        return;
    }
    for (const char* key : {"conductorEta", "conductorK"}) {
        if (!object.has(key)) {
            throw errorAt(object.document(), object.node(),
                          fmt::format("{} lacks the key \"{}\"", object.what(), key));
        }
    }
    material.conductorEta = toFloat(object.vector("conductorEta", {}, CONDUCTOR_INDEX));
    material.conductorK = toFloat(object.vector("conductorK", {}, CONDUCTOR_INDEX));
}

void readReportMaterial(const JsonObject& object, Material& material)
{
    const double diffuse = object.number("diffuseWeight", 0.5, SHARE);
    const double specular = object.number("specularWeight", 0.5, SHARE);
    material.diffuseWeight = toFloat(diffuse);
    material.specularWeight = toFloat(specular);
    if (diffuse + specular > 1) {
        warn(fmt::format(
            "{}: the weights of {} add up to {}; it gives back more light than it gets",
            object.document().where(object.node().offset), object.what(), diffuse + specular));
    }
}

float readShare(const JsonObject& object, const char* key, double otherwise)
{
    return toFloat(object.number(key, otherwise, SHARE));
}

/// Of the types that have a roughness; whoever gives none, nor a picture of it, gets a smooth surface.
void readRoughness(const JsonObject& object, uint roughType, Material& material)
{
    material.roughness = readShare(object, "roughness", object.has("roughnessTexture") ? 1 : 0);
    if (material.roughness > 0) material.type = roughType;
}

/// The types of which a material is more than a few numbers.
void readLayers(const JsonObject& object, const std::string& type, Material& material)
{
    if (type == "thinDielectric") {
        material.type = MATERIAL_THIN_DIELECTRIC;
        material.eta = toFloat(object.number("eta", 1.5, INDEX_OF_REFRACTION));
    }
    if (type == "plastic") {
        material.type = MATERIAL_PLASTIC;
        material.eta = toFloat(object.number("eta", 1.5, COAT_INDEX));
        readRoughness(object, MATERIAL_PLASTIC, material);
        completePlastic(material);
    }
    if (type == "metallicRoughness") {
        material.type = MATERIAL_METALLIC_ROUGHNESS;
        material.eta = toFloat(object.number("eta", 1.5, COAT_INDEX));
        material.roughness = readShare(object, "roughness", 1);
        material.metallic = readShare(object, "metallic", 1);
        material.transmission = readShare(object, "transmission", 0);
    }
}

Material readMaterial(SceneReading& reading, const JsonNode& node, const std::string& what)
{
    const JsonDocument& document = reading.document;
    const std::string type =
        readType(document, node, what,
                 {"lambert", "mirror", "dielectric", "conductor", "report", "thinDielectric",
                  "plastic", "metallicRoughness"});
    const JsonObject object(document, node, what, type + "Material");
    const bool diffuse = type == "lambert" || type == "report" || type == "plastic";
    const bool coloured = diffuse && !object.has("baseColorTexture");
    Material material = {};
    material.eta = 1;
    const glm::dvec3 emission(object.has("emissionTexture") ? 1 : 0);
    material.emission = toFloat(object.vector("emission", emission, LIGHT_RANGE));
    material.baseColor = vec3(1);
    if (type != "conductor") {
        material.baseColor =
            toFloat(object.vector("baseColor", glm::dvec3(coloured ? 0.7 : 1.0), SHARE));
    }
    if (type == "dielectric" || type == "report") {
        material.eta = toFloat(object.number("eta", 1.5, INDEX_OF_REFRACTION));
    }
    material.type = MATERIAL_LAMBERT;
    if (type == "mirror") material.type = MATERIAL_MIRROR;
    if (type == "dielectric") {
        material.type = MATERIAL_DIELECTRIC;
        readRoughness(object, MATERIAL_ROUGH_DIELECTRIC, material);
    }
    if (type == "conductor") {
        material.type = MATERIAL_CONDUCTOR;
        readConductor(object, material);
        readRoughness(object, MATERIAL_ROUGH_CONDUCTOR, material);
    }
    if (type == "report") {
        material.type = MATERIAL_REPORT;
        readReportMaterial(object, material);
    }
    readLayers(object, type, material);
    readMaterialTextures(reading, object, material);
    readPhongMaterial(object, material);
    return material;
}

}  // namespace

void readMaterials(SceneReading& reading, const JsonNode& node)
{
    const JsonDocument& document = reading.document;
    if (node.kind != JsonNode::Kind::object) {
        throw errorAt(document, node, "\"materials\" must be an object: a name for each material");
    }
    for (size_t i = 0; i < node.keys.size(); i++) {
        const std::string& name = node.keys[i].name;
        if (name.empty())
            throw badInput("{}: a material needs a name", document.where(node.keys[i].offset));
        const std::string what = fmt::format("material \"{}\"", name);
        reading.materials[name] =
            addMaterial(reading.scene, name, readMaterial(reading, node.items[i], what));
    }
}

}  // namespace sahl
