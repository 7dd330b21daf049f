// The lights of scene files: point, spot, directional.
#include "scene/angles.h"
#include "scene/numbers.h"
#include "scene/scene_reading.h"

namespace sahl {

namespace {

constexpr Range OUTER_ANGLE = {0.1, 180};  // [degrees]; below, cosines no longer tell angles apart

glm::dvec3 spotDirection(const JsonObject& spot, const glm::dvec3& position)
{
    if (spot.has("direction") == spot.has("lookAt")) {
        throw errorAt(spot.document(), spot.node(),
                      "a spot light needs either \"direction\" or \"lookAt\"");
    }
    if (spot.has("direction")) return spot.direction("direction");
    const glm::dvec3 toTarget = spot.vector("lookAt", {}) - position;
    const double length = std::sqrt(glm::dot(toTarget, toTarget));
    if (!(length > SMALLEST_MAGNITUDE)) {
        throw errorAt(spot.document(), spot.at("lookAt"),
                      "\"lookAt\" of a spot light is where the light itself is");
    }
    return toTarget / length;
}

Light readPoint(const JsonObject& point)
{
    Light light = {};
    light.type = LIGHT_POINT;
    light.position = toFloat(point.vector("position", {}));
    light.intensity = toFloat(point.vector("intensity", {}, LIGHT_RANGE));
    return light;
}

Light readSpot(const JsonObject& spot)
{
    Light light = readPoint(spot);
    light.type = LIGHT_SPOT;
    light.direction = toFloat(spotDirection(spot, spot.vector("position", {})));
    const double outer = spot.number("outerDeg", 30, OUTER_ANGLE);
    const double inner = spot.number("innerDeg", 0.75 * outer, {0, 180});
    if (inner > outer) {
        throw errorAt(
            spot.document(), spot.at("innerDeg"),
            fmt::format("\"innerDeg\" of a spot light is {}, more than its \"outerDeg\" {}", inner,
                        outer));
    }
    light.cosOuter = toFloat(cosDeg(outer));
    light.cosInner = toFloat(cosDeg(inner));
    return light;
}

Light readDirectional(const JsonObject& directional)
{
    Light light = {};
    light.type = LIGHT_DIRECTIONAL;
    light.direction = toFloat(directional.direction("direction"));
    light.intensity = toFloat(directional.vector("irradiance", {}, LIGHT_RANGE));
    return light;
}

}  // namespace

void readLight(SceneReading& reading, const JsonNode& node)
{
    const std::string type =
        readType(reading.document, node, "a light", {"point", "spot", "directional"});
    const JsonObject object(reading.document, node, "a " + type + " light", type + "Light");
    Light light = {};
    if (type == "point") light = readPoint(object);
    if (type == "spot") light = readSpot(object);
    if (type == "directional") light = readDirectional(object);
    reading.scene.lights.push_back(light);
}

}  // namespace sahl
