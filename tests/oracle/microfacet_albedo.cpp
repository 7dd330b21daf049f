#include "oracle/microfacet_albedo.h"

#include <cmath>
#include <numbers>

namespace textbook {

namespace {

/// Smith's Lambda of GGX for a direction under this cosine: Heitz 2014, Eq. 72.
double lambda(double cosine, double alpha)
{
    const double tangent2 = (1 - cosine * cosine) / (cosine * cosine);
    return (std::sqrt(1 + alpha * alpha * tangent2) - 1) / 2;
}

}  // namespace

/// The integral over the microfacets m of G2 F D(m) (o.m) / (o.n), of those that reflect o to above the
/// surface. With tan^2 = alpha^2 u / (1 - u), D cos dm is du dphi / 2 pi: the midpoint rule over u and
/// phi, in which u = 1 - v^2 spreads the steep end.
double microfacetAlbedo(double cosine, double alpha, const std::function<double(double)>& fresnel)
{
    constexpr int STEPS_V = 600, STEPS_PHI = 240;
    const double sine = std::sqrt(1 - cosine * cosine);
    double sum = 0;
    for (int i = 0; i < STEPS_V; i++) {
        const double v = (i + 0.5) / STEPS_V, u = 1 - v * v;
        const double tangent = alpha * std::sqrt(u) / v;
        const double cosM = 1 / std::sqrt(1 + tangent * tangent), sinM = tangent * cosM;
        for (int j = 0; j < STEPS_PHI; j++) {
            const double phi = std::numbers::pi * (j + 0.5) / STEPS_PHI;
            const double facing = sine * sinM * std::cos(phi) + cosine * cosM;
            const double height = 2 * facing * cosM - cosine;  // of the reflected direction
            if (facing <= 0 || height <= 0) continue;
            const double seen = 1 / (1 + lambda(cosine, alpha) + lambda(height, alpha));
            sum += seen * fresnel(facing) * facing / (cosine * cosM) * 2 * v;
        }
    }
    return sum / (double{STEPS_V} * STEPS_PHI);
}

}  // namespace textbook
