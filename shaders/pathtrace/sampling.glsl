// Warps from [0,1)^2 to the domains that the path tracer samples, each with its density.

/// Orthonormal vectors t and b such that (t, b, n) is right-handed; n is unit.
/// Duff et al. 2017, "Building an Orthonormal Basis, Revisited", JCGT 6(1), Listing 3.
void tangentFrame(vec3 n, OUT(vec3) t, OUT(vec3) b)
{
    float s = n.z < 0.0f ? -1.0f : 1.0f;
    float a = quotient(-1.0f, s + n.z);
    float c = n.x * n.y * a;
    t = vec3(1.0f + s * n.x * n.x * a, s * c, -s * n.x);
    b = vec3(c, s + n.y * n.y * a, -n.y);
}

/// Samples the unit disk uniformly, with density 1 / pi. u1, u2 uniform in [0,1).
vec2 sampleDisk(float u1, float u2)
{
    float sine;
    float cosine;
    sinCosTurns(u2, sine, cosine);
    float r = root(u1);
    return vec2(r * cosine, r * sine);
}

/// Samples a direction about the unit vector n, with density cosine / pi [1/sr].
///   u1, u2  uniform in [0,1)
vec3 sampleCosineHemisphere(vec3 n, float u1, float u2)
{
    vec2 disk = sampleDisk(u1, u2);
    vec3 t;
    vec3 b;
    tangentFrame(n, t, b);
    vec3 around = t * disk.x + b * disk.y;
    return unit(around + n * root(1.0f - u1));
}

/// Density of sampleCosineHemisphere for a direction whose cosine with n is given [1/sr].
float pdfCosineHemisphere(float cosine) { return max2(cosine, 0.0f) * INV_PI; }
