// Axis-aligned boxes of triangles, exact: every bound is one of the corners' own coordinates. The
// traversal relies on that (a box never starts later than what it encloses), so nothing is padded.
#pragma once

#include "shared/scene_types.h"

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

inline Box boxOf(const Primitive& triangle)
{
    Box box;
    grow(box, triangle.p0, triangle.p0);
    grow(box, triangle.p1, triangle.p1);
    grow(box, triangle.p2, triangle.p2);
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
