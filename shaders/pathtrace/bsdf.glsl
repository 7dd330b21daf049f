// How materials scatter light: eval, sample and pdf of each.

struct BsdfSample
{
    vec3 wi;      // unit direction to the light
    float pdf;    // solid angle [1/sr]; 0: nothing was sampled, the path ends
    vec3 weight;  // f * cosine / pdf
};

/// BSDF times the cosine of wi with the shading normal [1/sr]. Lambert reflects light that arrives
/// on the viewer's side of the geometric surface.
vec3 evalBsdfCos(Material material, SurfaceInteraction isect, vec3 wi)
{
    float cosine = dot3(wi, isect.ns);
    if (!(cosine > 0.0f) || !(dot3(wi, isect.ng) > 0.0f)) return vec3(0.0f);
    return material.baseColor * (cosine * INV_PI);
}

float pdfBsdf(SurfaceInteraction isect, vec3 wi)
{
    if (!(dot3(wi, isect.ng) > 0.0f)) return 0.0f;
    return pdfCosineHemisphere(dot3(wi, isect.ns));
}

/// Samples wi with density pdfBsdf. u1, u2 uniform in [0,1). Directions under the geometric surface,
/// which an interpolated normal can ask for, carry nothing.
BsdfSample sampleBsdf(Material material, SurfaceInteraction isect, float u1, float u2)
{
    BsdfSample bs;
    bs.wi = sampleCosineHemisphere(isect.ns, u1, u2);
    bs.pdf = pdfBsdf(isect, bs.wi);
    bs.weight = material.baseColor;
    return bs;
}
