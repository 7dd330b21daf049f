// Axis-aligned boxes of primitives: what they cover, and what the tree is built from.
#pragma once

#include "shared/scene_types.h"

#include <cmath>
#include <limits>

namespace sahl {

/// Empty until something is added.
struct Box {
    vec3 lo = vec3(std::numeric_limits<float>::infinity());
    vec3 hi = vec3(-std::numeric_limits<float>::infinity());
};

inline float lesser(float a, float b)
{
    return b < a ? b : a;
}
inline float greater(float a, float b)
{
    return a < b ? b : a;
}

inline void grow(Box& box, const vec3& lo, const vec3& hi)
{
    for (int axis = 0; axis < 3; axis++) {
        box.lo[axis] = lesser(box.lo[axis], lo[axis]);
        box.hi[axis] = greater(box.hi[axis], hi[axis]);
    }
}

inline void grow(Box& box, const Box& other)
{
    grow(box, other.lo, other.hi);
}

/// The corners' own coordinates for a triangle, the centre -+ the radius in float for a sphere.
inline Box extentOf(const Primitive& primitive)
{
    Box box;
    if (primitive.shape == SHAPE_SPHERE) {
        const vec3 radius(primitive.p1.x);
        grow(box, primitive.p0 - radius, primitive.p0 + radius);
        return box;
    }
    grow(box, primitive.p0, primitive.p0);
    grow(box, primitive.p1, primitive.p1);
    grow(box, primitive.p2, primitive.p2);
    return box;
}

/// WIDENING of pathtrace/traverse.glsl.
constexpr float BOX_WIDENING = 7.15255737e-07f;

/// The box by which the traversal finds a primitive: to the bit that of primitiveBox() in
/// pathtrace/traverse.glsl, which relies on a box never starting later than what it encloses.
inline Box boxOf(const Primitive& primitive)
{
    Box box = extentOf(primitive);
    float size = 0;
    for (int axis = 0; axis < 3; axis++) {
        size = greater(size, greater(std::abs(box.lo[axis]), std::abs(box.hi[axis])));
    }
    constexpr float LARGEST = std::numeric_limits<float>::max();
    for (int axis = 0; axis < 3; axis++) {
        box.lo[axis] = greater(box.lo[axis] - size * BOX_WIDENING, -LARGEST);
        box.hi[axis] = lesser(box.hi[axis] + size * BOX_WIDENING, LARGEST);
    }
    return box;
}

/// Half the surface area of a box that is not empty [m^2]. In double, where no finite float
/// coordinate overflows or vanishes.
inline double halfArea(const Box& box)
{
    double x = double{box.hi.x} - double{box.lo.x};
    double y = double{box.hi.y} - double{box.lo.y};
    double z = double{box.hi.z} - double{box.lo.z};
    return x * y + y * z + z * x;
}

/// Twice the centre of the box along an axis [m]. What splits are sorted by.
inline double doubleCentre(const Box& box, int axis)
{
    return double{box.lo[axis]} + double{box.hi[axis]};
}

}  // namespace sahl
