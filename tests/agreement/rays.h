// Rays and closest hits for tests of traversal: the path tracer's text, compiled as C++.
#pragma once

#include "bvh/box.h"
#include "bvh/bvh.h"
#include "bvh/widen.h"
#include "reference/kernel.h"
#include "scene/scene.h"
#include "support/soups.h"

#include <span>
#include <vector>

namespace sahl::testing {

struct Ray {
    vec3 org;
    vec3 dir;  ///< unit
};

inline Ray rayTowards(const vec3& org, const glm::dvec3& way)
{
    return {org, vec3(way / glm::length(way))};
}

inline Box boxOfAll(std::span<const Primitive> triangles)
{
    Box box;
    for (const Primitive& triangle : triangles) grow(box, boxOf(triangle));
    return box;
}

inline vec3 pointIn(const Box& box, Random& random)
{
    vec3 u = random.inCube(0.5f) + vec3(0.5f);
    return box.lo + (box.hi - box.lo) * u;
}

/// Uniform on the sphere.
inline glm::dvec3 anyDirection(Random& random)
{
    for (;;) {
        glm::dvec3 way(random.inCube(1.0f));
        double length2 = glm::dot(way, way);
        if (length2 > 0.01 && length2 < 1) return way;
    }
}

/// Through random points of the camera's picture.
inline std::vector<Ray> primaryRays(const Camera& camera, size_t count, uint64_t seed)
{
    Random random(seed);
    std::vector<Ray> rays;
    for (size_t i = 0; i < count; i++) {
        const float x = random.uniform(-1, 1), y = random.uniform(-1, 1);
        rays.push_back(
            rayTowards(camera.position, camera.forward + camera.right * x + camera.down * y));
    }
    return rays;
}

/// From anywhere in the scene's box, in any direction.
inline std::vector<Ray> randomRays(std::span<const Primitive> triangles, size_t count, uint64_t seed)
{
    Random random(seed);
    const Box box = boxOfAll(triangles);
    std::vector<Ray> rays;
    for (size_t i = 0; i < count; i++) {
        const vec3 org = pointIn(box, random);
        rays.push_back(rayTowards(org, anyDirection(random)));
    }
    return rays;
}

inline vec3 anyCorner(std::span<const Primitive> triangles, Random& random)
{
    const Primitive& triangle = triangles[random.below(static_cast<uint>(triangles.size()))];
    const uint corner = random.below(3);
    return corner == 0 ? triangle.p0 : corner == 1 ? triangle.p1 : triangle.p2;
}

/// Where rounding decides: at a corner, from corner to corner, along an edge, along an axis inside
/// planes of boxes, and nearly inside a triangle's plane. A fifth of each.
inline std::vector<Ray> hardRays(std::span<const Primitive> triangles, size_t count, uint64_t seed)
{
    Random random(seed);
    const Box box = boxOfAll(triangles);
    std::vector<Ray> rays;
    while (rays.size() < count) {
        const Primitive& t = triangles[random.below(static_cast<uint>(triangles.size()))];
        const vec3 corner = anyCorner(triangles, random), other = anyCorner(triangles, random);
        const vec3 inside = pointIn(box, random);
        const glm::dvec3 p(t.p0), e1 = glm::dvec3(t.p1) - p, e2 = glm::dvec3(t.p2) - p;
        switch (rays.size() % 5) {
        case 0:
            rays.push_back(rayTowards(inside, glm::dvec3(corner) - glm::dvec3(inside)));
            break;
        case 1:
            if (corner == other) continue;
            rays.push_back(rayTowards(corner, glm::dvec3(other) - glm::dvec3(corner)));
            break;
        case 2:
            rays.push_back(rayTowards(vec3(p - 3.0 * e1), e1));
            break;
        case 3: {
            const int axis = static_cast<int>(random.below(3));
            vec3 org = corner, dir(0.0f);
            const bool up = random.below(2) == 0;
            org[axis] = random.below(4) == 0 ? other[axis] : up ? box.lo[axis] : box.hi[axis];
            dir[axis] = up ? 1.0f : -1.0f;
            rays.push_back({org, dir});
            break;
        }
        default: {
            const glm::dvec3 normal = glm::cross(e1, e2);
            const glm::dvec3 along = e1 * double{random.uniform()} + e2 * double{random.uniform()};
            const double tilt = std::ldexp(glm::length(along) / glm::length(normal),
                                           -static_cast<int>(random.below(40)));
            rays.push_back(
                rayTowards(vec3(p - along - 2.0 * tilt * normal), along + tilt * normal));
        }
        }
    }
    return rays;
}

/// A tree and the text's functions on it, ready for one thread.
template <uint Order, bool Watched = false>
reference::Kernel<Order, true, false, 2, Watched> kernelFor(const Bvh& bvh)
{
    reference::Kernel<Order, true, false, 2, Watched> kernel = {};
    kernel.nodes = bvh.nodes;
    kernel.primitives = bvh.primitives;
    kernel.instances = bvh.instances;
    kernel.frame.rootRef = bvh.rootRef;
    return kernel;
}

/// Likewise for the wide trees made of it.
template <uint Order, bool Watched = false>
reference::Kernel<Order, true, false, 4, Watched> wideKernelFor(const Bvh& bvh,
                                                                const WideTrees& wide)
{
    if (wide.nodes.empty() && !bvh.nodes.empty()) throw std::runtime_error("there is no wide tree");
    reference::Kernel<Order, true, false, 4, Watched> kernel = {};
    kernel.wideNodes = wide.nodes;
    kernel.primitives = bvh.primitives;
    kernel.instances = wide.instances;
    kernel.frame.rootRef = wide.rootRef;
    kernel.frame.gridAt = wide.gridAt;
    kernel.frame.gridScale = wide.gridScale;
    return kernel;
}

/// The closest hit up to tMax, or any hit. A fault of the traversal is an error.
template <class Kernel>
Traversal findHit(Kernel& kernel, const Ray& ray, bool anyHit, float tMax)
{
    kernel.faults = 0;
    kernel.stepsLeft = 0xffffffffu;
    Traversal walk = kernel.beginTraversal(tMax);
    if (!kernel.traverse(ray.org, ray.dir, anyHit, walk) || kernel.faults != 0)
        throw std::runtime_error("the traversal did not end by itself");
    return walk;
}

template <class Kernel>
Traversal closestHit(Kernel& kernel, const Ray& ray)
{
    return findHit(kernel, ray, false, Kernel::RAY_INFINITY);
}

}  // namespace sahl::testing
