// Three numbers, along x, y and z, as the machine handles them best: here in a register of four.
// shaders/kernels/axes.glsl has the same for devices.
#pragma once

#include "reference/four.h"

namespace sahl::reference {

/// What lies in the fourth place does not matter, as long as arithmetic with it is not slow: that of
/// denormal numbers is.
using Axes = Four;
using AxesMask = FourInts;

inline Axes axesOf(const vec3& v)
{
    return Axes{v.x, v.y, v.z, 0};
}

inline Axes equalAxes(float x)
{
    return fours(x);
}

inline float alongX(Axes v)
{
    return v[0];
}

inline float alongY(Axes v)
{
    return v[1];
}

inline float alongZ(Axes v)
{
    return v[2];
}

inline Axes lesserAxes(Axes a, Axes b)
{
    return lesser4(a, b);
}

inline Axes greaterAxes(Axes a, Axes b)
{
    return greater4(a, b);
}

inline Axes sizeAlongAxes(Axes v)
{
    return (Axes)(bitsOf(v) & 0x7fffffffu);
}

inline AxesMask lessAlongAxes(Axes a, Axes b)
{
    return a < b;
}

inline Axes chosenAxes(AxesMask which, Axes a, Axes b)
{
    return which ? a : b;
}

inline Axes inverseAlongAxes(Axes v)
{
    return 1 / v;
}

inline Axes yzx(Axes v)
{
    return __builtin_shufflevector(v, v, 1, 2, 0, 3);
}

inline Axes zxy(Axes v)
{
    return __builtin_shufflevector(v, v, 2, 0, 1, 3);
}

/// Whether one number is below zero and another above. The fourth must be zero.
inline bool onBothSidesOfZero(Axes v)
{
    const bool below = bitsWhereHighestIsSet((FourUints)(v < Axes{})) != 0;
    const bool above = bitsWhereHighestIsSet((FourUints)(v > Axes{})) != 0;
    return below & above;  // one branch, not two
}

/// The component of v along an axis: where v lies in memory, one read.
inline float pickAxis(const vec3& v, uint axis)
{
    return (&v.x)[axis];
}

/// Of the corners of a triangle, relative to org, their places along an axis: three reads.
///   orgAlong  org's
inline Axes cornersAlong(const Primitive& triangle, const vec3&, uint axis, float orgAlong)
{
    Axes corners{pickAxis(triangle.p0, axis), pickAxis(triangle.p1, axis), pickAxis(triangle.p2, axis), orgAlong};
    return corners - equalAxes(orgAlong);
}

}  // namespace sahl::reference
