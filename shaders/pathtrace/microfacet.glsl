// Rough surfaces as crowds of mirrors: the GGX distribution of microfacets, Smith's shadowing.
//   n      unit normal of the whole surface, on the side of wo
//   m      unit normal of a microfacet, on the side of n
//   alpha  width of the distribution, in [MIN_ALPHA, 1]
//
// Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces", EGSR, has the
// distribution; Heitz 2014, "Understanding the Masking-Shadowing Function", JCGT 3(2), the shadowing.
// Light that meets more than one microfacet is lost: the rougher, the darker (docs/materials.md).

// Narrower lobes count as mirrors: their directions would differ in the last bits of a float alone.
CONST float MIN_ALPHA = 1e-4f;

/// Width of the microfacets' distribution: a roughness that looks evenly spread to people, squared.
float alphaOf(READ(Material) material) { return material.roughness * material.roughness; }

bool isSmooth(READ(Material) material) { return alphaOf(material) < MIN_ALPHA; }

/// Density of microfacets per projected area [1/sr]: Walter et al., Eq. 33.
float ggxDistribution(vec3 n, vec3 m, float alpha)
{
    // alpha (cos^2 + sin^2 / alpha^2), the sine by the cross product: 1 - cos^2 would cancel where a
    // narrow lobe has all its light.
    float cosine = dot3(n, m);
    vec3 slant = cross3(n, m);
    float spread = alpha * (cosine * cosine) + quotient(dot3(slant, slant), alpha);
    return quotient(INV_PI, spread * spread);
}

/// sqrt(alpha^2 + (1 - alpha^2) cosine^2), of which Smith's terms are made: the part of microfacets
/// that a direction sees is G1 = 2 cosine / (cosine + smithRoot). Heitz 2014, Eq. 72 with Eq. 43.
float smithRoot(float cosine, float alpha)
{
    float alpha2 = alpha * alpha;
    return root(alpha2 + (1.0f - alpha2) * (cosine * cosine));
}

/// Samples a microfacet normal among those that wo sees, with density
/// G1(wo) (wo.m) D(m) / (wo.n) [1/sr].
///   wo  unit, wo.n > 0
///   u1, u2  uniform in [0,1)
/// Heitz 2018, "Sampling the GGX Distribution of Visible Normals", JCGT 7(4), Sec. 3.
vec3 sampleGgxVisibleNormal(vec3 n, vec3 wo, float alpha, float u1, float u2)
{
    vec3 t;
    vec3 b;
    tangentFrame(n, t, b);

    // To the space in which the distribution is a hemisphere, and a frame there
    vec3 v = unit(vec3(alpha * dot3(wo, t), alpha * dot3(wo, b), dot3(wo, n)));
    float across2 = v.x * v.x + v.y * v.y;
    vec3 v1 = vec3(1.0f, 0.0f, 0.0f);
    if (across2 > 1e-20f) {
        float scale = quotient(1.0f, root(across2));
        v1 = vec3(-v.y * scale, v.x * scale, 0.0f);
    }
    vec3 v2 = cross3(v, v1);

    // A point of the hemisphere's shadow along v: a half disk and a half ellipse
    vec2 disk = sampleDisk(u1, u2);
    float lean = 0.5f * (1.0f + v.z);
    float y = (1.0f - lean) * root(max2(0.0f, 1.0f - disk.x * disk.x)) + lean * disk.y;
    float z = root(max2(0.0f, (1.0f - disk.x * disk.x) - y * y));
    vec3 h = (v1 * disk.x + v2 * y) + v * z;

    vec3 local = unit(vec3(alpha * h.x, alpha * h.y, max2(1e-7f, h.z)));
    return unit((t * local.x + b * local.y) + n * local.z);
}

/// Scattering from wo to wi by the microfacets that send light from one to the other.
struct Microfacets
{
    float cosM;       // cosine of wo with their normal; 0: there are none
    float pdf;        // density of wi if they are sampled as wo sees them and all do the same [1/sr]
    float shadowing;  // share of that light which gets out: BSDF times cosine over pdf
};

/// Reflection where wi is above the surface, else refraction; wo is above.
///   eta  index of refraction of the far side relative to the near side
Microfacets microfacetsBetween(vec3 n, vec3 wo, vec3 wi, float alpha, float eta)
{
    Microfacets r;
    r.cosM = 0.0f;
    r.pdf = 0.0f;
    r.shadowing = 0.0f;
    bool refracts = dot3(wi, n) < 0.0f;
    float cosO = dot3(wo, n);
    float cosI = absolute(dot3(wi, n));
    vec3 sum = refracts ? wo + wi * eta : wo + wi;  // along the normal: Walter et al., Eq. 13 and 16
    float sum2 = dot3(sum, sum);
    if (!(cosO > 0.0f) || !(cosI > 0.0f) || !(sum2 > 1e-12f)) return r;
    vec3 m = sum * quotient(1.0f, root(sum2));
    if (dot3(m, n) < 0.0f) m = -m;
    float cosOM = min2(1.0f, dot3(wo, m));
    float cosIM = dot3(wi, m);
    if (!(cosOM > 0.0f) || (refracts && !(cosIM < 0.0f))) return r;

    // G1(wo) (wo.m) D / (wo.n) is the density of m; 1 / (4 wo.m), and for refraction |wi.m| eta^2 / sum^2
    // (Eq. 14 and 17), make it one of wi.
    float rootO = smithRoot(cosO, alpha);
    float rootI = smithRoot(cosI, alpha);
    float seen = quotient(ggxDistribution(n, m, alpha), cosO + rootO);
    float turn = refracts ? -2.0f * cosOM * cosIM * quotient(eta * eta, sum2) : 0.5f;
    r.cosM = cosOM;
    r.pdf = seen * turn;

    // Reflection: correlated by the height of the microfacets, G2 / G1(wo) with Heitz 2014, Eq. 99.
    // Refraction: Walter's product, G1(wi), as on opposite sides heights do not correlate in that way.
    float correlated = cosI * (cosO + rootO);
    float of = refracts ? cosI + rootI : cosO * rootI + cosI * rootO;
    r.shadowing = quotient(refracts ? 2.0f * cosI : correlated, of);
    return r;
}
