// Four numbers side by side, for the boxes of a wide node: the vectors of gcc and clang, of which
// every machine makes its own instructions. shaders/kernels/four.glsl has the same for devices.
#pragma once

#include "shared/scene_types.h"

#include <bit>
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

/// As pick(), by branches: the processor guesses which, and reads the next node before it is known.
/// The empty statements keep the compiler from making one selection of them.
inline uint pickByGuess(const uvec4& v, uint i)
{
    switch (i) {
    case 0:
        asm volatile("");
        return v.x;
    case 1:
        asm volatile("");
        return v.y;
    case 2:
        asm volatile("");
        return v.z;
    default:
        asm volatile("");
        return v.w;
    }
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

/// max(v, 0), of either sign where it is 0.
inline Four positive4(Four v)
{
    return v < Four{} ? Four{} : v;
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

/// min(v, end) for an end that is not negative.
inline Four upTo4(Four v, float end)
{
    return lesser4(v, fours(end));
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

/// A bit for each place, the first lowest: whether the highest bit is set there.
inline uint bitsWhereHighestIsSet(FourUints v)
{
#ifdef __SSE__
    return static_cast<uint>(__builtin_ia32_movmskps((Four)v));
#else
    return (v[0] >> 31) | (v[1] >> 31) << 1 | (v[2] >> 31) << 2 | (v[3] >> 31) << 3;
#endif
}

inline uint bitsWhereHighestIsClear(FourUints v)
{
    return bitsWhereHighestIsSet(v) ^ 15u;
}

/// The place of the lowest bit that is set; there must be one.
inline uint lowestBit(uint x)
{
    return static_cast<uint>(std::countr_zero(x));
}

/// All bits in the places after `last`.
inline FourUints allBitsWhereBeyond(uint last)
{
    return (FourUints)(FourInts{0, 1, 2, 3} > static_cast<int32_t>(last));
}

}  // namespace sahl::reference
