// Plastic: a diffuse base under a clear coat, smooth or rough.
//
// Light enters through the coat, is scattered by the base, and either leaves or is reflected back to
// it from inside. With T(cosine) the coat's transmittance, t its average over the hemisphere and
// k = 1 - t / eta^2 what it reflects of diffuse light from inside,
//   f = T(wo) T(wi) rho / (pi eta^2 (1 - k rho))
// beside the coat's own reflection. A white base returns all that enters. After pbrt's and Mitsuba's
// materials; the factors are symmetric, so light may go either way.

float plasticCoat(READ(Material) material, float cosine)
{
    float cosT;
    float fresnel = fresnelDielectric(min2(1.0f, cosine), material.eta, cosT);
    return coatReflectance(cosine, alphaOf(material), fresnel, normalReflectance(material.eta));
}

/// The base's share of the BSDF without T(wo), T(wi) and 1 / pi.
vec3 plasticBase(READ(Material) material)
{
    float eta2 = material.eta * material.eta;
    float k = 1.0f - quotient(material.transmission, eta2);
    vec3 rho = material.baseColor;
    return vec3(quotient(rho.x, eta2 * (1.0f - k * rho.x)), quotient(rho.y, eta2 * (1.0f - k * rho.y)),
                quotient(rho.z, eta2 * (1.0f - k * rho.z)));
}

/// coat: plasticCoat towards wo.
LobeChances plasticChances(READ(Material) material, float coat)
{
    float returned = material.transmission * maxComponent(plasticBase(material));
    return lobeChances(coat, (1.0f - coat) * returned, 0.0f);
}
