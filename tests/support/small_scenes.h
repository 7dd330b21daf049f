// Pieces from which tests build scenes in code: rectangles, spheres, lights, probes, cameras.
#pragma once

#include "scene/mesh.h"
#include "scene/primitives.h"
#include "scene/scene.h"

#include <cmath>
#include <numbers>

namespace sahl::testing {

inline Scene emptyScene(uint32_t width, uint32_t height, uint32_t maxBounces)
{
    Scene scene;
    scene.name = "test scene";
    scene.settings = {width, height, 0, maxBounces, 1};
    return scene;
}

/// A material of type MATERIAL_*, to be completed by the caller.
inline Material& addMaterialOf(Scene& scene, uint type, vec3 baseColor, float eta = 1)
{
    Material& material = scene.materials[addMaterial(scene, "material", baseColor)];
    material.type = type;
    material.eta = eta;
    return material;
}

/// The parallelogram corner + [0,1] u + [0,1] v of the scene's last material; its front is where
/// u x v points.
inline void addRectangle(Scene& scene, glm::dvec3 corner, glm::dvec3 u, glm::dvec3 v)
{
    const uint32_t material = static_cast<uint32_t>(scene.materials.size() - 1);
    appendShape(scene, makeRectangle(corner, u, v), {}, material, "rectangle");
}

/// The square |x|, |z| <= half at height y; its front is up or down.
inline void addLevel(Scene& scene, double y, double half, bool up = true)
{
    const glm::dvec3 x(2 * half, 0, 0), z(0, 0, 2 * half);
    addRectangle(scene, {-half, y, -half}, up ? z : x, up ? x : z);
}

/// A sphere of the scene's last material.
inline void addSphere(Scene& scene, vec3 centre, float radius)
{
    Primitive sphere = {};
    sphere.p0 = centre;
    sphere.p1.x = radius;
    sphere.number = static_cast<uint>(scene.primitives.size());
    sphere.material = static_cast<uint>(scene.materials.size() - 1);
    sphere.shape = SHAPE_SPHERE;
    scene.primitives.push_back(sphere);
}

/// A lat-long probe of width x height texels, black as yet.
inline Probe addProbe(Scene& scene, uint32_t width, uint32_t height, uint mapping, uint filter)
{
    Probe probe = plainProbe(width, height, mapping, filter);
    probe.firstTexel = static_cast<uint>(scene.probeTexels.size());
    scene.probeTexels.resize(scene.probeTexels.size() + size_t{width} * height);
    return probe;
}

/// Radiance `above` from directions of height y > 0, `below` from the others; nearest texel.
inline Probe addHalves(Scene& scene, vec3 above, vec3 below)
{
    const Probe probe = addProbe(scene, 1, 2, PROBE_LATLONG, FILTER_NEAREST);
    scene.probeTexels[probe.firstTexel] = vec4(above, 0);
    scene.probeTexels[probe.firstTexel + 1] = vec4(below, 0);
    return probe;
}

inline Probe blackProbe()
{
    return plainProbe(0, 0, PROBE_LATLONG, FILTER_NEAREST);
}

/// A pinhole at `eye`; set focusDistance and lensRight, lensDown for a lens.
inline void lookFrom(Scene& scene, glm::dvec3 eye, glm::dvec3 lookAt, double fovDeg,
                     glm::dvec3 up = {0, 1, 0})
{
    CameraDescription camera;
    camera.eye = eye;
    camera.lookAt = lookAt;
    camera.up = up;
    camera.fovDeg = fovDeg;
    scene.camera = makeCamera(camera, scene.settings.width, scene.settings.height);
}

inline void setLens(Scene& scene, float radius, float focusDistance)
{
    scene.camera.focusDistance = focusDistance;
    scene.camera.lensRight = vec3(glm::normalize(glm::dvec3(scene.camera.right)) * double{radius});
    scene.camera.lensDown = vec3(glm::normalize(glm::dvec3(scene.camera.down)) * double{radius});
}

/// Parallel rays through a picture that is 2 `half` wide around `eye`.
inline void lookParallel(Scene& scene, glm::dvec3 eye, glm::dvec3 lookAt, double half,
                         glm::dvec3 up = {0, 1, 0})
{
    lookFrom(scene, eye, lookAt, 90, up);
    Camera& camera = scene.camera;
    camera.type = CAMERA_ORTHOGRAPHIC;
    camera.right = vec3(glm::normalize(glm::dvec3(camera.right)) * half);
    camera.down = vec3(glm::normalize(glm::dvec3(camera.down)) * half);
}

inline Light& addLight(Scene& scene, uint type, vec3 intensity)
{
    Light light = {};
    light.type = type;
    light.intensity = intensity;
    light.direction = {0, -1, 0};
    return scene.lights.emplace_back(light);
}

inline float cosineOf(double degrees)
{
    return static_cast<float>(std::cos(degrees * std::numbers::pi / 180));
}

}  // namespace sahl::testing
