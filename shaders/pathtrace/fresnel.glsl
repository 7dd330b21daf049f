// What smooth surfaces reflect.

/// Direction of the mirror reflection of dir at a surface with normal n; both unit.
vec3 reflected(vec3 dir, vec3 n) { return unit(dir - n * (2.0f * dot3(dir, n))); }

/// Reflectance of a smooth dielectric for unpolarised light; 1 under total internal reflection.
///   cosI  cosine of the angle of incidence, in [0,1]
///   eta   index of refraction of the far side relative to the near side, >= 0
///   cosT  cosine of the angle of refraction; 0 under total internal reflection
/// Fresnel's equations, as in Pharr, Jakob, Humphreys 2023, "Physically Based Rendering", Eq. 9.6.
float fresnelDielectric(float cosI, float eta, OUT(float) cosT)
{
    cosT = 0.0f;
    if (!(eta < 1e15f)) return 1.0f;  // its square would overflow

    // (eta cosT)^2 = eta^2 - sinI^2, without its cancellation where eta is about 1 and cosI small
    float etaCosT2 = flushed((eta - 1.0f) * (eta + 1.0f) + cosI * cosI);
    if (!(etaCosT2 > 0.0f)) return 1.0f;
    cosT = min2(1.0f, quotient(root(etaCosT2), eta));
    float parallelSum = eta * cosI + cosT;
    float perpendicularSum = cosI + eta * cosT;
    if (!(parallelSum > 0.0f) || !(perpendicularSum > 0.0f)) return 1.0f;
    float parallel = quotient(eta * cosI - cosT, parallelSum);
    float perpendicular = quotient(cosI - eta * cosT, perpendicularSum);
    return min2(1.0f, 0.5f * (parallel * parallel + perpendicular * perpendicular));
}

/// Direction of the refraction of dir by Snell's law.
///   n           unit normal on the side that dir comes from
///   cosI, cosT  cosines as in fresnelDielectric
///   eta         far side relative to near side, > 0
vec3 refracted(vec3 dir, vec3 n, float cosI, float cosT, float eta)
{
    float ratio = quotient(1.0f, eta);
    return unit((dir + n * cosI) * ratio - n * cosT);
}

/// Reflectance of a smooth conductor with complex index of refraction eta + i k against vacuum, for
/// unpolarised light. Born and Wolf 1999, "Principles of Optics", Sec. 14.2, in the form without complex
/// numbers of Lagarde 2013, "Memo on Fresnel equations".
float fresnelConductor(float cosI, float eta, float k)
{
    float cos2 = cosI * cosI;
    float sin2 = max2(0.0f, 1.0f - cos2);
    float eta2 = eta * eta;
    float k2 = k * k;
    float t0 = (eta2 - k2) - sin2;
    float a2b2 = root(max2(0.0f, t0 * t0 + 4.0f * eta2 * k2));
    float t1 = a2b2 + cos2;
    float a = root(max2(0.0f, 0.5f * (a2b2 + t0)));
    float t2 = 2.0f * a * cosI;
    float perpendicularSum = t1 + t2;
    if (!(perpendicularSum > 0.0f)) return 1.0f;
    float perpendicular = quotient(t1 - t2, perpendicularSum);
    float t3 = cos2 * a2b2 + sin2 * sin2;
    float t4 = t2 * sin2;
    float parallelSum = t3 + t4;
    float parallel = parallelSum > 0.0f ? perpendicular * quotient(t3 - t4, parallelSum) : perpendicular;
    return min2(1.0f, 0.5f * (perpendicular + parallel));
}
