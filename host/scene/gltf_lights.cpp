// The lights of a glTF file, KHR_lights_punctual: they shine along -Z. Its candela are taken as
// W sr^-1 and its lux as W m^-2, since the radiances of emissive materials have no other unit
// either.
#include "scene/angles.h"
#include "scene/gltf_model.h"
#include "scene/numbers.h"
#include "scene/scene_reading.h"

#include <cmath>

namespace sahl {

namespace {

constexpr double HALF_PI = 1.57079632679489661923;

void readCone(const JsonObject& object, Light& light)
{
    required(object, "spot");
    const JsonObject spot = *childOf(object, "spot");
    const double outer = spot.number("outerConeAngle", HALF_PI / 2, {0, HALF_PI + 1e-6});
    const double inner = spot.number("innerConeAngle", 0, {0, HALF_PI});
    if (!(inner < outer)) {
        throw errorAt(spot.document(), spot.node(),
                      fmt::format("{}: innerConeAngle {} must be less than outerConeAngle {}",
                                  spot.what(), inner, outer));
    }
    light.cosOuter = toFloat(cosDeg(90 * (outer / HALF_PI)));
    light.cosInner = toFloat(cosDeg(90 * (inner / HALF_PI)));
}

Light readPunctual(GltfFile& file, const JsonObject& object)
{
    Light light = {};
    required(object, "type");
    const std::string type = object.choice("type", {"directional", "point", "spot"});
    light.type = type == "point" ? LIGHT_POINT : type == "spot" ? LIGHT_SPOT : LIGHT_DIRECTIONAL;
    const double intensity = object.number("intensity", 1, LIGHT_RANGE);
    light.intensity = toFloat(object.vector("color", glm::dvec3(1.0), {0, 1e6}) * intensity);
    if (object.has("range")) {
        object.number("range", 1, {1e-30, 1e30});
        leaveOut(file, "the range of lights is not used: their light reaches everything");
    }
    if (type == "spot") readCone(object, light);
    return light;
}

}  // namespace

void readGltfLights(GltfModel& model, std::span<const GltfPlacedNode> nodes)
{
    GltfFile& file = model.file;
    std::vector<Light> lights;
    if (const auto extension = extensionOf(file.root(), "KHR_lights_punctual")) {
        required(*extension, "lights");
        for (const JsonNode& item : itemsOf(*extension, "lights")) {
            const JsonObject object(file.document, item, fmt::format("light {}", lights.size()));
            lights.push_back(readPunctual(file, object));
        }
    }
    for (const GltfPlacedNode& node : nodes) {
        if (!node.light) continue;
        Light light = lights[*node.light];
        const glm::dvec3 along = -node.toWorld.linear[2];
        const double length = std::sqrt(glm::dot(along, along));
        if (light.type != LIGHT_POINT && !(length > SMALLEST_MAGNITUDE)) {
            leaveOut(file, "a light at a node that flattens space is left out");
            continue;
        }
        if (light.type != LIGHT_DIRECTIONAL) light.position = toFloat(node.toWorld.translation);
        if (light.type != LIGHT_POINT) light.direction = toFloat(along / length);
        model.lights.push_back(light);
    }
}

}  // namespace sahl
