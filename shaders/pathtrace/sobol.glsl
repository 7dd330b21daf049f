// The sampler `sobol`: the 8 samples of a block are the 8 points of a net, four dimensions at a time, and
// every row of four dimensions has them in another order and scrambled anew in every block. Blocks are
// thus independent of each other, and the spread of their means is an honest measure of error. Integers
// only.
//
// Scrambling is Owen's (1995, "Randomly Permuted (t,m,s)-Nets and (t,s)-Sequences"), by hashes as Burley
// does it (2020, "Practical Hash-based Owen Scrambling", JCGT 9(4)), and so is the padding: rows of
// dimensions go together by shuffling. Since 8 points differ in 3 binary digits, the scrambling of these
// is done digit by digit, and all further digits are those of independent samples: no hash need be trusted
// to be as good as a scrambling.

// Upper three binary digits of the 8 points in each dimension, 3 bits a point, point 0 lowest.
// X and Y are the first two dimensions of Sobol's sequence, Z is the number of the point: a (0,3,3)-net in
// base 2. No fourth dimension can go with it as well (ovals of the plane of 7 points have 3 points): W
// makes (0,3,2)-nets with X and with Z, and with Y halves and quarters but not quarters and halves. Sobol's
// own third and fourth dimensions would share their first digit here.
CONST uint NET_X = 0xee9ca0u;
CONST uint NET_Y = 0xecd5a0u;
CONST uint NET_Z = 0xfac688u;
CONST uint NET_W = 0x35fca0u;

/// Product in the field of 8 elements, polynomials over GF(2) modulo t^3 + t + 1.
uint product8(uint a, uint b)
{
    uint p = (a * (b & 1u)) ^ (a * (b & 2u)) ^ (a * (b & 4u));
    p ^= (p >> 4u) * 22u;
    return p ^ (((p >> 3u) & 1u) * 11u);
}

/// Place of sample `index` of a block: a random one of the 56 maps factor * index + offset of the field of
/// 8 elements. Any two samples are any two points, all equally likely; so no two rows are correlated, as
/// they would be if pairs that differ in a certain digit stayed together in all of them.
uint shuffled8(uint index, uint factor, uint offset) { return product8(index, factor) ^ offset; }

/// Three digits, each flipped or not as the digits above it decide.
///   flips  7 random bits: 1 for the first digit, 2 for the second, 4 for the third
uint flippedDigits(uint digits, uint flips)
{
    uint first = flips & 1u;
    uint second = (flips >> (1u + (digits >> 2u))) & 1u;
    uint third = (flips >> (3u + (digits >> 1u))) & 1u;
    return digits ^ ((first << 2u) | (second << 1u) | third);
}

/// The point's three digits, flipped.
uint scrambledDigits(uint net, uint point, uint flips) { return flippedDigits((net >> (3u * point)) & 7u, flips); }

/// 32 random bits for each of four dimensions: numbers in [0, 1) as binary fractions.
///   ofBlock   random bits that all samples of the block share
///   ofSample  random bits of this sample
///   index     of the sample in its block, below 8
uvec4 netBits4(uvec4 ofBlock, uvec4 ofSample, uint index)
{
    uint factor = 1u + (((ofBlock.x & 0xffffu) * 7u) >> 16u);
    uint point = shuffled8(index, factor, (ofBlock.y >> 13u) & 7u);
    return uvec4((scrambledDigits(NET_X, point, ofBlock.x >> 25u) << 29u) | (ofSample.x >> 3u),
                 (scrambledDigits(NET_Y, point, ofBlock.y >> 25u) << 29u) | (ofSample.y >> 3u),
                 (scrambledDigits(NET_Z, point, ofBlock.z >> 25u) << 29u) | (ofSample.z >> 3u),
                 (scrambledDigits(NET_W, point, ofBlock.w >> 25u) << 29u) | (ofSample.w >> 3u));
}
