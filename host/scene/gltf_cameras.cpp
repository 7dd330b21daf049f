// The cameras of a glTF file: they look along -Z, +X is to the right and +Y up.
#include "scene/angles.h"
#include "scene/gltf_model.h"
#include "scene/numbers.h"

#include <cmath>

namespace sahl {

namespace {

constexpr double PI = 3.14159265358979323846;
constexpr Range POSITIVE = {1e-30, 1e30};
constexpr Range SIZE = {-1e18, 1e18};  // [m]

void checkDepths(const JsonObject& camera, Range near)
{
    const double znear = requiredNumber(camera, "znear", near);
    if (camera.number("zfar", znear + 1, POSITIVE) > znear) return;
    if (camera.has("zfar")) {
        throw errorAt(camera.document(), camera.at("zfar"),
                      fmt::format("{}: zfar must be beyond znear, {}", camera.what(), znear));
    }
}

GltfCamera readPerspective(const JsonObject& camera)
{
    GltfCamera result;
    const double yfov = requiredNumber(camera, "yfov", {1e-9, 3.1415926});
    checkDepths(camera, POSITIVE);
    result.description.fovDeg = yfov * (180 / PI);
    if (camera.has("aspectRatio")) result.aspect = camera.number("aspectRatio", 1, {1e-4, 1e4});
    return result;
}

GltfCamera readOrthographic(const JsonObject& camera)
{
    GltfCamera result;
    const double x = std::abs(requiredNumber(camera, "xmag", SIZE));
    const double y = std::abs(requiredNumber(camera, "ymag", SIZE));
    requiredNumber(camera, "zfar", POSITIVE);
    checkDepths(camera, {0, POSITIVE.hi});
    if (!(x > SMALLEST_MAGNITUDE && y > SMALLEST_MAGNITUDE)) {
        throw errorAt(camera.document(), camera.node(),
                      fmt::format("{}: xmag and ymag must not be zero", camera.what()));
    }
    result.description.orthographicHeight = 2 * y;
    result.aspect = x / y;
    return result;
}

GltfCamera readCamera(const JsonObject& camera)
{
    required(camera, "type");
    const std::string type = camera.choice("type", {"perspective", "orthographic"});
    if (camera.has("perspective") && camera.has("orthographic")) {
        throw errorAt(camera.document(), camera.node(),
                      fmt::format("{} is both perspective and orthographic", camera.what()));
    }
    required(camera, type);
    const JsonObject kind = *childOf(camera, type);
    return type == "perspective" ? readPerspective(kind) : readOrthographic(kind);
}

double lengthOf(const glm::dvec3& v)
{
    return std::sqrt(glm::dot(v, v));
}

/// The camera at a node. Scaling and shearing turn nothing: the way it looks and the plane of up
/// stay. Throws nothing; false when the node leaves no such directions.
bool place(CameraDescription& camera, const Transform& toWorld)
{
    const glm::dvec3 back = toWorld.linear[2];
    glm::dvec3 up = toWorld.linear[1];
    if (!(lengthOf(back) > SMALLEST_MAGNITUDE)) return false;
    const glm::dvec3 axis = back / lengthOf(back);
    up -= axis * glm::dot(axis, up);
    if (!(lengthOf(up) > 1e-9 * lengthOf(toWorld.linear[1]))) return false;
    up /= lengthOf(up);
    CameraAxes axes;
    axes.leftHanded = determinant(toWorld) < 0;
    axes.up = up;
    axes.right = glm::cross(up, axis) * (axes.leftHanded ? -1.0 : 1.0);
    camera.axes = axes;
    camera.eye = toWorld.translation;
    return true;
}

}  // namespace

void readGltfCameras(GltfModel& model, std::span<const GltfPlacedNode> nodes)
{
    GltfFile& file = model.file;
    const auto& items = itemsOf(file.root(), "cameras");
    std::vector<GltfCamera> cameras;
    for (size_t i = 0; i < items.size(); i++)
        cameras.push_back(
            readCamera(JsonObject(file.document, items[i], fmt::format("camera {}", i))));
    for (const GltfPlacedNode& node : nodes) {
        if (!node.camera) continue;
        GltfCamera camera = cameras[*node.camera];
        if (place(camera.description, node.toWorld))
            model.cameras.push_back(camera);
        else
            leaveOut(file, "a camera at a node that flattens space is left out");
    }
}

}  // namespace sahl
