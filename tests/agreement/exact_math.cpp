// Exact division and square root on the device and in C++, against C++'s own operations.

#include "agreement/agreement_spirv.h"
#include "device/exact_math.h"
#include "reference/kernel.h"
#include "support/device_test.h"
#include "vulkan/run_compute.h"

#include <bit>
#include <cmath>
#include <random>

namespace sahl::testing {
namespace {

constexpr float SMALLEST_NORMAL = 0x1p-126f;

/// What exact.glsl promises: C++'s value, but zero below the normal range.
float promised(float value)
{
    return std::fabs(value) < SMALLEST_NORMAL ? std::copysign(0.0f, value) : value;
}

bool sameNumber(uint32_t bits, float expected)
{
    float value = std::bit_cast<float>(bits);
    if (std::isnan(expected)) return std::isnan(value);
    return bits == std::bit_cast<uint32_t>(promised(expected));
}

bool isDenormal(float x) { return x != 0 && std::fabs(x) < SMALLEST_NORMAL; }

/// Pairs of every kind: all bit patterns, mantissas alone, divisors just below one, special values.
std::vector<glm::uvec2> operandPairs(size_t count, uint64_t seed)
{
    const float special[] = {0.0f, -0.0f, 1.0f, -1.0f, INFINITY, -INFINITY, NAN, SMALLEST_NORMAL, 0x1.fffffep127f,
                             0x1.fffffep-1f, -2.0f, 3.0f};
    std::mt19937_64 random(seed);
    std::vector<glm::uvec2> pairs(count);
    for (size_t i = 0; i < count; i++) {
        uint64_t bits = random();
        glm::uvec2 pair(static_cast<uint32_t>(bits), static_cast<uint32_t>(bits >> 32));
        if (i % 4 == 1) pair = (pair & 0x807fffffu) | 0x3f800000u;
        if (i % 4 == 2) pair.y = 0x3f7fffffu - (pair.y & 15);
        if (i < 144) {
            pair = {std::bit_cast<uint32_t>(special[i / 12]), std::bit_cast<uint32_t>(special[i % 12])};
        }
        for (int k = 0; k < 2; k++) {
            if (isDenormal(std::bit_cast<float>(pair[k]))) pair[k] = 0x3f800000u;
        }
        pairs[i] = pair;
    }
    return pairs;
}

class ExactMath : public DeviceTest {
protected:
    static std::vector<glm::uvec4> onDevice(Context& context, std::vector<glm::uvec2>& pairs, int nudge)
    {
        std::vector<glm::uvec4> results(pairs.size());
        ComputeParameters parameters;
        parameters.groups = {256, static_cast<uint32_t>(pairs.size() / 64 / 256), 1};
        parameters.pushConstants = std::as_bytes(std::span(&nudge, 1));
        runCompute(context, testSpirv("exact_math"),
                   {std::as_writable_bytes(std::span(pairs)), std::as_writable_bytes(std::span(results))},
                   parameters);
        return results;
    }

    /// How far the guess may be moved: it may be off by 3 units, of which the device's own takes up to 2 (NVIDIA's
    /// does).
    static int largestNudge(Context& context) { return areExact(probeMath(context)) ? 3 : 1; }

    ///   fused  whether division by fused multiply-add must be right too: not where a device rounds twice
    static uint64_t wrongResults(const std::vector<glm::uvec2>& pairs, const std::vector<glm::uvec4>& results, bool fused)
    {
        uint64_t wrong = 0;
        for (size_t i = 0; i < pairs.size(); i++) {
            float a = std::bit_cast<float>(pairs[i].x), b = std::bit_cast<float>(pairs[i].y);
            wrong += !sameNumber(results[i].x, a / b) + !sameNumber(results[i].y, std::sqrt(a));
            wrong += fused && !sameNumber(results[i].z, a / b);
        }
        return wrong;
    }
};

constexpr size_t BATCH = 1 << 20;  // 64 * 256 * 64 pairs

TEST_F(ExactMath, isCppsDivisionAndRootHoweverTheGuessIsOff)
{
    auto context = openFirstContext();
    const int most = largestNudge(*context);
    const bool fused = areFused(probeMath(*context));
    for (int nudge = -most; nudge <= most; nudge++) {
        auto pairs = operandPairs(BATCH, 10 + static_cast<uint64_t>(nudge + 3));
        EXPECT_EQ(wrongResults(pairs, onDevice(*context, pairs, nudge), fused), 0u) << nudge;
    }
}

TEST_F(ExactMath, isChosenWhereTheDeviceDividesOtherwise_whichNoSoftwareOneDoes)
{
    auto context = openFirstContext();
    const MathProbe probe = probeMath(*context);
    const bool divides = areExact(probe);
    if (context->physical.kind == "software") {
        EXPECT_TRUE(divides);
    }
    EXPECT_EQ(chooseMath(*context, DeviceOptions::Math::automatic),
              divides ? MATH_NATIVE : (areFused(probe) ? MATH_FUSED : MATH_INTEGERS));
    EXPECT_EQ(chooseMath(*context, DeviceOptions::Math::exact), MATH_INTEGERS);
    EXPECT_EQ(chooseMath(*context, DeviceOptions::Math::native), MATH_NATIVE);
}

TEST_F(ExactMath, wouldBeSeenToBeNeededFromOneWrongBit)
{
    MathProbe right;
    right.operands = {{1, 3}, {2, 7}, {5, 0x1.fffffep-1f}};
    for (glm::vec2 pair : right.operands) {
        const float quotient = pair.x / pair.y;
        right.results.emplace_back(quotient, std::sqrt(pair.x), quotient,
                                   std::fma(pair.x, pair.y, -(pair.x * pair.y)));
    }
    EXPECT_TRUE(areExact(right));
    EXPECT_TRUE(areFused(right));
    for (size_t i = 0; i < right.results.size(); i++) {
        for (int k = 0; k < 4; k++) {
            MathProbe wrong = right;
            wrong.results[i][k] = std::nextafter(wrong.results[i][k], 100.0f);
            EXPECT_EQ(areExact(wrong), k >= 2) << i << ", " << k;
            EXPECT_EQ(areFused(wrong), k < 2) << i << ", " << k;
        }
    }
}

class LongExactMath : public ExactMath {};

TEST_F(LongExactMath, dividesABillionPairsAsCppDoes)
{
    auto context = openFirstContext();
    const int most = largestNudge(*context);
    const bool fused = areFused(probeMath(*context));
    for (uint64_t batch = 0; batch < 954; batch++) {
        auto pairs = operandPairs(BATCH, 100 + batch);
        int nudge = static_cast<int>(batch % (2 * most + 1)) - most;
        ASSERT_EQ(wrongResults(pairs, onDevice(*context, pairs, nudge), fused), 0u) << batch;
    }
}

TEST_F(LongExactMath, takesTheRootOfEveryNormalNumberAsCppDoes)
{
    auto context = openFirstContext();
    std::vector<glm::uvec2> numbers(BATCH * 8, glm::uvec2(0, 0x3f800000u));
    for (uint64_t first = 0x00800000u; first < 0x7f800000u; first += numbers.size()) {
        for (size_t i = 0; i < numbers.size(); i++) numbers[i].x = static_cast<uint32_t>(first + i);
        ASSERT_EQ(wrongResults(numbers, onDevice(*context, numbers, 0), false), 0u) << first;
    }
}

TEST(ExactMathInCpp, isCppsDivisionAndRootHoweverTheGuessIsOff)
{
    reference::Kernel<> kernel;
    for (int nudge = -3; nudge <= 3; nudge++) {
        for (glm::uvec2 pair : operandPairs(BATCH, 77)) {
            float a = std::bit_cast<float>(pair.x), b = std::bit_cast<float>(pair.y);
            ASSERT_TRUE(sameNumber(std::bit_cast<uint32_t>(kernel.exactQuotient(a, b, nudge)), a / b)) << a << " / " << b;
            ASSERT_TRUE(sameNumber(std::bit_cast<uint32_t>(kernel.fusedQuotient(a, b, nudge)), a / b)) << a << " / " << b;
            ASSERT_TRUE(sameNumber(std::bit_cast<uint32_t>(kernel.exactRoot(a, nudge)), std::sqrt(a))) << a;
        }
    }
}

}  // namespace
}  // namespace sahl::testing
