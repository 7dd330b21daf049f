// The sampler `sobol64`: as in sobol.glsl, but the 64 samples of a block are the 64 points of a net. Each of the six pairs
// of its four dimensions is a (0,6,2)-net in base 2: every cell of 64 x 1, 32 x 2, ... 1 x 64 has a point. (Of 8 points no
// four dimensions can do that.) X, Y and Z are the first two dimensions of Sobol's sequence and the number of the point, a
// (0,6,3)-net; W was found by trying all there are.
//
// Points differ in 6 binary digits. Of their scrambling the upper three are done by random bits, as in sobol.glsl; what
// flips the lower three is hashed of these bits and of the digits above. All further digits are those of independent
// samples.

// What a digit of the point's number, the lowest first, flips in the six digits of X, Y, Z and W, X uppermost.
CONST uint NET64_0 = 0x82006du;
CONST uint NET64_1 = 0x4300b2u;
CONST uint NET64_2 = 0x22810cu;
CONST uint NET64_3 = 0x13c218u;
CONST uint NET64_4 = 0x0a2410u;
CONST uint NET64_5 = 0x073820u;

/// Six digits of point `point` in each of the four dimensions, X uppermost.
uint net64(uint point)
{
    return ((point & 1u) * NET64_0) ^ (((point >> 1u) & 1u) * NET64_1) ^ (((point >> 2u) & 1u) * NET64_2) ^
           (((point >> 3u) & 1u) * NET64_3) ^ (((point >> 4u) & 1u) * NET64_4) ^ ((point >> 5u) * NET64_5);
}

/// Product in the field of 64 elements, polynomials over GF(2) modulo t^6 + t + 1.
uint product64(uint a, uint b)
{
    uint p = (a * (b & 1u)) ^ (a * (b & 2u)) ^ (a * (b & 4u)) ^ (a * (b & 8u)) ^ (a * (b & 16u)) ^ (a * (b & 32u));
    uint high = p >> 6u;
    return (p & 63u) ^ high ^ (high << 1u);
}

/// Place of sample `index` of a block: a random one of the 4,032 maps factor * index + offset of the field, which take any
/// two samples to any two points, all equally likely.
uint shuffled64(uint index, uint factor, uint offset) { return product64(index, factor) ^ offset; }

/// PCG-RXS-M-XS of 32 bits, after O'Neill 2014, "PCG: A Family of Simple Fast Space-Efficient Statistically Good Algorithms
/// for Random Number Generation"; as a hash in Jarzynski and Olano 2020, "Hash Functions for GPU Rendering", JCGT 9(3).
uint hash1(uint x)
{
    uint state = x * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

/// Six digits, each flipped or not as the digits above it decide.
uint scrambledSix(uint digits, uint random)
{
    uint upper = digits >> 3u;
    return (flippedDigits(upper, random >> 25u) << 3u) | flippedDigits(digits & 7u, hash1(random ^ upper) >> 25u);
}

/// 32 random bits for each of four dimensions: numbers in [0, 1) as binary fractions.
///   ofBlock   random bits that all samples of the block share
///   ofSample  random bits of this sample
///   index     of the sample in its block, below 64
uvec4 net64Bits4(uvec4 ofBlock, uvec4 ofSample, uint index)
{
    // Independent of what scrambles any three of the dimensions
    uint order = hash1(ofBlock.x + ofBlock.y + ofBlock.z + ofBlock.w);
    uint point = net64(shuffled64(index, 1u + (((order & 0xffffu) * 63u) >> 16u), order >> 26u));
    return uvec4((scrambledSix(point >> 18u, ofBlock.x) << 26u) | (ofSample.x >> 6u),
                 (scrambledSix((point >> 12u) & 63u, ofBlock.y) << 26u) | (ofSample.y >> 6u),
                 (scrambledSix((point >> 6u) & 63u, ofBlock.z) << 26u) | (ofSample.z >> 6u),
                 (scrambledSix(point & 63u, ofBlock.w) << 26u) | (ofSample.w >> 6u));
}
