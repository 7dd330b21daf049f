// The film's exact sums in words of 32 bits: 64.64 fixed point as host/film/fixed.cpp has it.

/// a + b + carry, where carry is 0 or 1 before and after.
uint addWithCarry(uint a, uint b, INOUT(uint) carry)
{
    uint partial = a + b;
    uint sum = partial + carry;
    carry = partial < a || sum < partial ? 1u : 0u;
    return sum;
}

/// Sum of two fixed-point numbers, lowest word first; stays at the largest number at the top.
uvec4 fixedSum(uvec4 a, uvec4 b)
{
    uint carry = 0u;
    uint x = addWithCarry(a.x, b.x, carry);
    uint y = addWithCarry(a.y, b.y, carry);
    uint z = addWithCarry(a.z, b.z, carry);
    uint w = addWithCarry(a.w, b.w, carry);
    return carry != 0u ? uvec4(0xffffffffu) : uvec4(x, y, z, w);
}

/// A number >= 0 in fixed point: bits below 2^-64 are cut, what is too large becomes the largest number.
uvec4 fixedFromFloat(float value)
{
    uint bits = floatBitsToUint(value);
    uint exponent = (bits >> 23u) & 0xffu;
    uint mantissa = bits & 0x7fffffu;
    if (exponent != 0u) mantissa |= 0x800000u;
    if (exponent == 0u) exponent = 1u;
    // value = mantissa * 2^(exponent - 150) = mantissa * 2^(exponent - 86) units of 2^-64.
    if (exponent > 190u) return uvec4(0xffffffffu);
    if (exponent <= 62u) return uvec4(0u);
    if (exponent < 86u) return uvec4(mantissa >> (86u - exponent), 0u, 0u, 0u);
    uint shift = exponent - 86u;
    uint bit = shift & 31u;
    uint low = mantissa << bit;
    uint high = bit == 0u ? 0u : mantissa >> (32u - bit);
    if (shift < 32u) return uvec4(low, high, 0u, 0u);
    if (shift < 64u) return uvec4(0u, low, high, 0u);
    if (shift < 96u) return uvec4(0u, 0u, low, high);
    return uvec4(0u, 0u, 0u, low);
}

/// Zeros above the highest bit that is set in x > 0.
uint leadingZeros(uint x)
{
    uint zeros = 0u;
    if (x < 0x00010000u) { zeros += 16u; x <<= 16u; }
    if (x < 0x01000000u) { zeros += 8u; x <<= 8u; }
    if (x < 0x10000000u) { zeros += 4u; x <<= 4u; }
    if (x < 0x40000000u) { zeros += 2u; x <<= 2u; }
    return x < 0x80000000u ? zeros + 1u : zeros;
}

/// A fixed-point number as a float: bits below the 24 highest are cut.
float floatFromFixed(uvec4 number)
{
    uint high = number.w;
    uint low = number.z;
    uint place = 96u;  // of the lowest bit of `high`, counted from 2^-64
    if (high == 0u) { high = low; low = number.y; place = 64u; }
    if (high == 0u) { high = low; low = number.x; place = 32u; }
    if (high == 0u) { high = low; low = 0u; place = 0u; }
    if (high == 0u) return 0.0f;
    uint zeros = leadingZeros(high);
    uint bits = zeros == 0u ? high : (high << zeros) | (low >> (32u - zeros));
    uint exponent = (place + 31u - zeros) + 63u;  // of the highest bit: its place - 64, biased by 127
    return uintBitsToFloat((exponent << 23u) | ((bits >> 8u) & 0x7fffffu));
}

/// A count of 64 bits, low word in x.
uvec2 countSum(uvec2 count, uint added)
{
    uint carry = 0u;
    uint x = addWithCarry(count.x, added, carry);
    return uvec2(x, count.y + carry);
}

void addSums(PixelBlock block, INOUT(FilmSums) sums)
{
    sums.red = fixedSum(sums.red, fixedFromFloat(block.sum.x));
    sums.green = fixedSum(sums.green, fixedFromFloat(block.sum.y));
    sums.blue = fixedSum(sums.blue, fixedFromFloat(block.sum.z));
    sums.y2 = fixedSum(sums.y2, fixedFromFloat(block.sumY2));
}

uint samplesOf(FilmPixel film) { return film.samplesA + film.samplesB; }

/// Puts a block of a pixel into its film. Even blocks belong to half A, odd ones to B; BLOCK_SIZE is 8.
void addBlock(PixelBlock block, uint firstSample, INOUT(FilmPixel) film)
{
    if (((firstSample >> 3u) & 1u) == 0u) {
        addSums(block, film.sumsA);
        film.samplesA += block.samplesDone;
    } else {
        addSums(block, film.sumsB);
        film.samplesB += block.samplesDone;
    }
    film.digest += block.digest;
    film.badSamples += block.badSamples;
    film.indirectRays = countSum(film.indirectRays, block.indirectRays);
    film.shadowRays = countSum(film.shadowRays, block.shadowRays);
    film.boxTests = countSum(film.boxTests, block.boxTests);
    film.primitiveTests = countSum(film.primitiveTests, block.primitiveTests);
    film.bounces = countSum(film.bounces, block.bounces);
    film.clamped = countSum(film.clamped, block.clamped);
}

PixelBlock emptyBlock()
{
    PixelBlock block;
    block.sum = vec3(0.0f);
    block.sumY2 = 0.0f;
    block.digest = 0u;
    block.samplesDone = 0u;
    block.status = BLOCK_IDLE;
    block.badSamples = 0u;
    block.indirectRays = 0u;
    block.shadowRays = 0u;
    block.boxTests = 0u;
    block.primitiveTests = 0u;
    block.bounces = 0u;
    block.faults = 0u;
    block.clamped = 0u;
    block.unused0 = 0u;
    return block;
}
