// Four numbers side by side, for the boxes of a wide node: the vectors of gcc and clang, of which
// every machine makes its own instructions. shaders/kernels/four.glsl has the same for devices.
#pragma once

#include "shared/scene_types.h"

#include <cstdint>
#include <cstring>

namespace sahl::reference {

using Four = float __attribute__((vector_size(16)));
using FourUints = uint32_t __attribute__((vector_size(16)));
using FourInts = int32_t __attribute__((vector_size(16)));

inline FourUints fourUints(const uvec4& v)
{
    FourUints result;
    std::memcpy(&result, &v, sizeof result);
    return result;
}

inline uint pick(const uvec4& v, uint i)
{
    return (&v.x)[i];
}

inline Four fours(float x)
{
    return Four{x, x, x, x};
}

/// Exact below 2^24.
inline Four floatsOf(FourUints v)
{
    return __builtin_convertvector((FourInts)v, Four);
}

inline FourUints bitsOf(Four v)
{
    return (FourUints)v;
}

inline Four lesser4(Four a, Four b)
{
    return b < a ? b : a;
}

inline Four greater4(Four a, Four b)
{
    return a < b ? b : a;
}

/// All bits where a <= b, else 0.
inline FourUints allBitsWhere(Four a, Four b)
{
    return (FourUints)(a <= b);
}

inline FourUints allBitsWhereNone(FourUints refs)
{
    return (FourUints)(refs == REF_NONE);
}

}  // namespace sahl::reference
