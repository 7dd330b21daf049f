// Three numbers, along x, y and z, as the machine handles them best: here in a register of four.
// shaders/kernels/axes.glsl has the same for devices.
#pragma once

#include "reference/four.h"

namespace sahl::reference {

/// What lies in the fourth place does not matter, as long as arithmetic with it is not slow: that of
/// denormal numbers is.
using Axes = Four;

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

inline FourInts lessAlongAxes(Axes a, Axes b)
{
    return a < b;
}

inline Axes chosenAxes(FourInts which, Axes a, Axes b)
{
    return which ? a : b;
}

inline Axes inverseAlongAxes(Axes v)
{
    return 1 / v;
}

}  // namespace sahl::reference
