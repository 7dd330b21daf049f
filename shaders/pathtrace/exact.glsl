// Division and square root, correctly rounded on devices whose own are not. The device's result is
// taken as a guess; the exact remainder, an integer, decides the last bits. Right as long as the guess
// is off by at most 3 units in the last place (Vulkan promises 2.5 for division).
//
// As in C++: not-a-number, infinities, zeros and overflow. Unlike C++: operands and results below
// 2^-126 count as zero.

CONST uint SIGN_BIT = 0x80000000u;
CONST uint INFINITY_BITS = 0x7f800000u;
CONST uint QUIET_NAN_BITS = 0x7fc00000u;
CONST uint ONE_BITS = 0x3f800000u;
CONST uint IMPLICIT_BIT = 0x00800000u;
CONST uint MANTISSA_BITS = 0x007fffffu;

/// a / b where one of them is zero, infinite or not a number, given without their signs.
uint specialQuotientBits(uint a, uint b)
{
    if (a > INFINITY_BITS || b > INFINITY_BITS) return QUIET_NAN_BITS;
    bool aIsZero = a < IMPLICIT_BIT;
    bool bIsZero = b < IMPLICIT_BIT;
    if (a == INFINITY_BITS) return b == INFINITY_BITS ? QUIET_NAN_BITS : INFINITY_BITS;
    if (aIsZero) return bIsZero ? QUIET_NAN_BITS : 0u;
    return bIsZero ? INFINITY_BITS : 0u;
}

/// a / b, rounded to nearest.
///   nudge  added to the guess's last place; 0 but in tests
float exactQuotient(float a, float b, int nudge)
{
    uint sign = (floatBitsToUint(a) ^ floatBitsToUint(b)) & SIGN_BIT;
    uint sizeA = floatBitsToUint(a) & ~SIGN_BIT;
    uint sizeB = floatBitsToUint(b) & ~SIGN_BIT;
    uint exponentA = sizeA >> 23u;
    uint exponentB = sizeB >> 23u;
    if (exponentA == 0u || exponentB == 0u || exponentA == 255u || exponentB == 255u) {
        return uintBitsToFloat(specialQuotientBits(sizeA, sizeB) | sign);
    }

    // Mantissas as integers, a's doubled where it is the smaller: the quotient lies in [1, 2)
    uint ma = (sizeA & MANTISSA_BITS) | IMPLICIT_BIT;
    uint mb = (sizeB & MANTISSA_BITS) | IMPLICIT_BIT;
    uint doubled = ma < mb ? 1u : 0u;
    float fa = uintBitsToFloat(((127u + doubled) << 23u) | (sizeA & MANTISSA_BITS));
    float fb = uintBitsToFloat(ONE_BITS | (sizeB & MANTISSA_BITS));
    int q = int(floatBitsToUint(fa / fb)) + nudge - int(ONE_BITS - IMPLICIT_BIT);

    // The remainder is small, so arithmetic modulo 2^32 gives it exactly
    int divisor = int(mb);
    int r = int((ma << (23u + doubled)) - uint(q) * mb);
    if (r < 0) { q--; r += divisor; }
    if (r < 0) { q--; r += divisor; }
    if (r < 0) { q--; r += divisor; }
    if (r < 0) { q--; r += divisor; }
    if (r >= divisor) { q++; r -= divisor; }
    if (r >= divisor) { q++; r -= divisor; }
    if (r >= divisor) { q++; r -= divisor; }
    if (r >= divisor) { q++; r -= divisor; }
    if (r + r > divisor) q++;  // never half way: the quotient of two 24-bit integers is no such number

    int exponent = int(exponentA) - int(exponentB) + 127 - int(doubled);
    if (exponent < 0) return uintBitsToFloat(sign);
    if (exponent > 254) return uintBitsToFloat(sign | INFINITY_BITS);
    uint bits = (uint(exponent) << 23u) + uint(q) - IMPLICIT_BIT;  // rounding may carry into it
    return uintBitsToFloat(sign | (bits < IMPLICIT_BIT ? 0u : bits));
}

/// Square root of x, rounded to nearest; nudge as above.
float exactRoot(float x, int nudge)
{
    uint size = floatBitsToUint(x) & ~SIGN_BIT;
    if (size > INFINITY_BITS) return uintBitsToFloat(QUIET_NAN_BITS);
    if (size < IMPLICIT_BIT) return uintBitsToFloat(floatBitsToUint(x) & SIGN_BIT);
    if ((floatBitsToUint(x) & SIGN_BIT) != 0u) return uintBitsToFloat(QUIET_NAN_BITS);
    if (size == INFINITY_BITS) return x;

    // x = f * 4^k with f in [1, 4): the root of f lies in [1, 2)
    uint odd = ((size >> 23u) & 1u) ^ 1u;
    uint m = (size & MANTISSA_BITS) | IMPLICIT_BIT;
    float f = uintBitsToFloat(((127u + odd) << 23u) | (size & MANTISSA_BITS));
    int s = int(floatBitsToUint(sqrt(f))) + nudge - int(ONE_BITS - IMPLICIT_BIT);

    int r = int((m << (23u + odd)) - uint(s) * uint(s));
    if (r < 0) { s--; r += s + s + 1; }
    if (r < 0) { s--; r += s + s + 1; }
    if (r < 0) { s--; r += s + s + 1; }
    if (r < 0) { s--; r += s + s + 1; }
    if (r > s + s) { r -= s + s + 1; s++; }
    if (r > s + s) { r -= s + s + 1; s++; }
    if (r > s + s) { r -= s + s + 1; s++; }
    if (r > s + s) { r -= s + s + 1; s++; }
    if (r > s) s++;

    uint exponent = ((size >> 23u) + 127u - odd) >> 1u;
    return uintBitsToFloat((exponent << 23u) + uint(s) - IMPLICIT_BIT);
}
