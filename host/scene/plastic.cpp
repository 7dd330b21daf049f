#include "scene/plastic.h"

#include "scene/numbers.h"

#include <algorithm>
#include <cmath>

namespace sahl {

namespace {

// As in coat.glsl and microfacet.glsl.
constexpr double MIN_ALPHA = 1e-4;

double fresnel(double cosI, double eta)
{
    const double cosT = std::sqrt(1 - (1 - cosI * cosI) / (eta * eta));
    const double s = (cosI - eta * cosT) / (cosI + eta * cosT);
    const double p = (eta * cosI - cosT) / (eta * cosI + cosT);
    return (s * s + p * p) / 2;
}

double coatReflectance(double cosine, double eta, double alpha)
{
    const double smooth = fresnel(cosine, eta);
    if (alpha < MIN_ALPHA) return smooth;
    const double r = (eta - 1) / (eta + 1), f0 = r * r, x = 1 - cosine;
    const double rough = f0 + (1 - f0) * x * x * x / (1 + alpha * (13 + alpha * 5.5));
    return std::min(1.0, std::min(smooth, rough) + std::min(0.0025, 0.0002 + 0.03 * alpha));
}

}  // namespace

double coatTransmittance(double eta, double roughness)
{
    constexpr int STEPS = 4096;  // of the midpoint rule: an error below 1e-6
    const double alpha = roughness * roughness;
    double sum = 0;
    for (int i = 0; i < STEPS; i++) {
        const double cosine = (i + 0.5) / STEPS;
        sum += (1 - coatReflectance(cosine, eta, alpha)) * 2 * cosine;
    }
    return sum / STEPS;
}

void completePlastic(Material& material)
{
    material.transmission =
        toFloat(coatTransmittance(double{material.eta}, double{material.roughness}));
}

}  // namespace sahl
