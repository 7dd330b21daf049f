// The random numbers: known values, uniformity, and independence of neighbours.

#include "reference/kernel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace sahl {
namespace {

using reference::Kernel;

/// pcg4d of the paper, written with vectors as there.
glm::uvec4 pcg4d(glm::uvec4 v)
{
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    v = v ^ (v >> 16u);
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    return v;
}

TEST(Hash4, isPcg4dOfThePaper)
{
    Kernel<> kernel;
    for (uint i = 0; i < 1000; i++) {
        glm::uvec4 in(i, i * 7919u, i ^ 0xdeadbeefu, ~i);
        EXPECT_EQ(kernel.hash4(in.x, in.y, in.z, in.w), pcg4d(in));
    }
}

TEST(UnitFloat, staysBelowOne)
{
    Kernel<> kernel;
    EXPECT_EQ(kernel.unitFloat(0), 0.0f);
    EXPECT_EQ(kernel.unitFloat(0xffffffffu), 1.0f - std::ldexp(1.0f, -24));
}

// Chi-squared with 255 degrees of freedom: below 340 with probability 0.9997.
constexpr double CHI2_255 = 340;

TEST(Random4, isUniformAlongPixelsSamplesAndDimensions)
{
    Kernel<> kernel;
    constexpr int N = 1 << 18;
    for (int axis = 0; axis < 3; axis++) {
        int counts[4][256] = {};
        for (uint i = 0; i < N; i++) {
            vec4 u = axis == 0   ? kernel.random4(i, 3, 4)
                     : axis == 1 ? kernel.random4(12345, i, 4)
                                 : kernel.random4(12345, 3, i);
            for (int c = 0; c < 4; c++) counts[c][int(u[c] * 256)]++;
        }
        for (auto& channel : counts) {
            double chi2 = 0;
            for (int count : channel) chi2 += std::pow(count - N / 256.0, 2) / (N / 256.0);
            EXPECT_LT(chi2, CHI2_255) << "axis " << axis;
        }
    }
}

TEST(Random4, hasNoCorrelationBetweenNeighbours)
{
    Kernel<> kernel;
    constexpr int N = 1 << 18;
    // The mean of (u - 1/2)(v - 1/2) over N independent pairs has standard deviation 1/(12 sqrt N).
    const double limit = 4.5 / (12 * std::sqrt(double(N)));
    double pixels = 0, samples = 0, dimensions = 0, channels = 0;
    for (uint i = 0; i < N; i++) {
        vec4 u = kernel.random4(i, 1, 4);
        pixels += (u.x - 0.5) * (kernel.random4(i + 1, 1, 4).x - 0.5);
        samples += (u.x - 0.5) * (kernel.random4(i, 2, 4).x - 0.5);
        dimensions += (u.x - 0.5) * (kernel.random4(i, 1, 8).x - 0.5);
        channels += (u.x - 0.5) * (u.y - 0.5);
    }
    for (double sum : {pixels, samples, dimensions, channels}) EXPECT_LT(std::abs(sum / N), limit);
}

TEST(Random4, dependsOnTheSeed)
{
    Kernel<> a;
    Kernel<> b;
    a.frame.seed = 1;
    b.frame.seed = 2;
    std::set<float> values;
    for (uint i = 0; i < 100; i++) {
        values.insert(a.random4(i, 0, 0).x);
        values.insert(b.random4(i, 0, 0).x);
    }
    EXPECT_GT(values.size(), 195u);
}

}  // namespace
}  // namespace sahl
