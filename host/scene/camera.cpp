#include "scene/camera.h"

#include "bvh/box.h"
#include "scene/angles.h"
#include "scene/numbers.h"
#include "util/error.h"

#include <algorithm>
#include <cmath>

namespace sahl {

namespace {

const glm::dvec3 TOWARDS_EYE(0.55, 0.42, 1.0);  // of a camera that frames a box

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

/// The description with its eye at such a distance that each corner of the box lies inside the picture.
CameraDescription framing(CameraDescription description, const FramedBox& box, double aspect)
{
    constexpr double MARGIN = 0.9;  // part of the picture that the box may fill
    const View view = viewOf(description);
    const HalfSize half = halfSizeOf(description, aspect);
    double distance = 0;
    for (unsigned corner = 0; corner < 8; corner++) {
        glm::dvec3 p = glm::dvec3(corner & 1 ? box.hi.x : box.lo.x, corner & 2 ? box.hi.y : box.lo.y,
                                  corner & 4 ? box.hi.z : box.lo.z) -
                       description.lookAt;
        double depth = glm::dot(p, view.forward);
        double x = std::abs(glm::dot(p, view.right)) / (half.x * MARGIN);
        double y = std::abs(glm::dot(p, view.up)) / (half.y * MARGIN);
        distance = std::max(distance, std::max(x, y) - depth);
    }
    description.eye = description.lookAt + TOWARDS_EYE / length(TOWARDS_EYE) * distance;
    description.framed.reset();
    return description;
}

}  // namespace

glm::dvec3 viewDirection(const CameraDescription& description)
{
    return viewOf(description).forward;
}

Camera makeCamera(const CameraDescription& description, uint32_t width, uint32_t height)
{
    if (width == 0 || height == 0) throw badInput("camera: the picture is {} x {}", width, height);
    const double aspect = static_cast<double>(width) / height;
    if (description.framed) {
        return makeCamera(framing(description, *description.framed, aspect), width, height);
    }
    const View view = viewOf(description);
    const HalfSize half = halfSizeOf(description, aspect);
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

void placeCamera(Scene& scene, const CameraDescription& description)
{
    scene.camera = makeCamera(description, scene.settings.width, scene.settings.height);
    scene.cameraDescription = description;
}

CameraDescription framePrimitives(const Scene& scene)
{
    CameraDescription description;
    if (scene.primitives.empty() && scene.instances.empty()) return description;
    const Box box = extentOf(scene);
    description.framed = {glm::dvec3(box.lo), glm::dvec3(box.hi)};
    description.fovDeg = 35;
    description.lookAt = (description.framed->lo + description.framed->hi) * 0.5;
    description.eye = description.lookAt + TOWARDS_EYE / length(TOWARDS_EYE);
    return description;
}

}  // namespace sahl
