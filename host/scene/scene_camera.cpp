// The camera of scene files: by a point to look at, orthographic, or by directions.
#include "scene/camera.h"
#include "scene/scene_reading.h"

#include <numbers>

namespace sahl {

namespace {

constexpr Range DISTANCE = {1e-9, 1e18};  // [m]

/// A mistake that shows only in the camera as a whole is said to be where the camera begins.
template <class Action>
auto placed(const JsonDocument& document, const JsonNode& node, Action action)
{
    try {
        return action();
    } catch (const Error& error) {
        throw errorAt(document, node, error.what());
    }
}

CameraDescription readLookAt(const JsonObject& object)
{
    CameraDescription camera;
    camera.eye = object.vector("eye", camera.eye);
    camera.lookAt = object.vector("lookAt", camera.lookAt);
    camera.up = object.vector("up", camera.up);
    return camera;
}

CameraDescription readDirections(const JsonObject& object)
{
    CameraDescription camera;
    camera.eye = object.vector("position", camera.eye);
    camera.axes = CameraAxes{object.direction("right"), object.direction("up"),
                             object.boolean("leftHanded", false)};
    // The open interval (0, pi), rounded inwards
    camera.fovDeg = object.number("fovRad", 0, {1e-6, 3.14159}) * (180 / std::numbers::pi);
    camera.fovHorizontal = true;
    return camera;
}

glm::dvec3 focusPoint(const SceneReading& reading, const JsonObject& object)
{
    const JsonNode& node = object.at("focusOn");
    if (node.kind == JsonNode::Kind::array) return object.vector("focusOn", {});
    const std::string name = object.string("focusOn", "");
    const auto found = reading.namedShapes.find(name);
    if (found != reading.namedShapes.end()) {
        return (glm::dvec3(found->second.lo) + glm::dvec3(found->second.hi)) * 0.5;
    }
    std::vector<std::string> names;
    for (const auto& [known, box] : reading.namedShapes) names.push_back(known);
    const std::string near = suggestion(name, names);
    throw errorAt(reading.document, node,
                  fmt::format("\"focusOn\" of the camera: no shape has the name \"{}\"{}", name,
                              near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near)));
}

void readLens(const SceneReading& reading, const JsonObject& object, CameraDescription& camera)
{
    camera.lensRadius = object.number("lensRadius", 0, {0, 1e18});
    if (object.has("focusDistance"))
        camera.focusDistance = object.number("focusDistance", 1, DISTANCE);
    if (!object.has("focusOn")) return;
    if (object.has("focusDistance")) {
        throw errorAt(reading.document, object.at("focusOn"),
                      "the camera has both \"focusDistance\" and \"focusOn\"; leave one out");
    }
    const glm::dvec3 toPoint = focusPoint(reading, object) - camera.eye;
    const glm::dvec3 view =
        placed(reading.document, object.node(), [&] { return viewDirection(camera); });
    camera.focusDistance = glm::dot(toPoint, view);
    if (!(*camera.focusDistance >= DISTANCE.lo && *camera.focusDistance <= DISTANCE.hi)) {
        throw errorAt(reading.document, object.at("focusOn"),
                      "\"focusOn\" of the camera is not in front of it");
    }
}

CameraDescription describeCamera(const SceneReading& reading, const JsonNode& node)
{
    const JsonDocument& document = reading.document;
    const bool typed = hasKey(node, "type");
    const std::string type =
        typed ? readType(document, node, "the camera", {"perspective", "orthographic"}) : "";
    if (type == "orthographic") {
        const JsonObject object(document, node, "the camera", "orthographicCamera");
        CameraDescription camera = readLookAt(object);
        camera.orthographicHeight = object.number("height", 1, DISTANCE);
        return camera;
    }
    const bool byDirections = hasKey(node, "right") || hasKey(node, "fovRad");
    const JsonObject object(document, node, "the camera",
                            byDirections ? "directionCamera" : "camera");
    CameraDescription camera = byDirections ? readDirections(object) : readLookAt(object);
    if (!byDirections) {
        camera.fovDeg = object.number("fovDeg", camera.fovDeg, {});
        camera.fovHorizontal = object.choice("fovAxis", {"vertical", "horizontal"}) == "horizontal";
    }
    readLens(reading, object, camera);
    return camera;
}

}  // namespace

void readCamera(SceneReading& reading, const JsonNode& node)
{
    const CameraDescription camera = describeCamera(reading, node);
    placed(reading.document, node, [&] { placeCamera(reading.scene, camera); });
}

}  // namespace sahl
