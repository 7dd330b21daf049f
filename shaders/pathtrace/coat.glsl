// A diffuse base under a smooth or rough coat: how much of the light the coat lets through. All that
// the coat does not reflect reaches the base, so nothing may be counted twice: `coatReflectance` is
// never below the coat's true directional albedo, and above it by 2 % on average.

/// Share of Fresnel's rise towards grazing angles that is left when the coat is rough. With the form
/// of coatReflectance fitted from above to the albedo of GGX, for alpha from 1e-4 to 1.
float grazingShare(float alpha)
{
    return quotient(1.0f, 1.0f + alpha * (13.0f + alpha * 5.5f));
}

/// What the fit may be below the truth: least where the coat is nearly smooth.
float coatMargin(float alpha) { return min2(0.0025f, alpha * 0.03f + 0.0002f); }

/// Light that a coat reflects of what arrives under a cosine, at once or by its microfacets.
///   fresnel  reflectance of a smooth coat at this cosine
///   f0       and at normal incidence
float coatReflectance(float cosine, float alpha, float fresnel, float f0)
{
    if (alpha < MIN_ALPHA) return fresnel;
    float x = 1.0f - min2(1.0f, cosine);
    float rough = f0 + (1.0f - f0) * (grazingShare(alpha) * (x * x * x));
    return min2(1.0f, min2(fresnel, rough) + coatMargin(alpha));
}

/// Reflectance at normal incidence of an index of refraction.
float normalReflectance(float eta)
{
    float r = quotient(eta - 1.0f, eta + 1.0f);
    return r * r;
}

/// Probabilities with which lobes are sampled: by what they return of wo's light.
struct LobeChances
{
    float coat;
    float diffuse;
    float through;  // a thin wall
};

LobeChances lobeChances(float coat, float diffuse, float through)
{
    float sum = (coat + diffuse) + through;
    float scale = sum > 1e-20f ? quotient(1.0f, sum) : 0.0f;
    LobeChances c;
    c.coat = coat * scale;
    c.diffuse = diffuse * scale;
    c.through = through * scale;
    return c;
}
