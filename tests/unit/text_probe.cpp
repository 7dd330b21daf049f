// Which texel of a probe a direction sees, against formulas in double precision.

#include "reference/kernel.h"
#include "scene/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace sahl {
namespace {

using glm::dvec2;
using glm::dvec3;
using reference::Kernel;

/// Debevec's lat-long, from the top left: u = 1/2 + atan2(x, -z) / 2 pi, v = acos(y) / pi.
dvec2 latLong(dvec3 d)
{
    return {0.5 + std::atan2(d.x, -d.z) / (2 * std::numbers::pi), std::acos(d.y) / std::numbers::pi};
}

/// Debevec's angular map with the centre at -Z: r = acos(-z) / (pi sqrt(x^2 + y^2)).
dvec2 angular(dvec3 d)
{
    double r = std::acos(-d.z) / (std::numbers::pi * std::hypot(d.x, d.y));
    return {0.5 * (1 + d.x * r), 0.5 * (1 - d.y * r)};
}

std::vector<dvec3> randomDirections(int count)
{
    std::mt19937_64 random(7);
    std::normal_distribution<double> normal;
    std::vector<dvec3> directions;
    for (int i = 0; i < count; i++) {
        directions.push_back(glm::normalize(dvec3(normal(random), normal(random), normal(random))));
    }
    return directions;
}

/// A kernel whose probe's texel (x, y) has the colour (x + 1/2, y + 1/2, 1).
struct ProbeKernel : Kernel<> {
    ProbeKernel(uint mapping, uint filterMode, uint width, uint height)
    {
        frame.probe = plainProbe(width, height, mapping, filterMode);
        for (uint y = 0; y < height; y++) {
            for (uint x = 0; x < width; x++) texels.emplace_back(float(x) + 0.5f, float(y) + 0.5f, 1, 0);
        }
        probeTexels = texels;
    }
    std::vector<vec4> texels;
};

TEST(LatLong, seesTheAxesWhereDebevecHasThem)
{
    Kernel<> kernel;
    auto near = [&](vec3 d, float u, float v) {
        vec2 uv = kernel.latLongFromDirection(d);
        EXPECT_NEAR(uv.x, u, 1e-7);
        EXPECT_NEAR(uv.y, v, 1e-7);
    };
    near({0, 0, -1}, 0.5f, 0.5f);   // centre
    near({1, 0, 0}, 0.75f, 0.5f);   // to the right
    near({-1, 0, 0}, 0.25f, 0.5f);  // to the left
    EXPECT_NEAR(kernel.latLongFromDirection({0, 1, 0}).y, 0, 1e-7);   // top row
    EXPECT_NEAR(kernel.latLongFromDirection({0, -1, 0}).y, 1, 1e-7);  // bottom row
    float back = kernel.latLongFromDirection({0, 0, 1}).x;            // both ends
    EXPECT_TRUE(back == 0.0f || back == 1.0f);
}

TEST(AngularMap, seesTheAxesWhereDebevecHasThem)
{
    Kernel<> kernel;
    auto near = [&](vec3 d, float u, float v) {
        vec2 uv = kernel.angularMapFromDirection(d);
        EXPECT_NEAR(uv.x, u, 1e-7);
        EXPECT_NEAR(uv.y, v, 1e-7);
    };
    near({0, 0, -1}, 0.5f, 0.5f);
    near({1, 0, 0}, 0.75f, 0.5f);  // half way to the rim
    near({-1, 0, 0}, 0.25f, 0.5f);
    near({0, 1, 0}, 0.5f, 0.25f);  // up is towards the top
    near({0, -1, 0}, 0.5f, 0.75f);
    vec2 back = kernel.angularMapFromDirection({0, 0, 1});
    EXPECT_NEAR(std::hypot(back.x - 0.5, back.y - 0.5), 0.5, 1e-7);  // on the rim
}

TEST(ProbeMappings, agreeWithDoublePrecisionOnRandomDirections)
{
    Kernel<> kernel;
    for (dvec3 d : randomDirections(1000)) {
        vec3 direction = vec3(d);
        dvec2 flat = latLong(d);
        vec2 uv = kernel.latLongFromDirection(direction);
        EXPECT_NEAR(uv.x, flat.x, 2e-7);
        EXPECT_NEAR(uv.y, flat.y, 2e-7);
        dvec2 round = angular(d);
        uv = kernel.angularMapFromDirection(direction);
        // Near the rim the angle is divided by a small sine whose own rounding counts.
        double sine = std::hypot(d.x, d.y);
        EXPECT_NEAR(uv.x, round.x, 3e-7 / sine);
        EXPECT_NEAR(uv.y, round.y, 3e-7 / sine);
    }
}

TEST(EvalProbe, nearestGivesTheTexelThatHoldsThePoint)
{
    for (auto [mapping, width, height] : {std::tuple{PROBE_LATLONG, 64u, 32u}, {PROBE_ANGULAR, 48u, 48u}}) {
        ProbeKernel kernel(mapping, FILTER_NEAREST, width, height);
        int compared = 0;
        for (dvec3 d : randomDirections(1000)) {
            dvec2 uv = mapping == PROBE_LATLONG ? latLong(d) : angular(d);
            dvec2 at = uv * dvec2(width, height);
            // Points within rounding of a texel's border may go either way.
            dvec2 within = glm::abs(glm::fract(at) - 0.5);
            if (std::max(within.x, within.y) > 0.4999) continue;
            vec3 texel = kernel.evalProbe(kernel.frame.probe, vec3(d));
            EXPECT_EQ(texel.x, float(std::floor(at.x)) + 0.5f);
            EXPECT_EQ(texel.y, float(std::floor(at.y)) + 0.5f);
            compared++;
        }
        EXPECT_GT(compared, 990);
    }
}

TEST(EvalProbe, bilinearInterpolatesBetweenTexelCentres)
{
    // Texel (x, y) has its centre's coordinates as colour, so the filter must give the point itself,
    // except in the half texel at a border.
    for (auto [mapping, width, height] : {std::tuple{PROBE_LATLONG, 64u, 32u}, {PROBE_ANGULAR, 48u, 48u}}) {
        ProbeKernel kernel(mapping, FILTER_BILINEAR, width, height);
        int compared = 0;
        for (dvec3 d : randomDirections(1000)) {
            dvec2 at = (mapping == PROBE_LATLONG ? latLong(d) : angular(d)) * dvec2(width, height);
            if (at.x < 0.5 || at.y < 0.5 || at.x > width - 0.5 || at.y > height - 0.5) continue;
            if (mapping == PROBE_ANGULAR && std::hypot(d.x, d.y) < 0.1) continue;
            vec3 colour = kernel.evalProbe(kernel.frame.probe, vec3(d));
            EXPECT_NEAR(colour.x, at.x, 1e-3);
            EXPECT_NEAR(colour.y, at.y, 1e-3);
            EXPECT_NEAR(colour.z, 1, 1e-6);
            compared++;
        }
        EXPECT_GT(compared, 900);
    }
}

TEST(EvalProbe, latLongGoesRoundWithoutASeam)
{
    ProbeKernel kernel(PROBE_LATLONG, FILTER_BILINEAR, 8, 4);
    for (vec4& texel : kernel.texels) texel = vec4(0);
    for (uint y = 0; y < 4; y++) kernel.texels[y * 8] = vec4(1);  // leftmost column
    // +Z lies on the seam, half way between the last and the first column.
    EXPECT_NEAR(kernel.evalProbe(kernel.frame.probe, vec3(0, 0, 1)).x, 0.5, 1e-5);
    EXPECT_NEAR(kernel.evalProbe(kernel.frame.probe, kernel.unit(vec3(1e-4f, 0, 1))).x, 0.5, 1e-3);
    EXPECT_NEAR(kernel.evalProbe(kernel.frame.probe, kernel.unit(vec3(-1e-4f, 0, 1))).x, 0.5, 1e-3);
}

TEST(EvalProbe, withoutProbeIsBlack)
{
    Kernel<> kernel;
    kernel.frame.probe = {};
    EXPECT_EQ(kernel.evalProbe(kernel.frame.probe, vec3(0, 0, 1)), vec3(0));
}

}  // namespace
}  // namespace sahl
