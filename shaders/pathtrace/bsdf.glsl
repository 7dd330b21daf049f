// How materials scatter light: eval, sample and pdf.

/// Share of a material that is diffuse.
float diffuseShare(READ(Material) material)
{
    if (material.type == MATERIAL_LAMBERT) return 1.0f;
    if (material.type == MATERIAL_PLASTIC) return 1.0f;
    if (material.type == MATERIAL_METALLIC_ROUGHNESS) {
        return (1.0f - material.metallic) * (1.0f - material.transmission);
    }
    return material.type == MATERIAL_REPORT ? material.diffuseWeight : 0.0f;
}

/// Whether all lobes of a material are delta lobes: no light sample can count there.
bool isSpecular(READ(Material) material)
{
    uint type = material.type;
    if (HAS_GLOSSY) type = typeActedAs(material);
    if (type == MATERIAL_REPORT) return !(material.diffuseWeight > 0.0f);
    return (type >= MATERIAL_MIRROR && type <= MATERIAL_CONDUCTOR) || type == MATERIAL_THIN_DIELECTRIC;
}

/// Whether a material has lobes for light from behind it, other than delta lobes.
bool scattersThrough(READ(Material) material)
{
    if (material.type == MATERIAL_METALLIC_ROUGHNESS) return material.transmission > 0.0f;
    return material.type == MATERIAL_ROUGH_DIELECTRIC;
}

/// All lobes but delta lobes, as mirror directions have no finite value. Lambert reflects light that
/// arrives on the viewer's side of the geometric surface.
///   wo, wi  unit directions to the viewer and to the light
BsdfValue evalBsdf(READ(Material) material, READ(SurfaceInteraction) isect, vec3 wo, vec3 wi)
{
    if (HAS_GLOSSY && material.type >= MATERIAL_ROUGH_CONDUCTOR) return evalGlossy(material, isect, wo, wi);
    BsdfValue value = noBsdf();
    float cosine = dot3(wi, isect.ns);
    if (!(cosine > 0.0f) || !onViewersSide(isect, wo, wi)) return value;
    value.f = material.baseColor * (diffuseShare(material) * (cosine * INV_PI));
    value.pdf = pdfDiffuse(isect, wi);
    if (material.type == MATERIAL_LAMBERT) return value;
    float sum = material.diffuseWeight + material.specularWeight;
    bool diffuse = material.type == MATERIAL_REPORT && sum > 0.0f;
    value.pdf = diffuse ? value.pdf * quotient(material.diffuseWeight, sum) : 0.0f;
    return value;
}

/// BSDF times the cosine of wi with the shading normal [1/sr]. Who needs both this and the density asks
/// evalBsdf.
vec3 evalBsdfCos(READ(Material) material, READ(SurfaceInteraction) isect, vec3 wo, vec3 wi)
{
    return evalBsdf(material, isect, wo, wi).f;
}

/// Density with which sampleBsdf takes wi [1/sr], the choice of a lobe included.
float pdfBsdf(READ(Material) material, READ(SurfaceInteraction) isect, vec3 wo, vec3 wi)
{
    return evalBsdf(material, isect, wo, wi).pdf;
}

/// Samples the direction in which a path goes on.
///   dir        unit direction of the ray that arrived
///   mediumEta  index of refraction where it came from, by the report's rule
///   u          uniform in [0,1)^4; u.z is left for the choice of a light
BsdfSample sampleBsdf(READ(Material) material, READ(SurfaceInteraction) isect, vec3 dir, float mediumEta, vec4 u)
{
    BsdfSample bs;
    bs.wi = vec3(0.0f);
    bs.lobe = LOBE_NONE;
    bs.weight = vec3(0.0f);
    bs.pdf = 0.0f;
    bs.mediumEta = mediumEta;
    bs.etaScale = 1.0f;
    uint type = material.type;
    if (HAS_GLOSSY) type = typeActedAs(material);
    if (type == MATERIAL_LAMBERT) {
        sampleDiffuse(isect, material.baseColor, u.x, u.y, bs);
    } else if (HAS_SMOOTH && type == MATERIAL_MIRROR) {
        sampleReflection(isect, dir, material.baseColor, bs);
    } else if (HAS_SMOOTH && type == MATERIAL_CONDUCTOR) {
        sampleConductor(material, isect, dir, bs);
    } else if (HAS_SMOOTH && type == MATERIAL_DIELECTRIC) {
        sampleDielectric(material, isect, dir, u.x, bs);
    } else if (HAS_SMOOTH && type == MATERIAL_REPORT) {
        sampleReportMaterial(material, isect, dir, u, bs);
    }
    if (HAS_GLOSSY && type >= MATERIAL_ROUGH_CONDUCTOR) sampleGlossy(material, isect, dir, u, bs);
    return bs;
}
