// Russian roulette and the clamp of indirect light: single decisions, with known answers.

#include "reference/kernel.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sahl {
namespace {

using Kernel = reference::Kernel<>;

TEST(Roulette, survivalIsTheFourthRootOfTheThroughputsLargestChannel)
{
    Kernel kernel = {};
    EXPECT_EQ(kernel.survivalOf({0.03125f, 0.0625f, 0.015625f}, 1), 0.5f);
    EXPECT_EQ(kernel.survivalOf({0.25f, 2, 0.125f}, 1), 1);
    EXPECT_EQ(kernel.survivalOf(vec3(1e-9f), 1), 0.05f) << "no path may come back too bright";
    EXPECT_EQ(kernel.survivalOf(vec3(1 / 2.25f), 2.25f), 1)
        << "a path in glass is lent its radiance";
}

PathState pathOf(uint depth, vec3 beta, uint sampleIndex)
{
    PathState path = {};
    path.depth = depth;
    path.beta = beta;
    path.etaScale = 1;
    path.sampleIndex = sampleIndex;
    return path;
}

TEST(Roulette, playsFromItsDepthOn)
{
    Kernel kernel = {};
    kernel.frame.rouletteDepth = 3;
    auto survivors = [&](uint depth) {
        uint count = 0;
        for (uint i = 0; i < 1000; i++) {
            PathState path = pathOf(depth, vec3(0.0036f, 0.005625f, 0.0081f), i);
            if (!kernel.survivesRoulette(4, path)) continue;
            count++;
            if (depth < kernel.frame.rouletteDepth) {
                EXPECT_EQ(path.beta, vec3(0.0036f, 0.005625f, 0.0081f));
            } else {
                EXPECT_FLOAT_EQ(path.beta.x, 0.0036f / 0.3f);
                EXPECT_FLOAT_EQ(path.beta.z, 0.027f);
            }
        }
        return count;
    };
    EXPECT_EQ(survivors(2), 1000u);
    EXPECT_NEAR(survivors(3), 300, 4.5 * 14.5);  // sqrt(1000 0.3 0.7)
    EXPECT_NEAR(survivors(70), 300, 4.5 * 14.5);
    kernel.frame.rouletteDepth = NO_ROULETTE;
    EXPECT_EQ(survivors(70), 1000u);
}

/// Who goes on must not hang on where to. Directions by the cosine have a mean cosine of 2/3 with a
/// variance of 1/2 - 4/9, and across the normal the mean 0 with a variance of 1/4.
TEST(Roulette, takesPathsOfAllDirectionsAlike)
{
    Kernel kernel = {};
    Material material = {};
    material.type = MATERIAL_LAMBERT;
    material.baseColor = vec3(0.0081f);
    Kernel::SurfaceInteraction isect = {};
    isect.ng = isect.ns = isect.nsStored = vec3(0, 0, 1);
    isect.front = true;
    for (const uint sampler : {SAMPLER_INDEPENDENT, SAMPLER_SOBOL}) {
        kernel.frame.samplerKind = sampler;
        int count = 0;
        double height = 0, across = 0, along = 0;
        for (uint i = 0; i < 20000; i++) {
            PathState path = pathOf(0, vec3(1), i);
            const vec4 u = kernel.random4(path.pixel, i, Kernel::DIMENSION_FIRST_VERTEX);
            path.dir = vec3(0, 0, -1);
            if (kernel.sampleNextRay(material, isect, Kernel::DIMENSION_FIRST_VERTEX, u, path) ==
                Kernel::LOBE_NONE)
                continue;
            count++;
            height += double(path.dir.z);
            across += double(path.dir.x);
            along += double(path.dir.y);
        }
        EXPECT_NEAR(count, 6000, 4.5 * std::sqrt(20000 * 0.3 * 0.7));
        EXPECT_NEAR(height / count, 2.0 / 3, 4.5 * std::sqrt(1.0 / 18 / count));
        EXPECT_NEAR(across / count, 0, 4.5 * std::sqrt(0.25 / count));
        EXPECT_NEAR(along / count, 0, 4.5 * std::sqrt(0.25 / count));
    }
}

TEST(ClampIndirect, scalesWhatIsTooBrightAndCountsIt)
{
    Kernel kernel = {};
    kernel.frame.clampIndirect = 2;
    PathState path = {};
    kernel.gather(vec3(10, 20, 40), 1, path);
    EXPECT_EQ(path.L, vec3(10, 20, 40)) << "direct light";
    EXPECT_EQ(kernel.tally.clamped, 0u);
    path.L = vec3(0);
    kernel.gather(vec3(10, 20, 40), 2, path);
    EXPECT_NEAR(kernel.luminance(path.L), 2, 1e-6);
    EXPECT_FLOAT_EQ(path.L.y, 2 * path.L.x) << "its colour stays";
    EXPECT_EQ(kernel.tally.clamped, 1u);
    kernel.gather(vec3(1.9f), 2, path);
    EXPECT_NEAR(kernel.luminance(path.L), 3.9, 1e-5) << "each contribution by itself";
    EXPECT_EQ(kernel.tally.clamped, 1u);
    kernel.frame.clampIndirect = 0;
    path.L = vec3(0);
    kernel.gather(vec3(1e9f), 9, path);
    EXPECT_EQ(path.L, vec3(1e9f)) << "off";
}

}  // namespace
}  // namespace sahl
