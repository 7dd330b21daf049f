// Scalar and vector functions in a fixed order of operations, and own transcendental functions.
// Nothing here may differ between devices: only + - * / sqrt, comparisons and bits.

CONST float INV_PI = 0.318309886f;

/// a / b and the square root, correctly rounded: by the device itself where it is known to do that.
float quotient(float a, float b)
{
    if (MATH == MATH_FUSED) return fusedQuotient(a, b, 0);
    return MATH == MATH_INTEGERS ? exactQuotient(a, b, 0) : a / b;
}

float root(float x) { return MATH == MATH_NATIVE ? sqrt(x) : exactRoot(x, 0); }

// Own selects: built-in min, max and abs differ between compilers in the sign of zero.
float min2(float a, float b) { return b < a ? b : a; }

float max2(float a, float b) { return a < b ? b : a; }

float absolute(float x) { return uintBitsToFloat(floatBitsToUint(x) & 0x7fffffffu); }

float maxComponent(vec3 v) { return max2(max2(v.x, v.y), v.z); }

vec3 absolute3(vec3 v)
{
    return vec3(absolute(v.x), absolute(v.y), absolute(v.z));
}

/// True unless x is infinite or not a number.
bool isFiniteNumber(float x) { return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u; }

/// Numbers too small to be the same everywhere (some devices flush denormals) become 0.
float flushed(float x) { return absolute(x) < 1e-30f ? 0.0f : x; }

vec3 flushed3(vec3 v)
{
    return vec3(flushed(v.x), flushed(v.y), flushed(v.z));
}

float dot3(vec3 a, vec3 b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }

vec3 cross3(vec3 a, vec3 b)
{
    return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

/// v scaled to length 1; v must not be zero.
vec3 unit(vec3 v) { return v * quotient(1.0f, root(dot3(v, v))); }

/// Luminance of a linear Rec. 709 colour.
float luminance(vec3 c) { return (0.2126f * c.x + 0.7152f * c.y) + 0.0722f * c.z; }

/// Sine and cosine of an angle given in turns, in [0, 1]. Absolute error below 1.2e-7.
/// Reduced to an eighth of a turn; minimax polynomials found by Remez' method.
void sinCosTurns(float turns, OUT(float) sine, OUT(float) cosine)
{
    float quadrant = floor(turns * 4.0f + 0.5f);
    float r = turns - quadrant * 0.25f;
    float r2 = r * r;
    float s = r * (6.28318531f + r2 * (-41.3417015f + r2 * (81.6052094f
            + r2 * (-76.6983795f + r2 * 41.4875755f))));
    float c = 1.0f + r2 * (-19.7392082f + r2 * (64.9393234f + r2 * (-85.4437408f
            + r2 * 59.2459641f)));
    uint q = uint(quadrant) & 3u;
    float sineSize = (q & 1u) == 0u ? s : c;
    float cosineSize = (q & 1u) == 0u ? c : s;
    sine = q >= 2u ? -sineSize : sineSize;
    cosine = q == 1u || q == 2u ? -cosineSize : cosineSize;
}

/// Angle of the point (x, y) in turns, in [-0.5, 0.5]; 0 for the origin. Absolute error below 4e-8
/// turns. Minimax polynomial for atan(t) / (2 pi) on [0, 1] found by Remez' method.
float atan2Turns(float y, float x)
{
    float ax = absolute(x);
    float ay = absolute(y);
    float larger = max2(ax, ay);
    if (!(larger > 0.0f)) return 0.0f;
    float t = quotient(min2(ax, ay), larger);
    float t2 = t * t;
    float a = t * (0.159154922f + t2 * (-0.0530496761f + t2 * (0.0317854322f
            + t2 * (-0.0223285146f + t2 * (0.0158243924f + t2 * (-0.00953413267f
            + t2 * (0.00390838832f + t2 * -0.000760833325f)))))));
    a = ay > ax ? 0.25f - a : a;
    a = x < 0.0f ? 0.5f - a : a;
    return y < 0.0f ? -a : a;
}

/// Binary logarithm of x > 0, neither denormal nor infinite. Relative error below 3e-7, at 1 too.
float log2Of(float x)
{
    // x = m 2^e with m in [sqrt(1/2), sqrt(2)), so that m - 1 is exact and e is 0 around 1
    uint bits = floatBitsToUint(x);
    uint e = (bits + 0x004afb0du) >> 23u;
    float m = uintBitsToFloat(bits - ((e - 127u) << 23u));
    // ln m = 2 artanh s with s = (m - 1) / (m + 1); the series' next term is below 2e-9 of it
    float s = quotient(m - 1.0f, m + 1.0f);
    float s2 = s * s;
    float log2M = s * (2.88539008f + s2 * (0.961796694f + s2 * (0.577078016f
                + s2 * (0.412198583f + s2 * 0.320598898f))));
    return (float(e) - 127.0f) + log2M;
}

/// 2 to the power of y in [-126, 126]. Relative error below 2e-7.
/// Minimax polynomial for 2^r on [-1/2, 1/2] found by Remez' method.
float exp2Of(float y)
{
    float k = floor(y + 0.5f);
    float r = y - k;
    float p = 1.0f + r * (0.693147206f + r * (0.240226469f + r * (0.0555032878f
            + r * (0.00961848896f + r * (0.00133999312f + r * 0.000153458122f)))));
    return p * uintBitsToFloat(uint(k + 127.0f) << 23u);
}

/// x to the power of n, for x in [0, 1] and n >= 0; x^0 is 1, also for x = 0. Relative error below
/// 3e-7 (1 + |ln x^n|), which is 2.1e-5 at most; what is below 2^-99 (1.6e-30) becomes 0. An x of at
/// most 1e-30 counts as 0.
float power(float x, float n)
{
    if (!(n > 0.0f)) return 1.0f;
    if (!(x > 1e-30f)) return 0.0f;
    float y = n * log2Of(x);
    return y < -99.0f ? 0.0f : exp2Of(y);
}
