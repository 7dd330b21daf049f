// Objects placed in all ways that an instance allows, for tests of the two-level traversal.
#pragma once

#include "agreement/rays.h"
#include "bvh/instances.h"
#include "scene/mesh.h"
#include "scene/primitives.h"
#include "scene/transform.h"

#include <cmath>

namespace sahl::testing {

inline glm::dmat3 anyRotation(Random& random)
{
    return rotation(anyDirection(random), 360 * double{random.uniform()}).linear;
}

/// 10^x for x uniform.
inline double anyScale(double lowest, double highest, Random& random)
{
    return std::pow(10.0, lowest + (highest - lowest) * double{random.uniform()});
}

/// A map that turns, scales each axis on its own between 10^lowest and 10^highest, and turns again:
/// rotations, shears and all between. One in two mirrors, one in four scales all axes alike.
inline Placement anyPlacement(double lowest, double highest, Random& random)
{
    glm::dvec3 scale;
    for (int axis = 0; axis < 3; axis++) scale[axis] = anyScale(lowest, highest, random);
    if (random.below(4) == 0) scale = glm::dvec3(scale.x);
    if (random.below(2) == 0) scale.x = -scale.x;
    Placement placement;
    placement.linear = anyRotation(random) * scaling(scale).linear * anyRotation(random);
    const float far = static_cast<float>(anyScale(-1, 2, random));
    placement.translation = glm::dvec3(random.inCube(far));
    return placement;
}

inline vec3 placedPoint(const Placement& placement, const vec3& q)
{
    return vec3(placement.linear * glm::dvec3(q) + placement.translation);
}

/// The triangles of an object as they would stand in the world; spheres are left out.
inline void appendFlattened(const Placement& placement, std::span<const Primitive> object,
                            std::vector<Primitive>& world)
{
    for (const Primitive& t : object) {
        if (t.shape == SHAPE_SPHERE) continue;
        addTriangle(world, placedPoint(placement, t.p0), placedPoint(placement, t.p1),
                    placedPoint(placement, t.p2));
    }
}

inline std::vector<Primitive> ballOfTriangles(uint32_t level, vec3 centre, float radius)
{
    const Mesh mesh = makeSphere(centre, double{radius}, level, false);
    std::vector<Primitive> triangles;
    for (const MeshTriangle& t : mesh.triangles) {
        addTriangle(triangles, mesh.positions[t.position[0]], mesh.positions[t.position[1]],
                    mesh.positions[t.position[2]]);
    }
    return triangles;
}

}  // namespace sahl::testing
