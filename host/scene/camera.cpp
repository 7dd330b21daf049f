#include "scene/camera.h"

#include "bvh/box.h"
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

/// Unit axes of a camera, at right angles.
struct View {
    glm::dvec3 forward, right, up;
};

View viewAlong(const glm::dvec3& forward, const glm::dvec3& up)
{
    View view;
    view.forward = forward / length(forward);
    const glm::dvec3 side = glm::cross(view.forward, up);
    if (!(length(side) > 1e-9 * length(up))) {
        throw badInput("camera: up {} is parallel to the view from eye to lookAt", text(up));
    }
    view.right = side / length(side);
    view.up = glm::cross(view.right, view.forward);
    return view;
}

View viewOf(const CameraAxes& axes)
{
    const double right = length(axes.right), up = length(axes.up);
    if (!(right > SMALLEST_MAGNITUDE)) throw badInput("camera: right is zero");
    if (!(up > SMALLEST_MAGNITUDE)) throw badInput("camera: up is zero");
    View view;
    view.right = axes.right / right;
    const double cosine = glm::dot(view.right, axes.up / up);
    if (!(std::abs(cosine) <= 1e-4)) {
        throw badInput("camera: right {} and up {} are not at a right angle (cosine {:.3g})",
                       text(axes.right), text(axes.up), cosine);
    }
    view.up = axes.up / up - view.right * cosine;
    view.up /= length(view.up);
    view.forward =
        axes.leftHanded ? glm::cross(view.right, view.up) : glm::cross(view.up, view.right);
    return view;
}

View viewOf(const CameraDescription& d)
{
    if (!isFinite(d.eye) || !isFinite(d.lookAt) || !isFinite(d.up)) {
        throw badInput("camera: eye, lookAt and up must be finite");
    }
    if (d.axes) return viewOf(*d.axes);
    const glm::dvec3 toTarget = d.lookAt - d.eye;
    if (!(length(toTarget) > SMALLEST_MAGNITUDE)) {
        throw badInput("camera: eye and lookAt coincide at {}", text(d.eye));
    }
    return viewAlong(toTarget, d.up);
}

/// Half of what is seen: tangents of the angles, or metres when orthographic.
struct HalfSize {
    double x = 0, y = 0;
};

HalfSize halfSizeOf(const CameraDescription& d, double aspect)
{
    if (d.orthographicHeight) {
        const double half = *d.orthographicHeight / 2;
        if (!(half > 0)) throw badInput("camera: height is {}; it must be positive", 2 * half);
        return {half * aspect, half};
    }
    if (!(d.fovDeg > 0 && d.fovDeg < 180)) {
        throw badInput("camera: fovDeg is {}; it must lie between 0 and 180", d.fovDeg);
    }
    const double tangent = sinDeg(d.fovDeg / 2) / cosDeg(d.fovDeg / 2);
    if (d.fovHorizontal) return {tangent, tangent / aspect};
    return {tangent * aspect, tangent};
}

double focusDistanceOf(const CameraDescription& d)
{
    if (d.focusDistance) return *d.focusDistance;
    if (!d.axes) return length(d.lookAt - d.eye);
    throw badInput("camera: a lens needs focusDistance or focusOn");
}

}  // namespace

glm::dvec3 viewDirection(const CameraDescription& description)
{
    return viewOf(description).forward;
}

Camera makeCamera(const CameraDescription& description, uint32_t width, uint32_t height)
{
    if (width == 0 || height == 0) throw badInput("camera: the picture is {} x {}", width, height);
    const View view = viewOf(description);
    const HalfSize half = halfSizeOf(description, static_cast<double>(width) / height);
    Camera camera = {};
    camera.type = description.orthographicHeight ? CAMERA_ORTHOGRAPHIC : CAMERA_PERSPECTIVE;
    camera.position = toFloat(description.eye);
    camera.forward = toFloat(view.forward);
    camera.right = toFloat(view.right * half.x);
    camera.down = toFloat(view.up * -half.y);
    camera.focusDistance = 1;
    if (description.lensRadius > 0) {
        camera.focusDistance = toFloat(focusDistanceOf(description));
        if (!(camera.focusDistance > 0)) {
            throw badInput("camera: the focus distance is {}; it must be positive",
                           camera.focusDistance);
        }
        camera.lensRight = toFloat(view.right * description.lensRadius);
        camera.lensDown = toFloat(view.up * -description.lensRadius);
    }
    return camera;
}

CameraDescription framePrimitives(const Scene& scene)
{
    constexpr double MARGIN = 0.9;  // part of the picture that the box may fill
    CameraDescription description;
    if (scene.primitives.empty() && scene.instances.empty()) return description;
    const Box box = extentOf(scene);
    const glm::dvec3 lo(box.lo), hi(box.hi);
    glm::dvec3 center = (lo + hi) * 0.5;
    glm::dvec3 towardsEye(0.55, 0.42, 1.0);
    towardsEye /= length(towardsEye);
    description.fovDeg = 35;
    description.lookAt = center;
    description.eye = center + towardsEye;

    // Far enough that each corner of the box lies inside the picture.
    const View view = viewOf(description);
    const HalfSize half =
        halfSizeOf(description, static_cast<double>(scene.settings.width) / scene.settings.height);
    double distance = 0;
    for (unsigned corner = 0; corner < 8; corner++) {
        glm::dvec3 p = glm::dvec3(corner & 1 ? hi.x : lo.x, corner & 2 ? hi.y : lo.y,
                                  corner & 4 ? hi.z : lo.z) -
                       center;
        double depth = glm::dot(p, view.forward);
        double x = std::abs(glm::dot(p, view.right)) / (half.x * MARGIN);
        double y = std::abs(glm::dot(p, view.up)) / (half.y * MARGIN);
        distance = std::max(distance, std::max(x, y) - depth);
    }
    description.eye = center + towardsEye * distance;
    return description;
}

}  // namespace sahl
