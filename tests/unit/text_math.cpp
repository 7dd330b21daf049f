// The text's own functions against the C++ library in double precision.

#include "reference/kernel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace sahl {
namespace {

using reference::Kernel;

constexpr double TWO_PI = 2 * std::numbers::pi;

// 2^-20 steps of a turn: every eighth of a turn and its neighbourhood is among them.
constexpr int STEPS = 1 << 20;

TEST(SinCosTurns, isWithin12e8OfTheLibrary)
{
    Kernel<> kernel;
    double worst = 0;
    for (int i = 0; i <= STEPS; i++) {
        float turns = float(i) / STEPS;
        float s, c;
        kernel.sinCosTurns(turns, s, c);
        worst = std::max({worst, std::abs(s - std::sin(TWO_PI * turns)), std::abs(c - std::cos(TWO_PI * turns))});
    }
    EXPECT_LT(worst, 1.2e-7);
}

TEST(SinCosTurns, isExactAtQuartersOfATurn)
{
    Kernel<> kernel;
    const float expected[5][2] = {{0, 1}, {1, 0}, {0, -1}, {-1, 0}, {0, 1}};
    for (int quarter = 0; quarter <= 4; quarter++) {
        float s, c;
        kernel.sinCosTurns(float(quarter) * 0.25f, s, c);
        EXPECT_EQ(s, expected[quarter][0]) << quarter;
        EXPECT_EQ(c, expected[quarter][1]) << quarter;
    }
}

TEST(Atan2Turns, isWithin4e8OfTheLibrary)
{
    Kernel<> kernel;
    double worst = 0;
    for (int i = 0; i < STEPS; i++) {
        double angle = TWO_PI * (i + 0.5) / STEPS - std::numbers::pi;
        float x = float(std::cos(angle));
        float y = float(std::sin(angle));
        double error = kernel.atan2Turns(y, x) - std::atan2(double(y), double(x)) / TWO_PI;
        worst = std::max(worst, std::abs(error));
    }
    EXPECT_LT(worst, 4e-8);
}

TEST(Atan2Turns, isRightOnTheAxes)
{
    Kernel<> kernel;
    EXPECT_EQ(kernel.atan2Turns(0, 1), 0.0f);
    EXPECT_EQ(kernel.atan2Turns(1, 0), 0.25f);
    EXPECT_EQ(kernel.atan2Turns(-1, 0), -0.25f);
    EXPECT_EQ(std::abs(kernel.atan2Turns(0, -1)), 0.5f);
    EXPECT_EQ(kernel.atan2Turns(0, 0), 0.0f);
}

/// Numbers from 1e-30 up, in equal steps of their bits, and the neighbourhood of 1.
std::vector<float> positiveNumbers()
{
    std::vector<float> numbers;
    for (glm::uint bits = glm::floatBitsToUint(1e-30f); bits < glm::floatBitsToUint(1e30f); bits += 1021) {
        numbers.push_back(glm::uintBitsToFloat(bits));
    }
    for (int i = -1000; i <= 1000; i++) {
        numbers.push_back(glm::uintBitsToFloat(glm::floatBitsToUint(1.0f) + glm::uint(i)));
    }
    return numbers;
}

TEST(Log2Of, isWithin3e7OfTheLibraryEverywhere)
{
    Kernel<> kernel;
    double worst = 0;
    for (float x : positiveNumbers()) {
        double exact = std::log2(double(x));
        double found = kernel.log2Of(x);
        if (exact == 0) {
            EXPECT_EQ(found, 0.0);
        } else {
            worst = std::max(worst, std::abs(found / exact - 1));
        }
    }
    EXPECT_LT(worst, 3e-7);
    RecordProperty("worst", std::to_string(worst * 1e9));
}

TEST(Exp2Of, isWithin2e7OfTheLibrary)
{
    Kernel<> kernel;
    double worst = 0;
    for (int i = -126 * 4096; i <= 126 * 4096; i++) {
        float y = float(i) / 4096;
        worst = std::max(worst, std::abs(kernel.exp2Of(y) / std::exp2(double(y)) - 1));
    }
    EXPECT_LT(worst, 2e-7);
    for (int k = -126; k <= 126; k++) EXPECT_EQ(kernel.exp2Of(float(k)), std::ldexp(1.0f, k));
}

TEST(Power, isWithinItsStatedErrorOfTheLibrary)
{
    Kernel<> kernel;
    double worst = 0;
    int compared = 0;
    for (float n : {1e-30f, 0.01f, 0.5f, 1.0f, 2.0f, 7.3f, 50.0f, 1000.0f, 31415.9f, 1e6f}) {
        for (float x : positiveNumbers()) {
            if (x > 1 || x <= 1e-30f) continue;  // which counts as 0
            double exact = std::pow(double(x), double(n));
            float found = kernel.power(x, n);
            ASSERT_TRUE(found >= 0 && found <= 1) << x << "^" << n << " = " << found;
            if (exact < 1.6e-30) {
                ASSERT_LT(found, 1.7e-30f) << x << "^" << n;
                continue;
            }
            double bound = 3e-7 * (1 + std::abs(std::log(exact)));
            worst = std::max(worst, std::abs(found / exact - 1) / bound);
            compared++;
        }
    }
    EXPECT_LT(worst, 1);
    EXPECT_GT(compared, 1000000);
}

TEST(Power, isExactWhereItsValueIsPlain)
{
    Kernel<> kernel;
    for (float n : {1e-30f, 0.5f, 1.0f, 50.0f, 1e6f, 3e38f}) {
        EXPECT_EQ(kernel.power(1, n), 1.0f) << n;
        EXPECT_EQ(kernel.power(0, n), 0.0f) << n;
    }
    for (float x : {0.0f, 1e-30f, 0.3f, 1.0f}) EXPECT_EQ(kernel.power(x, 0), 1.0f) << x;
    EXPECT_EQ(kernel.power(0.5f, 1), 0.5f);
    EXPECT_EQ(kernel.power(0.25f, 0.5f), 0.5f);
    EXPECT_EQ(kernel.power(0.5f, 99), std::ldexp(1.0f, -99));
    EXPECT_EQ(kernel.power(0.5f, 99.01f), 0.0f);
    EXPECT_EQ(kernel.power(0.5f, 3e38f), 0.0f);
}

TEST(Selects, agreeWithTheLibraryOnNumbers)
{
    Kernel<> kernel;
    for (float a : {-2.0f, 0.0f, 1e-38f, 3.5f}) {
        for (float b : {-1e30f, -0.0f, 2.0f}) {
            EXPECT_EQ(kernel.min2(a, b), std::fmin(a, b));
            EXPECT_EQ(kernel.max2(a, b), std::fmax(a, b));
        }
        EXPECT_EQ(kernel.absolute(a), std::fabs(a));
    }
    EXPECT_FALSE(std::signbit(kernel.absolute(-0.0f)));
}

TEST(IsFiniteNumber, knowsInfinityAndNan)
{
    Kernel<> kernel;
    EXPECT_TRUE(kernel.isFiniteNumber(0));
    EXPECT_TRUE(kernel.isFiniteNumber(-3.4e38f));
    EXPECT_FALSE(kernel.isFiniteNumber(INFINITY));
    EXPECT_FALSE(kernel.isFiniteNumber(-INFINITY));
    EXPECT_FALSE(kernel.isFiniteNumber(NAN));
}

TEST(Flushed, makesTinyNumbersZero)
{
    Kernel<> kernel;
    EXPECT_EQ(kernel.flushed(1e-31f), 0.0f);
    EXPECT_EQ(kernel.flushed(-1e-39f), 0.0f);
    EXPECT_EQ(kernel.flushed(2e-30f), 2e-30f);
}

/// ITU-R BT.709, item 3.2.
TEST(Luminance, weighsRedGreenAndBlueAsRec709Does)
{
    Kernel<> kernel;
    EXPECT_EQ(kernel.luminance({1, 0, 0}), 0.2126f);
    EXPECT_EQ(kernel.luminance({0, 1, 0}), 0.7152f);
    EXPECT_EQ(kernel.luminance({0, 0, 1}), 0.0722f);
    EXPECT_FLOAT_EQ(kernel.luminance({1, 1, 1}), 1);
}

TEST(TangentFrame, isOrthonormalAndRightHanded)
{
    Kernel<> kernel;
    for (int i = 0; i < 10000; i++) {
        vec4 u = kernel.random4(uint(i), 0, 0);
        vec3 n = kernel.unit(vec3(u.x - 0.5f, u.y - 0.5f, u.z - 0.5f));
        vec3 t, b;
        kernel.tangentFrame(n, t, b);
        EXPECT_NEAR(kernel.dot3(t, n), 0, 1e-6);
        EXPECT_NEAR(kernel.dot3(b, n), 0, 1e-6);
        EXPECT_NEAR(kernel.dot3(t, b), 0, 1e-6);
        EXPECT_NEAR(kernel.dot3(kernel.cross3(t, b), n), 1, 2e-6);
    }
}

}  // namespace
}  // namespace sahl
