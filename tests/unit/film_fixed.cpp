// 64.64 fixed point against 128-bit integers of the compiler and against known values.
#include "film/film.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>

namespace sahl {
namespace {

__extension__ using Wide = unsigned __int128;

Wide wide(Fixed64x64 value)
{
    return Wide{value.whole} << 64 | value.fraction;
}

constexpr uint64_t ALL_ONES = std::numeric_limits<uint64_t>::max();
constexpr Fixed64x64 LARGEST = {ALL_ONES, ALL_ONES};

/// Any mantissa, any exponent of that range.
float randomFloat(std::mt19937& random, int lowest, int highest)
{
    const int exponent = 127 + lowest + static_cast<int>(random() % (highest - lowest + 1));
    const uint32_t mantissa = random() & 0x7fffffu;
    return std::bit_cast<float>(static_cast<uint32_t>(exponent) << 23 | mantissa);
}

TEST(Fixed64x64, fromFloat_givesKnownValues)
{
    EXPECT_EQ(Fixed64x64::fromFloat(0.0f), (Fixed64x64{0, 0}));
    EXPECT_EQ(Fixed64x64::fromFloat(-0.0f), (Fixed64x64{0, 0}));
    EXPECT_EQ(Fixed64x64::fromFloat(1.0f), (Fixed64x64{1, 0}));
    EXPECT_EQ(Fixed64x64::fromFloat(2.75f), (Fixed64x64{2, 0xc000000000000000u}));
    EXPECT_EQ(Fixed64x64::fromFloat(0x1p-64f), (Fixed64x64{0, 1}));
    EXPECT_EQ(Fixed64x64::fromFloat(0x1.8p-64f), (Fixed64x64{0, 1}));
    EXPECT_EQ(Fixed64x64::fromFloat(0x1.fffffep-65f), (Fixed64x64{0, 0}));
    EXPECT_EQ(Fixed64x64::fromFloat(0x1p-149f), (Fixed64x64{0, 0}));
    EXPECT_EQ(Fixed64x64::fromFloat(0x1p63f), (Fixed64x64{uint64_t{1} << 63, 0}));
    EXPECT_EQ(Fixed64x64::fromFloat(0x1.fffffep63f), (Fixed64x64{uint64_t{0xffffff} << 40, 0}));
}

TEST(Fixed64x64, fromDouble_isThatOfFloatAndKeepsWhatFloatCuts)
{
    std::mt19937 random(4);
    for (int i = 0; i < 10000; i++) {
        const float value = randomFloat(random, -100, 70);
        EXPECT_EQ(Fixed64x64::fromDouble(double{value}), Fixed64x64::fromFloat(value)) << value;
    }
    EXPECT_EQ(Fixed64x64::fromDouble(0x1.0000000000001p0), (Fixed64x64{1, uint64_t{1} << 12}));
    EXPECT_EQ(Fixed64x64::fromDouble(0x1.fffffffffffffp63), (Fixed64x64{~uint64_t{0} << 11, 0}));
    EXPECT_EQ(Fixed64x64::fromDouble(0x1.8p-64), (Fixed64x64{0, 1}));
    EXPECT_EQ(Fixed64x64::fromDouble(0x1.fffffffffffffp-65), (Fixed64x64{}));
    EXPECT_EQ(Fixed64x64::fromDouble(0x1p64), LARGEST);
    EXPECT_EQ(Fixed64x64::fromDouble(INFINITY), LARGEST);
    EXPECT_EQ(Fixed64x64::fromDouble(0x1p-1074), (Fixed64x64{}));
}

TEST(Fixed64x64, subtract_takesAwayWhatWasAddedUnlessTheSumIsSaturated)
{
    std::mt19937 random(3);
    for (int i = 0; i < 1000; i++) {
        const Fixed64x64 first = Fixed64x64::fromFloat(randomFloat(random, -60, 60));
        const Fixed64x64 second = Fixed64x64::fromFloat(randomFloat(random, -60, 60));
        Fixed64x64 sum = first;
        sum.add(second);
        EXPECT_EQ(wide(sum), wide(first) + wide(second));
        sum.subtract(first);
        EXPECT_EQ(sum, second);
    }
    Fixed64x64 saturated = LARGEST;
    saturated.subtract({1, 0});
    EXPECT_EQ(saturated, LARGEST);
}

TEST(Fixed64x64, fromFloat_saturatesFromTwoToThe64Up)
{
    for (float value : {0x1p64f, 1e30f, 0x1.fffffep127f, INFINITY}) {
        EXPECT_EQ(Fixed64x64::fromFloat(value), LARGEST) << value;
    }
}

TEST(Fixed64x64, fromFloat_cutsLikeExactArithmetic)
{
    std::mt19937 random(1);
    for (int i = 0; i < 100000; i++) {
        const float value = randomFloat(random, -90, 63);
        const Wide expected =
            value < 1 ? static_cast<Wide>(std::ldexp(value, 64))
                      : static_cast<Wide>(value) << 64 |
                            static_cast<uint64_t>(std::ldexp(value - std::floor(value), 64));
        ASSERT_TRUE(wide(Fixed64x64::fromFloat(value)) == expected) << value;
    }
}

TEST(Fixed64x64, add_equals128BitArithmetic)
{
    std::mt19937_64 random(2);
    int saturated = 0;
    for (int i = 0; i < 100000; i++) {
        // Shifted so that carries, sums that just fit and overflows all happen.
        const Fixed64x64 a = {random() >> random() % 4, random()};
        const Fixed64x64 b = {i % 7 == 0 ? ~a.whole : random() >> random() % 4,
                              i % 14 == 0 ? 0 - a.fraction : random()};
        const Wide exact = wide(a) + wide(b);
        const bool overflow = exact < wide(a);
        Fixed64x64 sum = a;
        sum.add(b);
        ASSERT_TRUE(wide(sum) == (overflow ? ~Wide{0} : exact));
        saturated += overflow;
    }
    EXPECT_GT(saturated, 1000);
    EXPECT_LT(saturated, 99000);
}

TEST(Fixed64x64, add_staysAtTheTop)
{
    Fixed64x64 sum = LARGEST;
    sum.add({0, 1});
    EXPECT_EQ(sum, LARGEST);
    sum.add(LARGEST);
    EXPECT_EQ(sum, LARGEST);
    Fixed64x64 edge = {ALL_ONES, ALL_ONES - 1};
    edge.add({0, 1});
    EXPECT_EQ(edge, LARGEST);
}

TEST(Fixed64x64, add_doesNotDependOnTheOrder)
{
    std::mt19937 random(3);
    for (int largestExponent : {40, 66}) {  // the second lets the sum saturate
        std::vector<Fixed64x64> terms;
        for (int i = 0; i < 10000; i++) {
            const int exponent = static_cast<int>(random() % 100) - 100 + largestExponent;
            terms.push_back(Fixed64x64::fromFloat(
                std::ldexp(static_cast<float>(random() % 16777216) / 16777216.0f, exponent)));
        }
        Fixed64x64 first;
        for (Fixed64x64 term : terms) first.add(term);
        for (int round = 0; round < 10; round++) {
            std::shuffle(terms.begin(), terms.end(), random);
            Fixed64x64 sum, upper;
            for (size_t i = 0; i < terms.size(); i++) (i % 3 == 0 ? upper : sum).add(terms[i]);
            sum.add(upper);
            ASSERT_EQ(sum, first);
        }
        EXPECT_EQ(first == LARGEST, largestExponent == 66);
    }
}

TEST(Fixed64x64, toDouble_undoesFromFloat)
{
    std::mt19937 random(4);
    for (int i = 0; i < 10000; i++) {
        // The last bit of the mantissa is at least 2^-64.
        const float value = randomFloat(random, -41, 63);
        ASSERT_EQ(Fixed64x64::fromFloat(value).toDouble(), value);
    }
}

TEST(Fixed64x64, toDouble_roundsToNearest)
{
    // 53 bits fit: 2^53 + 1/2 is half way only with nothing behind it, and then goes to even.
    const uint64_t two53 = uint64_t{1} << 53;
    const uint64_t half = uint64_t{1} << 63;
    EXPECT_EQ((Fixed64x64{two53, half}.toDouble()), 0x1p53);
    EXPECT_EQ((Fixed64x64{two53 + 1, 0}.toDouble()), 0x1p53);
    EXPECT_EQ((Fixed64x64{two53 + 1, 1}.toDouble()), 0x1p53 + 2);
    EXPECT_EQ((Fixed64x64{two53 + 3, 0}.toDouble()), 0x1p53 + 4);
    EXPECT_EQ((Fixed64x64{1, 1u << 11}.toDouble()), 1.0);
    EXPECT_EQ((Fixed64x64{1, (1u << 11) + 1}.toDouble()), 1.0 + 0x1p-52);
    EXPECT_EQ(LARGEST.toDouble(), 0x1p64);
}

}  // namespace
}  // namespace sahl
