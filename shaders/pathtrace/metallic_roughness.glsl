// glTF's material: between a metal of colour baseColor and a dielectric, whose base is diffuse or lets
// light through as a thin wall does (KHR_materials_transmission, KHR_materials_ior).
// Khronos 2021, "glTF 2.0 Specification", Appendix B, but for two things:
//   - the shadowing is correlated by height, as in Khronos' own viewer;
//   - the diffuse base gets what the coat lets through on the way in and out (coat.glsl), where the
//     appendix has 1 - F(wo.m), which at grazing angles returns nearly twice the light that arrives.

/// Schlick 1994, "An Inexpensive BRDF Model for Physically-based Rendering": the rise of reflectance
/// from its value at normal incidence, 0, to 1 at grazing angles.
float schlickRise(float cosine)
{
    float x = 1.0f - min2(1.0f, cosine);
    float x2 = x * x;
    return (x2 * x2) * x;
}

float dielectricSchlick(READ(Material) material, float cosine)
{
    float f0 = normalReflectance(material.eta);
    return f0 + (1.0f - f0) * schlickRise(cosine);
}

vec3 metalSchlick(READ(Material) material, float cosine)
{
    return material.baseColor + (vec3(1.0f) - material.baseColor) * schlickRise(cosine);
}

/// Reflectance of a microfacet.
vec3 metallicFresnel(READ(Material) material, float cosM)
{
    return vec3(dielectricSchlick(material, cosM) * (1.0f - material.metallic)) +
           metalSchlick(material, cosM) * material.metallic;
}

float schlickCoat(READ(Material) material, float cosine)
{
    return coatReflectance(cosine, alphaOf(material), dielectricSchlick(material, cosine),
                           normalReflectance(material.eta));
}

/// Average of schlickCoat over the hemisphere, weighted by the cosine: with x = 1 - cosine the integral
/// of 2 (1 - x) min(x^5, s x^3), of which the two parts meet at x^2 = s.
float schlickCoatAverage(READ(Material) material)
{
    float alpha = alphaOf(material);
    float f0 = normalReflectance(material.eta);
    if (alpha < MIN_ALPHA) return f0 + (1.0f - f0) * 0.0476190476f;
    float s = grazingShare(alpha);
    float s2 = s * s;
    float x = root(s);
    float steep = (s2 * s) * (0.333333333f - x * 0.285714286f);
    float gentle = s * (0.1f - s2 * (0.5f - x * 0.4f));
    return min2(1.0f, f0 + (1.0f - f0) * (steep + gentle) + coatMargin(alpha));
}

/// coat: schlickCoat towards wo.
LobeChances metallicChances(READ(Material) material, float cosO, float coat)
{
    float dielectric = 1.0f - material.metallic;
    float entering = dielectric * ((1.0f - coat) * maxComponent(material.baseColor));
    float metal = material.metallic * maxComponent(metalSchlick(material, cosO));
    return lobeChances(dielectric * coat + metal, (1.0f - material.transmission) * entering,
                       material.transmission * entering);
}

/// Colour of the share of the dielectric that is diffuse, or that is a thin wall.
vec3 baseShare(READ(Material) material, float share)
{
    return material.baseColor * ((1.0f - material.metallic) * share);
}

/// The diffuse base's share of the BSDF without what the coat lets through on either way and 1 / pi.
vec3 metallicBase(READ(Material) material)
{
    float entering = 1.0f - schlickCoatAverage(material);
    if (!(entering > 0.0f)) return vec3(0.0f);
    return baseShare(material, quotient(1.0f - material.transmission, entering));
}
