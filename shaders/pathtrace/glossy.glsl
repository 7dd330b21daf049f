// The rough and the layered materials: conductor and dielectric with microfacets, a thin pane, plastic,
// glTF's metallic-roughness. What they share is here once, not with each of them: a device's compiler
// makes one long program of all of it, wherever it is called.
//   n   shading normal on the side of wo, unless it is turned away from wo: then the geometric one
//   wo  unit direction to the viewer, wo.n > 0

// Sides whose indices differ by less refract so little that a lobe cannot be told from a straight line.
CONST float MIN_REFRACTION = 1e-3f;

bool isCoated(READ(Material) material)
{
    return material.type == MATERIAL_PLASTIC || material.type == MATERIAL_METALLIC_ROUGHNESS;
}

/// MATERIAL_CONDUCTOR and MATERIAL_DIELECTRIC also for what is too smooth to be otherwise.
uint typeActedAs(READ(Material) material)
{
    bool straight = absolute(material.eta - 1.0f) < MIN_REFRACTION;
    if (material.type == MATERIAL_ROUGH_CONDUCTOR && isSmooth(material)) return MATERIAL_CONDUCTOR;
    if (material.type == MATERIAL_ROUGH_DIELECTRIC && (isSmooth(material) || straight)) {
        return MATERIAL_DIELECTRIC;
    }
    return material.type;
}

/// Light that the coat of plastic or of metallic-roughness reflects.
float coatOf(READ(Material) material, float cosine)
{
    return material.type == MATERIAL_PLASTIC ? plasticCoat(material, cosine)
                                             : schlickCoat(material, cosine);
}

LobeChances coatedChances(READ(Material) material, float cosO, float coatO)
{
    if (material.type == MATERIAL_PLASTIC) return plasticChances(material, coatO);
    return metallicChances(material, cosO, coatO);
}

/// Reflectance of a coat's microfacet.
///   fresnel  that of a dielectric
vec3 coatedFresnel(READ(Material) material, float cosM, float fresnel)
{
    return material.type == MATERIAL_PLASTIC ? vec3(fresnel) : metallicFresnel(material, cosM);
}

/// All lobes of a coated material but those of a smooth coat.
///   r        microfacets between wo and wi, a wi below the surface mirrored to above it
///   fresnel  their reflectance, if they are those of a dielectric
BsdfValue evalCoated(READ(Material) material, float cosO, float cosI, READ(Microfacets) r, float fresnel)
{
    BsdfValue value = noBsdf();
    float coatO = coatOf(material, cosO);
    LobeChances chances = coatedChances(material, cosO, coatO);
    if (cosI < 0.0f) {
        float passes = 1.0f - dielectricSchlick(material, r.cosM);
        value.f = baseShare(material, material.transmission) * (passes * (r.pdf * r.shadowing));
        value.pdf = chances.through * r.pdf;
        return value;
    }
    vec3 base = material.type == MATERIAL_PLASTIC ? plasticBase(material) : metallicBase(material);
    float pdfBase = cosI * INV_PI;
    value.f = base * (((1.0f - coatO) * (1.0f - coatOf(material, cosI))) * pdfBase) +
              coatedFresnel(material, r.cosM, fresnel) * (r.pdf * r.shadowing);
    value.pdf = chances.diffuse * pdfBase + chances.coat * r.pdf;
    return value;
}

/// What microfacets of glass do: reflect, or refract and compress radiance into a smaller solid angle in
/// the denser medium, by 1 / eta^2.
BsdfValue evalGlass(READ(Material) material, float eta, bool below, READ(Microfacets) r, float fresnel)
{
    BsdfValue value;
    value.pdf = (below ? 1.0f - fresnel : fresnel) * r.pdf;
    vec3 tint = below ? material.baseColor * quotient(1.0f, eta * eta) : vec3(1.0f);
    value.f = tint * (value.pdf * r.shadowing);
    return value;
}

/// All lobes that have a density.
BsdfValue evalGlossy(READ(Material) material, READ(SurfaceInteraction) isect, vec3 wo, vec3 wi)
{
    BsdfValue value = noBsdf();
    vec3 n = mirrorNormal(isect, -wo);
    uint type = typeActedAs(material);
    bool below = goesBelow(isect, n, wi);
    bool through = type == MATERIAL_ROUGH_DIELECTRIC || type == MATERIAL_METALLIC_ROUGHNESS;
    if (!(dot3(wo, n) > 0.0f) || !(below ? through : staysAbove(isect, n, wi))) return value;
    if (type == MATERIAL_THIN_DIELECTRIC || type < MATERIAL_ROUGH_CONDUCTOR) return value;

    bool glass = type == MATERIAL_ROUGH_DIELECTRIC;
    float cosI = dot3(wi, n);
    float eta = glass ? farIndex(material, isect.front) : material.eta;
    vec3 to = below && !glass ? wi - n * (2.0f * cosI) : wi;
    Microfacets r;
    r.cosM = 0.0f;
    r.pdf = 0.0f;
    r.shadowing = 0.0f;
    if (!isSmooth(material)) r = microfacetsBetween(n, wo, to, alphaOf(material), eta);
    float cosT;
    float fresnel = fresnelDielectric(r.cosM, eta, cosT);
    if (glass) {
        value = evalGlass(material, eta, below, r, fresnel);
    } else if (isCoated(material)) {
        value = evalCoated(material, dot3(wo, n), cosI, r, fresnel);
    } else {
        value.f = conductorReflectance(material, r.cosM) * (r.pdf * r.shadowing);
        value.pdf = r.pdf;
    }
    value.f = flushed3(value.f);
    return value;
}

/// Reflectance of both faces of a thin pane together, light that goes to and fro inside included: the
/// geometric series R + T^2 R (1 + R^2 + R^4 + ...) with T = 1 - R.
float paneReflectance(float fresnel) { return quotient(2.0f * fresnel, 1.0f + fresnel); }

/// Samples a material of which typeActedAs is MATERIAL_ROUGH_CONDUCTOR or beyond.
///   dir  unit direction of the ray that arrived
void sampleGlossy(READ(Material) material, READ(SurfaceInteraction) isect, vec3 dir, vec4 u, INOUT(BsdfSample) bs)
{
    vec3 n = mirrorNormal(isect, dir);
    vec3 wo = -dir;
    float cosO = dot3(wo, n);
    if (!(cosO > 0.0f)) return;

    // A lobe of a coated material
    bool coated = isCoated(material);
    LobeChances chances;
    chances.coat = 1.0f;
    chances.diffuse = 0.0f;
    chances.through = 0.0f;
    if (coated) chances = coatedChances(material, cosO, coatOf(material, cosO));
    bool diffuse = u.w < chances.diffuse;
    bool through = !diffuse && u.w < chances.diffuse + chances.through;
    if (!diffuse && !through && !(chances.coat > 0.0f)) return;

    // A microfacet, and what glass does there
    bool pane = material.type == MATERIAL_THIN_DIELECTRIC;
    bool glass = material.type == MATERIAL_ROUGH_DIELECTRIC;
    bool isDelta = !diffuse && (pane || isSmooth(material));
    vec3 m = n;
    if (!diffuse && !isDelta) m = sampleGgxVisibleNormal(n, wo, alphaOf(material), u.x, u.y);
    float cosM = min2(1.0f, max2(0.0f, dot3(wo, m)));
    float eta = glass ? farIndex(material, isect.front) : material.eta;
    float cosT;
    float fresnel = fresnelDielectric(cosM, eta, cosT);
    if (glass) through = !(u.w < fresnel);
    if (pane) through = !(u.w < paneReflectance(fresnel));

    // The direction
    vec3 wi = vec3(0.0f);
    if (diffuse) {
        wi = sampleCosineHemisphere(n, u.x, u.y);
    } else if (through && glass) {
        wi = refracted(dir, m, cosM, cosT, eta);
    } else if (through && isDelta) {
        wi = dir;
    } else {
        wi = reflected(dir, m);
        if (through) wi = wi - n * (2.0f * dot3(wi, n));
    }
    if (!(through ? goesBelow(isect, n, wi) : staysAbove(isect, n, wi))) return;

    if (!isDelta) {
        uint lobe = through ? LOBE_GLOSSY_TRANSMIT : LOBE_GLOSSY_REFLECT;
        takeSample(evalGlossy(material, isect, wo, wi), wi, diffuse ? LOBE_DIFFUSE : lobe, bs);
        if (through && glass && bs.lobe != LOBE_NONE) {
            bs.mediumEta = isect.front ? material.eta : 1.0f;
            bs.etaScale = eta * eta;
        }
        return;
    }
    bs.wi = wi;
    bs.lobe = through ? LOBE_TRANSMIT : LOBE_REFLECT;
    if (pane) {
        bs.weight = through ? material.baseColor : vec3(1.0f);
    } else if (through) {
        float passes = quotient(1.0f - dielectricSchlick(material, cosM), chances.through);
        bs.weight = baseShare(material, material.transmission) * passes;
    } else {
        bs.weight = coatedFresnel(material, cosM, fresnel) * quotient(1.0f, chances.coat);
    }
}
