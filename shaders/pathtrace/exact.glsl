// Division and square root, correctly rounded on devices whose own are not. The device's result is
// taken as a guess; the exact remainder, an integer, decides the last bits. Right as long as the guess
// is off by at most 3 units in the last place (Vulkan promises 2.5 for division). Where the device
// rounds a * b + c once, the remainder of a division is had in floats, which takes fewer instructions.
// The includer provides that as fusedMultiplyAdd(a, b, c).
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
    bool aIsZero = a < IMPLICIT_BIT;
    bool bIsZero = b < IMPLICIT_BIT;
    bool undefined = (aIsZero && bIsZero) || (a == INFINITY_BITS && b == INFINITY_BITS);
    uint bits = aIsZero || b == INFINITY_BITS ? 0u : INFINITY_BITS;
    return undefined || a > INFINITY_BITS || b > INFINITY_BITS ? QUIET_NAN_BITS : bits;
}

int oneIf(bool condition) { return condition ? 1 : 0; }

/// a / b, rounded to nearest.
///   nudge  added to the guess's last place; 0 but in tests
float exactQuotient(float a, float b, int nudge)
{
    uint sign = (floatBitsToUint(a) ^ floatBitsToUint(b)) & SIGN_BIT;
    uint sizeA = floatBitsToUint(a) & ~SIGN_BIT;
    uint sizeB = floatBitsToUint(b) & ~SIGN_BIT;
    uint exponentA = sizeA >> 23u;
    uint exponentB = sizeB >> 23u;

    // Mantissas as integers, a's doubled where it is the smaller: the quotient lies in [1, 2)
    uint ma = (sizeA & MANTISSA_BITS) | IMPLICIT_BIT;
    uint mb = (sizeB & MANTISSA_BITS) | IMPLICIT_BIT;
    uint doubled = ma < mb ? 1u : 0u;
    float fa = uintBitsToFloat((ma ^ IMPLICIT_BIT) | ((127u + doubled) << 23u));
    float fb = uintBitsToFloat((mb ^ IMPLICIT_BIT) | ONE_BITS);
    int q = int(floatBitsToUint(fa / fb)) + nudge - int(ONE_BITS - IMPLICIT_BIT);

    // The remainder is small, so arithmetic modulo 2^32 gives it exactly. Twice the remainder counts the
    // halves of b by which q is off; all steps are compared at once, as one by one each would wait for
    // the one before. Never half way: the quotient of two 24-bit integers is no such number
    int r2 = int((ma << (24u + doubled)) - ((uint(q) * mb) << 1u));
    int b1 = int(mb);
    int b3 = b1 + b1 + b1;
    int b5 = b3 + b1 + b1;
    q += ((oneIf(r2 > b1) + oneIf(r2 > b3)) + oneIf(r2 > b5)) -
         ((oneIf(r2 < -b1) + oneIf(r2 < -b3)) + oneIf(r2 < -b5));

    int exponent = int(exponentA) - int(exponentB) + 127 - int(doubled);
    uint bits = (uint(exponent) << 23u) + uint(q) - IMPLICIT_BIT;  // rounding may carry into it
    if (exponent < 0 || bits < IMPLICIT_BIT) bits = 0u;
    if (exponent > 254) bits = INFINITY_BITS;
    bool special = exponentA - 1u >= 254u || exponentB - 1u >= 254u;
    return uintBitsToFloat(sign | (special ? specialQuotientBits(sizeA, sizeB) : bits));
}

/// The same where fusedMultiplyAdd() rounds once.
///
/// The remainder of a guess within one unit of the quotient is a float (Markstein 1990, "Computation of elementary
/// functions on the IBM RISC System/6000 processor"), so both that guess and its neighbour on the quotient's side are
/// compared exactly: the one that leaves less is the nearest, and never do both leave the same. Between 2^-60 and 2^60
/// nothing here leaves the normal range; other operands go by integers.
float fusedQuotient(float a, float b, int nudge)
{
    uint exponentA = (floatBitsToUint(a) & INFINITY_BITS) >> 23u;
    uint exponentB = (floatBitsToUint(b) & INFINITY_BITS) >> 23u;
    if (exponentA - 67u >= 120u || exponentB - 67u >= 120u) return exactQuotient(a, b, nudge);
    float guess = uintBitsToFloat(uint(int(floatBitsToUint(a / b)) + nudge));
    float q = fusedMultiplyAdd(fusedMultiplyAdd(-guess, b, a), 1.0f / b, guess);
    float rest = fusedMultiplyAdd(-q, b, a);
    uint restIsOpposite = (floatBitsToUint(rest) ^ floatBitsToUint(a)) >> 31u;  // then |q| is too large
    float neighbour = uintBitsToFloat(floatBitsToUint(q) + 1u - (restIsOpposite << 1u));
    float itsRest = fusedMultiplyAdd(-neighbour, b, a);
    return (floatBitsToUint(itsRest) & ~SIGN_BIT) < (floatBitsToUint(rest) & ~SIGN_BIT) ? neighbour : q;
}

/// Square root of x, rounded to nearest; nudge as above.
float exactRoot(float x, int nudge)
{
    uint size = floatBitsToUint(x) & ~SIGN_BIT;

    // x = f * 4^k with f in [1, 4): the root of f lies in [1, 2)
    uint odd = ((size >> 23u) & 1u) ^ 1u;
    uint m = (size & MANTISSA_BITS) | IMPLICIT_BIT;
    float f = uintBitsToFloat((m ^ IMPLICIT_BIT) | ((127u + odd) << 23u));
    int s = int(floatBitsToUint(sqrt(f))) + nudge - int(ONE_BITS - IMPLICIT_BIT);

    // s is too small by a step and more where r > s, the distance to (s + 1/2)^2, and so on
    int r = int((m << (23u + odd)) - uint(s) * uint(s));
    int s3 = s + s + s;
    int s5 = s3 + s + s;
    s += ((oneIf(r > s) + oneIf(r > s3 + 2)) + oneIf(r > s5 + 6)) -
         ((oneIf(r <= -s) + oneIf(r <= 2 - s3)) + oneIf(r <= 6 - s5));

    uint exponent = ((size >> 23u) + 127u - odd) >> 1u;
    uint bits = (exponent << 23u) + uint(s) - IMPLICIT_BIT;
    if (size == INFINITY_BITS) bits = INFINITY_BITS;
    bool negative = (floatBitsToUint(x) & SIGN_BIT) != 0u;
    if (size > INFINITY_BITS || negative) bits = QUIET_NAN_BITS;
    if (size < IMPLICIT_BIT) bits = floatBitsToUint(x) & SIGN_BIT;
    return uintBitsToFloat(bits);
}
