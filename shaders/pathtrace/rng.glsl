// Random numbers as a function of (seed, pixel, sample, dimension): no state, integers only. How samples of
// a pixel go together is in sobol.glsl and sobol64.glsl.

// Where a path needs numbers. Each vertex has its own: 4 for its BSDF, of which one chooses between probe
// and lights, then 4 for a light and roulette.
CONST uint DIMENSION_CAMERA = 0u;
CONST uint DIMENSION_FIRST_VERTEX = 4u;
CONST uint DIMENSION_LIGHT = 4u;  // within a vertex
CONST uint DIMENSIONS_PER_VERTEX = 8u;

/// pcg4d of Jarzynski and Olano 2020, "Hash Functions for GPU Rendering", JCGT 9(3), Sec. 4.2.
uvec4 hash4(uint a, uint b, uint c, uint d)
{
    uint x = a * 1664525u + 1013904223u;
    uint y = b * 1664525u + 1013904223u;
    uint z = c * 1664525u + 1013904223u;
    uint w = d * 1664525u + 1013904223u;
    x += y * w;
    y += z * x;
    z += x * y;
    w += y * z;
    x ^= x >> 16u;
    y ^= y >> 16u;
    z ^= z >> 16u;
    w ^= w >> 16u;
    x += y * w;
    y += z * x;
    z += x * y;
    w += y * z;
    return uvec4(x, y, z, w);
}

/// A number in [0, 1) from the upper 24 bits: exact in float on every device.
float unitFloat(uint bits) { return float(bits >> 8u) * 5.96046448e-08f; }

/// 32 random bits for each of a row of four dimensions, by the scene's sampler.
uvec4 randomBits4(uint pixel, uint sampleIndex, uint dimension)
{
    if (!HAS_BLOCKS || (HAS_INDEPENDENT && UNIFORM(samplerKind) == SAMPLER_INDEPENDENT))
        return hash4(pixel, sampleIndex, dimension, UNIFORM(seed));
    // There are fewer than 2^24 samples, so the highest bits tell the kinds of numbers apart: pictures of different samplers
    // have no noise in common.
    if (HAS_SOBOL64 && (!HAS_SOBOL || UNIFORM(samplerKind) == SAMPLER_SOBOL64)) {
        uvec4 ofSample = hash4(pixel, sampleIndex | 0x60000000u, dimension, UNIFORM(seed));
        uvec4 ofBlock = hash4(pixel, (sampleIndex >> 6u) | 0xc0000000u, dimension, UNIFORM(seed));
        return net64Bits4(ofBlock, ofSample, sampleIndex & 63u);
    }
    // BLOCK_SIZE is 8.
    uvec4 ofSample = hash4(pixel, sampleIndex | 0x40000000u, dimension, UNIFORM(seed));
    uvec4 ofBlock = hash4(pixel, (sampleIndex >> 3u) | 0x80000000u, dimension, UNIFORM(seed));
    return netBits4(ofBlock, ofSample, sampleIndex & 7u);
}

/// Four uniform numbers in [0, 1): the upper 24 bits of randomBits4.
vec4 random4(uint pixel, uint sampleIndex, uint dimension)
{
    uvec4 bits = randomBits4(pixel, sampleIndex, dimension);
    return vec4(unitFloat(bits.x), unitFloat(bits.y), unitFloat(bits.z), unitFloat(bits.w));
}
