#include "scene/probe_weights.h"

#include "scene/angles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sahl {

namespace {

constexpr double PI = std::numbers::pi;

double luminance(const vec4& texel)
{
    return 0.2126 * double{texel.x} + 0.7152 * double{texel.y} + 0.0722 * double{texel.z};
}

/// How far a texel's colour reaches beyond its border [texels].
double reachOf(const Probe& probe)
{
    return probe.filterMode == FILTER_BILINEAR ? 0.5 : 0;
}

/// Solid angle for an area of the picture, of texels in each row of a lat-long map [sr].
std::vector<double> latLongFactors(const Probe& probe)
{
    const double reach = reachOf(probe);
    std::vector<double> factors(probe.height);
    for (uint32_t y = 0; y < probe.height; y++) {
        const double top = std::max(0.0, y - reach) / probe.height;
        const double bottom = std::min<double>(probe.height, y + 1 + reach) / probe.height;
        factors[y] = 2 * PI * (cosDeg(180 * top) - cosDeg(180 * bottom)) / (bottom - top);
    }
    return factors;
}

/// The same at a point of an angular map, at a distance r from its centre; its rim is at 1/2.
double angularFactor(double r)
{
    if (r >= 0.5) return 0;
    return r > 1e-9 ? 2 * PI * sinDeg(360 * r) / r : 4 * PI * PI;
}

/// Its mean over a texel. Near the rim, where it ends, over a grid of points.
double angularFactor(const Probe& probe, uint32_t x, uint32_t y)
{
    constexpr int POINTS = 5;  // in each direction
    const double size = probe.width, reach = reachOf(probe);
    const auto distance = [&](double fx, double fy) {
        const double u = (x + fx) / size - 0.5, v = (y + fy) / size - 0.5;
        return std::sqrt(u * u + v * v);
    };
    const double centre = distance(0.5, 0.5);
    const double farthest = (0.5 + reach) * std::numbers::sqrt2 / size;
    if (centre < 0.5 - farthest) return angularFactor(centre);
    if (centre > 0.5 + farthest) return 0;
    double sum = 0;
    for (int i = 0; i < POINTS; i++) {
        for (int j = 0; j < POINTS; j++) {
            const auto place = [&](int k) { return (k + 0.5) / POINTS * (1 + 2 * reach) - reach; };
            sum += angularFactor(distance(place(i), place(j)));
        }
    }
    return sum / (POINTS * POINTS);
}

/// Direction that is looked up at (u, v), in the probe's own space, as in probe_sampling.glsl.
/// Nothing beyond the rim of an angular map.
glm::dvec3 directionOf(const Probe& probe, double u, double v)
{
    if (probe.mapping == PROBE_LATLONG) {
        const double sine = sinDeg(180 * v);
        return {-sine * sinDeg(360 * u), cosDeg(180 * v), sine * cosDeg(360 * u)};
    }
    const double right = u - 0.5, up = 0.5 - v;
    const double r = std::sqrt(right * right + up * up);
    if (r >= 0.5) return glm::dvec3(0.0);
    const double scale = r > 1e-9 ? sinDeg(360 * r) / r : 2 * PI;
    return {right * scale, up * scale, -cosDeg(360 * r)};
}

float weightOf(uint64_t mass)
{
    return static_cast<float>(static_cast<double>(mass) * 0x1p-32);
}

}  // namespace

bool isConstant(const Probe& probe, std::span<const vec4> texels)
{
    const auto own = texels.subspan(probe.firstTexel, size_t{probe.width} * probe.height);
    return std::all_of(own.begin(), own.end(),
                       [&](const vec4& texel) { return vec3(texel) == vec3(own[0]); });
}

std::vector<double> texelPowers(const Probe& probe, std::span<const vec4> texels)
{
    const std::vector<double> rows =
        probe.mapping == PROBE_LATLONG ? latLongFactors(probe) : std::vector<double>();
    const double area = 1 / (double(probe.width) * probe.height);
    std::vector<double> powers(size_t{probe.width} * probe.height);
    for (uint32_t y = 0; y < probe.height; y++) {
        for (uint32_t x = 0; x < probe.width; x++) {
            const size_t i = size_t{y} * probe.width + x;
            const double factor = rows.empty() ? angularFactor(probe, x, y) : rows[y];
            powers[i] = luminance(texels[probe.firstTexel + i]) * factor * area;
        }
    }
    return powers;
}

glm::dvec3 powerMoment(const Probe& probe, std::span<const double> powers)
{
    glm::dvec3 sum(0.0);
    for (uint32_t y = 0; y < probe.height; y++) {
        for (uint32_t x = 0; x < probe.width; x++) {
            const double u = (x + 0.5) / probe.width, v = (y + 0.5) / probe.height;
            sum += directionOf(probe, u, v) * powers[size_t{y} * probe.width + x];
        }
    }
    const glm::dmat3 axes(probe.axisX, probe.axisY, probe.axisZ);
    return axes * sum;
}

void writeTexelWeights(const Probe& probe, std::span<const uint64_t> masses, std::span<vec4> texels)
{
    for (size_t i = 0; i < masses.size(); i++) texels[probe.firstTexel + i].w = weightOf(masses[i]);
}

bool hasTexelWeights(const Probe& probe, std::span<const uint64_t> masses,
                     std::span<const vec4> texels)
{
    for (size_t i = 0; i < masses.size(); i++) {
        if (texels[probe.firstTexel + i].w != weightOf(masses[i])) return false;
    }
    return true;
}

}  // namespace sahl
