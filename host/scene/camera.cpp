#include "scene/camera.h"

#include "scene/angles.h"
#include "scene/numbers.h"
#include "util/error.h"

#include <algorithm>
#include <cmath>

namespace sahl {

namespace {

double length(const glm::dvec3& v)
{
    return std::sqrt(glm::dot(v, v));
}

std::string text(const glm::dvec3& v)
{
    return fmt::format("({}, {}, {})", v.x, v.y, v.z);
}

/// Unit axes of a camera and the tangents of half its fields of view.
struct View {
    glm::dvec3 forward, right, up;
    double tanX = 0, tanY = 0;
};

View viewOf(const CameraDescription& d, double aspect)
{
    if (!isFinite(d.eye) || !isFinite(d.lookAt) || !isFinite(d.up)) {
        throw badInput("camera: eye, lookAt and up must be finite");
    }
    if (!(d.fovDeg > 0 && d.fovDeg < 180)) {
        throw badInput("camera: fovDeg is {}; it must lie between 0 and 180", d.fovDeg);
    }
    View view;
    glm::dvec3 toTarget = d.lookAt - d.eye;
    if (!(length(toTarget) > SMALLEST_MAGNITUDE)) {
        throw badInput("camera: eye and lookAt coincide at {}", text(d.eye));
    }
    view.forward = toTarget / length(toTarget);
    glm::dvec3 side = glm::cross(view.forward, d.up);
    if (!(length(side) > 1e-9 * length(d.up))) {
        throw badInput("camera: up {} is parallel to the view from eye to lookAt", text(d.up));
    }
    view.right = side / length(side);
    view.up = glm::cross(view.right, view.forward);
    double tangent = sinDeg(d.fovDeg / 2) / cosDeg(d.fovDeg / 2);
    view.tanX = d.fovHorizontal ? tangent : tangent * aspect;
    view.tanY = d.fovHorizontal ? tangent / aspect : tangent;
    return view;
}

}  // namespace

Camera makeCamera(const CameraDescription& description, uint32_t width, uint32_t height)
{
    if (width == 0 || height == 0) throw badInput("camera: the picture is {} x {}", width, height);
    View view = viewOf(description, static_cast<double>(width) / height);
    Camera camera = {};
    camera.position = toFloat(description.eye);
    camera.forward = toFloat(view.forward);
    camera.right = toFloat(view.right * view.tanX);
    camera.down = toFloat(view.up * -view.tanY);
    return camera;
}

CameraDescription frameTriangles(const Scene& scene)
{
    constexpr double MARGIN = 0.9;  // part of the picture that the box may fill
    CameraDescription description;
    if (scene.triangles.empty()) return description;
    glm::dvec3 lo(scene.triangles[0].p0), hi = lo;
    for (const Triangle& t : scene.triangles) {
        for (const vec3& p : {t.p0, t.p1, t.p2}) {
            lo = glm::min(lo, glm::dvec3(p));
            hi = glm::max(hi, glm::dvec3(p));
        }
    }
    glm::dvec3 center = (lo + hi) * 0.5;
    glm::dvec3 towardsEye(0.55, 0.42, 1.0);
    towardsEye /= length(towardsEye);
    description.fovDeg = 35;
    description.lookAt = center;
    description.eye = center + towardsEye;

    // Far enough that each corner of the box lies inside the picture.
    View view =
        viewOf(description, static_cast<double>(scene.settings.width) / scene.settings.height);
    double distance = 0;
    for (unsigned corner = 0; corner < 8; corner++) {
        glm::dvec3 p = glm::dvec3(corner & 1 ? hi.x : lo.x, corner & 2 ? hi.y : lo.y,
                                  corner & 4 ? hi.z : lo.z) -
                       center;
        double depth = glm::dot(p, view.forward);
        double x = std::abs(glm::dot(p, view.right)) / (view.tanX * MARGIN);
        double y = std::abs(glm::dot(p, view.up)) / (view.tanY * MARGIN);
        distance = std::max(distance, std::max(x, y) - depth);
    }
    description.eye = center + towardsEye * distance;
    return description;
}

}  // namespace sahl
