// How materials scatter light: eval, sample and pdf.

CONST uint LOBE_NONE = 0u;      // nothing was sampled, the path ends
CONST uint LOBE_DIFFUSE = 1u;
CONST uint LOBE_REFLECT = 2u;   // a mirror direction: no other sampling can find it
CONST uint LOBE_TRANSMIT = 3u;  // through the surface, likewise
CONST uint LOBE_GLOSSY_REFLECT = 4u;   // by a rough surface
CONST uint LOBE_GLOSSY_TRANSMIT = 5u;

struct BsdfSample
{
    vec3 wi;          // unit direction to the light
    uint lobe;        // one of LOBE_*
    vec3 weight;      // f * cosine / density
    float pdf;        // density of wi [1/sr]; 0: not by density, a delta lobe
    float mediumEta;  // index of refraction where wi goes, by the report's rule
    float etaScale;   // what refraction has divided radiance by: the square of the relative index
};

bool isDeltaLobe(uint lobe) { return lobe == LOBE_REFLECT || lobe == LOBE_TRANSMIT; }

/// Share of a material that is diffuse: what evalBsdfCos and light sampling see of it.
float diffuseShare(Material material)
{
    if (material.type == MATERIAL_LAMBERT) return 1.0f;
    return material.type == MATERIAL_REPORT ? material.diffuseWeight : 0.0f;
}

/// Whether light from wi is on the side of the geometric surface that wo is on.
bool onViewersSide(SurfaceInteraction isect, vec3 wo, vec3 wi)
{
    return dot3(wo, isect.ng) >= 0.0f && dot3(wi, isect.ng) > 0.0f;
}

/// BSDF times the cosine of wi with the shading normal [1/sr]: of all that is not a delta lobe, as mirror
/// directions have no finite value. Lambert reflects light that arrives on the viewer's side of the
/// geometric surface.
///   wo, wi  unit directions to the viewer and to the light
vec3 evalBsdfCos(Material material, SurfaceInteraction isect, vec3 wo, vec3 wi)
{
    float cosine = dot3(wi, isect.ns);
    if (!(cosine > 0.0f) || !onViewersSide(isect, wo, wi)) return vec3(0.0f);
    return material.baseColor * (diffuseShare(material) * (cosine * INV_PI));
}

/// Density of wi given that the diffuse lobe was chosen [1/sr].
float pdfDiffuse(SurfaceInteraction isect, vec3 wi)
{
    if (!(dot3(wi, isect.ng) > 0.0f)) return 0.0f;
    return pdfCosineHemisphere(dot3(wi, isect.ns));
}

/// Density with which sampleBsdf takes wi [1/sr]: of all that is not a delta lobe, the choice of a lobe
/// included.
///   wo, wi  unit directions to the viewer and to the light
float pdfBsdf(Material material, SurfaceInteraction isect, vec3 wo, vec3 wi)
{
    if (!onViewersSide(isect, wo, wi)) return 0.0f;
    if (material.type == MATERIAL_LAMBERT) return pdfDiffuse(isect, wi);
    if (material.type != MATERIAL_REPORT) return 0.0f;
    float sum = material.diffuseWeight + material.specularWeight;
    if (!(sum > 0.0f)) return 0.0f;
    return pdfDiffuse(isect, wi) * quotient(material.diffuseWeight, sum);
}

/// Samples the diffuse lobe with density pdfDiffuse. Directions under the geometric surface, which an
/// interpolated normal can ask for, carry nothing.
void sampleDiffuse(SurfaceInteraction isect, vec3 color, float u1, float u2, INOUT(BsdfSample) bs)
{
    bs.wi = sampleCosineHemisphere(isect.ns, u1, u2);
    bs.pdf = pdfDiffuse(isect, bs.wi);
    bs.lobe = bs.pdf > 0.0f ? LOBE_DIFFUSE : LOBE_NONE;
    bs.weight = color;
}

/// The mirror direction; nothing where an interpolated normal would send it under the surface.
void sampleReflection(SurfaceInteraction isect, vec3 dir, vec3 color, INOUT(BsdfSample) bs)
{
    bs.wi = reflected(dir, mirrorNormal(isect, dir));
    bs.lobe = dot3(bs.wi, isect.ng) > 0.0f ? LOBE_REFLECT : LOBE_NONE;
    bs.weight = color;
}

/// Reflection or refraction, chosen with the Fresnel probability.
///   eta   index of refraction of the far side relative to the near side
///   far   index of refraction of the far side, for the report's rule
///   tint  weight of what is transmitted
void sampleFresnel(SurfaceInteraction isect, vec3 dir, float eta, float far, vec3 tint, float u,
                   INOUT(BsdfSample) bs)
{
    vec3 n = mirrorNormal(isect, dir);
    float cosI = min2(1.0f, absolute(dot3(dir, n)));
    float cosT;
    float reflectance = fresnelDielectric(cosI, eta, cosT);
    if (u < reflectance) {
        sampleReflection(isect, dir, vec3(1.0f), bs);
        return;
    }
    bs.wi = refracted(dir, n, cosI, cosT, eta);
    bs.lobe = dot3(bs.wi, isect.ng) < 0.0f ? LOBE_TRANSMIT : LOBE_NONE;
    bs.weight = tint;
    bs.mediumEta = far;
}

vec3 conductorReflectance(Material material, float cosI)
{
    return vec3(fresnelConductor(cosI, material.conductorEta.x, material.conductorK.x),
                fresnelConductor(cosI, material.conductorEta.y, material.conductorK.y),
                fresnelConductor(cosI, material.conductorEta.z, material.conductorK.z));
}

/// The report's material: diffuse and dielectric parts, one of them chosen by their weights. Its rule
/// for leaving an object: a surface of the index that the path is in already leads out into vacuum.
void sampleReportMaterial(Material material, SurfaceInteraction isect, vec3 dir, vec4 u,
                          INOUT(BsdfSample) bs)
{
    float sum = material.diffuseWeight + material.specularWeight;
    if (!(sum > 0.0f)) return;
    if (u.w * sum < material.diffuseWeight) {
        sampleDiffuse(isect, material.baseColor * sum, u.x, u.y, bs);
        bs.pdf = bs.pdf * quotient(material.diffuseWeight, sum);
        return;
    }
    float far = material.eta == bs.mediumEta ? 1.0f : material.eta;
    sampleFresnel(isect, dir, quotient(far, bs.mediumEta), far, vec3(1.0f), u.x, bs);
    bs.weight = bs.weight * sum;
}

/// Samples the direction in which a path goes on.
///   dir        unit direction of the ray that arrived
///   mediumEta  index of refraction where it came from, by the report's rule
///   u          uniform in [0,1)^4; u.z is spare
BsdfSample sampleBsdf(Material material, SurfaceInteraction isect, vec3 dir, float mediumEta, vec4 u)
{
    BsdfSample bs;
    bs.wi = vec3(0.0f);
    bs.lobe = LOBE_NONE;
    bs.weight = vec3(0.0f);
    bs.pdf = 0.0f;
    bs.mediumEta = mediumEta;
    bs.etaScale = 1.0f;
    if (material.type == MATERIAL_LAMBERT) {
        sampleDiffuse(isect, material.baseColor, u.x, u.y, bs);
    } else if (material.type == MATERIAL_MIRROR) {
        sampleReflection(isect, dir, material.baseColor, bs);
    } else if (material.type == MATERIAL_CONDUCTOR) {
        float cosI = min2(1.0f, absolute(dot3(dir, mirrorNormal(isect, dir))));
        sampleReflection(isect, dir, conductorReflectance(material, cosI), bs);
    } else if (material.type == MATERIAL_DIELECTRIC) {
        // Radiance is compressed into a smaller solid angle in the denser medium: 1 / eta^2.
        float eta = isect.front ? material.eta : quotient(1.0f, material.eta);
        vec3 tint = material.baseColor * quotient(1.0f, eta * eta);
        sampleFresnel(isect, dir, eta, isect.front ? material.eta : 1.0f, tint, u.x, bs);
        if (bs.lobe == LOBE_TRANSMIT) bs.etaScale = eta * eta;
    } else {
        sampleReportMaterial(material, isect, dir, u, bs);
    }
    return bs;
}
