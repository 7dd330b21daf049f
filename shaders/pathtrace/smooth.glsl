// Diffuse and perfectly smooth surfaces.

/// Density of wi given that the diffuse lobe was chosen [1/sr].
float pdfDiffuse(READ(SurfaceInteraction) isect, vec3 wi)
{
    if (!(dot3(wi, isect.ng) > 0.0f)) return 0.0f;
    return pdfCosineHemisphere(dot3(wi, isect.ns));
}

/// Samples the diffuse lobe with density pdfDiffuse. Directions under the geometric surface, which an
/// interpolated normal can ask for, carry nothing.
void sampleDiffuse(READ(SurfaceInteraction) isect, vec3 color, float u1, float u2, INOUT(BsdfSample) bs)
{
    bs.wi = sampleCosineHemisphere(isect.ns, u1, u2);
    bs.pdf = pdfDiffuse(isect, bs.wi);
    bs.lobe = bs.pdf > 0.0f ? LOBE_DIFFUSE : LOBE_NONE;
    bs.weight = color;
}

/// The mirror direction; nothing where an interpolated normal would send it under the surface.
void sampleReflection(READ(SurfaceInteraction) isect, vec3 dir, vec3 color, INOUT(BsdfSample) bs)
{
    bs.wi = reflected(dir, mirrorNormal(isect, dir));
    bs.lobe = dot3(bs.wi, isect.ng) > 0.0f ? LOBE_REFLECT : LOBE_NONE;
    bs.weight = color;
}

/// Reflection or refraction, chosen with the Fresnel probability.
///   eta   index of refraction of the far side relative to the near side
///   far   index of refraction of the far side, for the report's rule
///   tint  weight of what is transmitted
void sampleFresnel(READ(SurfaceInteraction) isect, vec3 dir, float eta, float far, vec3 tint, float u,
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

/// Index of refraction of the far side relative to the near side.
float farIndex(READ(Material) material, bool front)
{
    return front ? material.eta : quotient(1.0f, material.eta);
}

vec3 conductorReflectance(READ(Material) material, float cosI)
{
    return vec3(fresnelConductor(cosI, material.conductorEta.x, material.conductorK.x),
                fresnelConductor(cosI, material.conductorEta.y, material.conductorK.y),
                fresnelConductor(cosI, material.conductorEta.z, material.conductorK.z));
}

void sampleConductor(READ(Material) material, READ(SurfaceInteraction) isect, vec3 dir, INOUT(BsdfSample) bs)
{
    float cosI = min2(1.0f, absolute(dot3(dir, mirrorNormal(isect, dir))));
    sampleReflection(isect, dir, conductorReflectance(material, cosI), bs);
}

void sampleDielectric(READ(Material) material, READ(SurfaceInteraction) isect, vec3 dir, float u,
                      INOUT(BsdfSample) bs)
{
    // Radiance is compressed into a smaller solid angle in the denser medium: 1 / eta^2.
    float eta = farIndex(material, isect.front);
    vec3 tint = material.baseColor * quotient(1.0f, eta * eta);
    sampleFresnel(isect, dir, eta, isect.front ? material.eta : 1.0f, tint, u, bs);
    if (bs.lobe == LOBE_TRANSMIT) bs.etaScale = eta * eta;
}

/// The report's material: diffuse and dielectric parts, one of them chosen by their weights. Its rule
/// for leaving an object: a surface of the index that the path is in already leads out into vacuum.
void sampleReportMaterial(READ(Material) material, READ(SurfaceInteraction) isect, vec3 dir, vec4 u,
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
