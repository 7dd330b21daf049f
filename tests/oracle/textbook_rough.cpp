#include "oracle/textbook_rough.h"

#include <algorithm>
#include <complex>

namespace textbook {

namespace {

constexpr double SMOOTH = 1e-4;  ///< widths below this are mirrors

Vec white()
{
    return {1, 1, 1};
}

double angleOf(double cosine)
{
    return std::acos(std::clamp(cosine, 0.0, 1.0));
}

double clearReflectance(double cosine, double here, double beyond)
{
    return reflectance(angleOf(cosine), here, beyond);
}

double rise(double cosine)
{
    return std::pow(1 - std::clamp(cosine, 0.0, 1.0), 5);
}

double atRightAngles(double eta)
{
    return std::pow((eta - 1) / (eta + 1), 2);
}

/// Reflectance of one facet, by the cosine of the angle at which light meets it.
Vec facetReflectance(const RoughSurface& s, double cosine)
{
    const Material& m = *s.material;
    switch (m.kind) {
    case Material::roughConductor: {
        const double theta = angleOf(cosine);
        return {reflectance(theta, 1, {m.conductorEta.x, m.conductorK.x}),
                reflectance(theta, 1, {m.conductorEta.y, m.conductorK.y}),
                reflectance(theta, 1, {m.conductorEta.z, m.conductorK.z})};
    }
    case Material::metallicRoughness: {
        const double f0 = atRightAngles(m.eta);
        const double clear = f0 + (1 - f0) * rise(cosine);
        const Vec metal = m.baseColor + (white() - m.baseColor) * rise(cosine);
        return white() * (clear * (1 - m.metallic)) + metal * m.metallic;
    }
    default:
        return white() * clearReflectance(cosine, s.here, s.beyond);
    }
}

/// What the coat is taken to reflect of light under a cosine: docs/materials.md.
double coatAlbedo(const Material& m, double cosine)
{
    const double f0 = atRightAngles(m.eta);
    const double smooth = m.kind == Material::plastic ? clearReflectance(cosine, 1, m.eta)
                                                      : f0 + (1 - f0) * rise(cosine);
    if (m.alpha < SMOOTH) return smooth;
    const double rough = f0 + (1 - f0) * std::pow(1 - cosine, 3) /
                                  (1 + 13 * m.alpha + 5.5 * m.alpha * m.alpha);
    return std::min(1.0, std::min(smooth, rough) + 0.0025);
}

/// GGX, Walter et al. 2007, Eq. 33, by the angle between the normals.
double facets(double cosine, double alpha)
{
    if (cosine <= 0) return 0;
    const double tangent2 = 1 / (cosine * cosine) - 1;
    return alpha * alpha /
           (pi * std::pow(cosine, 4) * std::pow(alpha * alpha + tangent2, 2));
}

double smithLambda(double cosine, double alpha)
{
    const double tangent2 = 1 / (cosine * cosine) - 1;
    return (std::sqrt(1 + alpha * alpha * tangent2) - 1) / 2;
}

/// Share of the facets that both directions see: on one side of the surface the lower of the two counts
/// for both, on two sides each counts by itself.
double visible(double cosA, double cosB, bool sameSide, double alpha)
{
    const double a = smithLambda(cosA, alpha), b = smithLambda(cosB, alpha);
    return sameSide ? 1 / (1 + a + b) : 1 / ((1 + a) * (1 + b));
}

Vec mirrored(Vec v, Vec n)
{
    return v - n * (2 * dot(v, n));
}

bool isCoated(const Material& m)
{
    return m.kind == Material::plastic || m.kind == Material::metallicRoughness;
}

/// The diffuse base under a coat, which light enters and leaves.
Vec baseBsdf(const RoughSurface& s, double cosLight)
{
    const Material& m = *s.material;
    const double ways =
        (1 - coatAlbedo(m, dot(s.viewer, s.normal))) * (1 - coatAlbedo(m, cosLight));
    if (m.kind == Material::metallicRoughness) {
        return m.baseColor *
               (ways * (1 - m.metallic) * (1 - m.transmission) / (m.entering * pi));
    }
    // What the base sends up is reflected back by the coat's inside, again and again.
    const double inside = 1 - m.entering / (m.eta * m.eta);
    Vec sum, order = m.baseColor;
    for (int i = 0; i < 200; i++) {
        sum = sum + order;
        order = order * m.baseColor * inside;
    }
    return sum * (ways / (m.eta * m.eta * pi));
}

/// A facet's normal with density D cosine: Walter et al. 2007, Eq. 35 and 36.
Vec sampleFacet(const RoughSurface& s, const std::function<double()>& uniform)
{
    const double u = uniform(), phi = 2 * pi * uniform();
    const double theta = std::atan(s.material->alpha * std::sqrt(u / (1 - u)));
    const Vec n = s.normal;
    const Vec aside = std::abs(n.x) < 0.5 ? Vec{1, 0, 0} : Vec{0, 1, 0};
    const Vec t = normalized(cross(aside, n)), b = cross(n, t);
    return n * std::cos(theta) + (t * std::cos(phi) + b * std::sin(phi)) * std::sin(theta);
}

/// Snell's law at a facet that faces the viewer; `lost` where nothing passes.
Scattering refracted(const RoughSurface& s, Vec m)
{
    const double cosine = dot(s.viewer, m);
    const Vec along = m * cosine - s.viewer;  // sin(theta) long
    const double sinT = length(along) * s.here / s.beyond;
    if (sinT >= 1) return {{}, {}, true};
    return {normalized(along * (s.here / s.beyond) - m * std::sqrt(1 - sinT * sinT)), {}, false};
}

/// A facet reflects, or glass refracts; weights by Walter et al. 2007, Eq. 41.
Scattering scatterAtFacet(const RoughSurface& s, const std::function<double()>& uniform)
{
    const Material& material = *s.material;
    const bool smooth = material.alpha < SMOOTH;
    const Vec m = smooth ? s.normal : sampleFacet(s, uniform);
    const double cosM = dot(s.viewer, m);
    if (cosM <= 0) return {{}, {}, true};
    Scattering go = {mirrored(-s.viewer, m), facetReflectance(s, cosM), false};
    bool above = true;
    if (material.kind == Material::roughDielectric) {
        if (uniform() < go.weight.x) {
            go.weight = white();
        } else {
            go = refracted(s, m);
            if (go.lost) return go;
            go.weight = material.baseColor * std::pow(s.here / s.beyond, 2);
            above = false;
        }
    }
    const double cosOut = dot(go.out, s.normal);
    if (above ? cosOut <= 0 : cosOut >= 0) return {{}, {}, true};
    if (smooth) return go;
    const double cosView = dot(s.viewer, s.normal);
    const double seen = visible(cosView, std::abs(cosOut), above, material.alpha);
    go.weight = go.weight * (cosM * seen / (cosView * dot(m, s.normal)));
    return go;
}

Vec onSphere(const std::function<double()>& uniform)
{
    const double z = 2 * uniform() - 1, phi = 2 * pi * uniform(), r = std::sqrt(1 - z * z);
    return {r * std::cos(phi), r * std::sin(phi), z};
}

}  // namespace

void finishMaterial(Material& material)
{
    constexpr int STEPS = 20000;
    double sum = 0;
    for (int i = 0; i < STEPS; i++) {
        const double sin2 = (i + 0.5) / STEPS;  // even light has an even sin^2
        sum += 1 - coatAlbedo(material, std::sqrt(1 - sin2));
    }
    material.entering = sum / STEPS;
}

Vec roughBsdf(const RoughSurface& s, Vec light)
{
    const Material& material = *s.material;
    const double cosView = dot(s.viewer, s.normal), cosLight = dot(light, s.normal);
    const bool above = cosLight > 0, glass = material.kind == Material::roughDielectric;
    Vec sum;
    if (isCoated(material) && above) sum = baseBsdf(s, cosLight);
    if (material.alpha < SMOOTH) return sum;
    if (!above && glass) {
        // Walter et al. 2007, Eq. 21, with 1 / n^2 for radiance.
        Vec m = normalized(s.viewer * s.here + light * s.beyond);
        if (dot(m, s.normal) < 0) m = -m;
        const double view = dot(s.viewer, m), lit = dot(light, m);
        if (view <= 0 || lit >= 0) return {};
        const double passes = 1 - clearReflectance(view, s.here, s.beyond);
        const double shape = facets(dot(m, s.normal), material.alpha) *
                             visible(cosView, -cosLight, false, material.alpha);
        const double across = s.here * view + s.beyond * lit;
        return material.baseColor * (view * -lit / (cosView * -cosLight) * s.here * s.here *
                                     passes * shape / (across * across));
    }
    const bool wall = !above && material.kind == Material::metallicRoughness;
    if (!above && !wall) return sum;
    const Vec to = wall ? mirrored(light, s.normal) : light;
    const Vec m = normalized(s.viewer + to);
    const double cosM = dot(m, s.viewer);
    const double lobe = facets(dot(m, s.normal), material.alpha) *
                        visible(cosView, std::abs(cosLight), true, material.alpha) /
                        (4 * cosView * std::abs(cosLight));
    if (!wall) return sum + facetReflectance(s, cosM) * lobe;
    const double f0 = atRightAngles(material.eta);
    const double passes = (1 - f0) * (1 - rise(cosM));
    return material.baseColor *
           ((1 - material.metallic) * material.transmission * passes * lobe);
}

/// Coats toss a coin between the facets and what is under them.
Scattering roughSample(const RoughSurface& s, const std::function<double()>& uniform)
{
    const Material& material = *s.material;
    if (!isCoated(material)) return scatterAtFacet(s, uniform);
    const double coin = uniform();
    if (coin < 0.5) {
        Scattering go = scatterAtFacet(s, uniform);
        go.weight = go.weight * 2;
        return go;
    }
    if (coin < 0.75 && material.transmission > 0) {
        // The facets' lobe on the other side, with what they do not reflect.
        RoughSurface wall = s;
        Scattering go = scatterAtFacet(wall, uniform);
        if (go.lost) return go;
        const double cosM = std::sqrt((1 + dot(go.out, s.viewer)) / 2), f0 = atRightAngles(material.eta);
        const Vec reflected = facetReflectance(s, cosM);
        const double lobe = go.weight.x / reflected.x;
        const double passes = (1 - f0) * (1 - rise(cosM));
        go.out = mirrored(go.out, s.normal);
        go.weight = material.baseColor *
                    (4 * (1 - material.metallic) * material.transmission * passes * lobe);
        return go;
    }
    const double chance = material.transmission > 0 ? 0.25 : 0.5;
    const Vec out = normalized(s.normal + onSphere(uniform));
    return {out, baseBsdf(s, dot(out, s.normal)) * (pi / chance), false};
}

}  // namespace textbook
