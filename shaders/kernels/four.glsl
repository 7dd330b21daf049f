// Four numbers side by side, for the boxes of a wide node. host/reference/four.h has the same for C++.

#define Four vec4
#define FourUints uvec4

uvec4 fourUints(uvec4 v) { return v; }

uint pick(uvec4 v, uint i) { return v[i]; }

uint pickByGuess(uvec4 v, uint i) { return v[i]; }

vec4 fours(float x) { return vec4(x); }

// By way of int, which all machines convert fast; exact below 2^24.
vec4 floatsOf(uvec4 v) { return vec4(ivec4(v)); }

/// max(v, 0), of either sign where it is 0; by way of int, whose maximum is one instruction also against a constant.
vec4 positive4(vec4 v) { return intBitsToFloat(max(floatBitsToInt(v), ivec4(0))); }

/// min(v, end) for an end that is not negative; by way of int for the same reason.
vec4 upTo4(vec4 v, float end) { return intBitsToFloat(min(floatBitsToInt(v), ivec4(floatBitsToInt(end)))); }

uvec4 bitsOf(vec4 v) { return floatBitsToUint(v); }

vec4 lesser4(vec4 a, vec4 b) { return mix(a, b, lessThan(b, a)); }

vec4 greater4(vec4 a, vec4 b) { return mix(a, b, lessThan(a, b)); }

/// All bits where a <= b, else 0.
uvec4 allBitsWhere(vec4 a, vec4 b) { return mix(uvec4(0u), uvec4(0xffffffffu), lessThanEqual(a, b)); }

uvec4 allBitsWhereNone(uvec4 refs) { return mix(uvec4(0u), uvec4(0xffffffffu), equal(refs, uvec4(REF_NONE))); }

uint bitsWhereHighestIsClear(uvec4 v)
{
    uvec4 clear = (v >> 31u) ^ 1u;
    return (clear.x | (clear.y << 1u)) | ((clear.z << 2u) | (clear.w << 3u));
}

uint lowestBit(uint x) { return uint(findLSB(x)); }

/// All bits in the places after `last`.
uvec4 allBitsWhereBeyond(uint last)
{
    return mix(uvec4(0u), uvec4(0xffffffffu), lessThan(uvec4(last), uvec4(0u, 1u, 2u, 3u)));
}
