// The rule `report` and the film's sums in words of 32 bits, as the text has them.

#include "film/film.h"
#include "reference/kernel.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <random>

namespace sahl::testing {
namespace {

using Kernel = reference::Kernel<>;

struct Stopped {
    uint32_t samples = 0;
    uint32_t state = PIXEL_ACTIVE;
    vec3 mean = vec3(0);
};

Stopped runRule(const AdaptiveRule& rule, const std::function<vec3(uint32_t)>& sampleAt)
{
    Kernel kernel = {};
    Stopped pixel;
    while (pixel.state == PIXEL_ACTIVE) {
        vec3 L = sampleAt(pixel.samples++);
        pixel.state = kernel.stateAfter(rule, L, pixel.samples, pixel.mean);
    }
    return pixel;
}

AdaptiveRule report(float epsilon, uint32_t minSamples, uint32_t maxSamples)
{
    return {ADAPTIVE_REPORT, epsilon, minSamples, maxSamples, 0, 0, 0, 0};
}

TEST(ReportRule, constantRadianceStopsAtTheMinimum)
{
    for (uint32_t minimum : {2u, 7u, 8u, 20u, 999u}) {
        Stopped pixel =
            runRule(report(1e-4f, minimum, 1000), [](uint32_t) { return vec3(0.3f, 7, 0); });
        EXPECT_EQ(pixel.samples, minimum);
        EXPECT_EQ(pixel.state, PIXEL_CONVERGED);
        EXPECT_FLOAT_EQ(pixel.mean.y, 7);
    }
}

TEST(ReportRule, oneMeanIsNoComparison)
{
    auto black = [](uint32_t) { return vec3(0); };
    EXPECT_EQ(runRule(report(1e-4f, 1, 1000), black).samples, 2u);
    EXPECT_EQ(runRule(report(1e-4f, 1, 1), black).state, PIXEL_AT_MAXIMUM);
}

TEST(ReportRule, anyChannelKeepsThePixelGoing)
{
    for (int channel = 0; channel < 3; channel++) {
        auto flicker = [&](uint32_t i) {
            vec3 L(1);
            L[channel] = i % 2 == 0 ? 2.0f : 1.0f;  // |a - m| is about a half
            return L;
        };
        // 0.5 / n < 0.01 from about the 50th sample on.
        EXPECT_NEAR(runRule(report(0.01f, 2, 1000), flicker).samples, 50, 2) << channel;
    }
}

TEST(ReportRule, epsilonIsABoundThatIsNotReached)
{
    // The second sample moves the mean from 0 to exactly 0.25.
    auto samples = [](uint32_t i) { return vec3(i == 1 ? 0.5f : 0.0f); };
    EXPECT_EQ(runRule(report(0.25f, 2, 2), samples).state, PIXEL_AT_MAXIMUM);
    EXPECT_EQ(runRule(report(0.25000003f, 2, 2), samples).state, PIXEL_CONVERGED);
}

TEST(ReportRule, maximumIsReachedExactly)
{
    std::mt19937 random(1);
    auto noisy = [&](uint32_t) { return vec3(static_cast<float>(random() % 2) * 1e6f); };
    for (uint32_t maximum : {20u, 21u, 64u, 1000u}) {
        Stopped pixel = runRule(report(1e-4f, 20, maximum), noisy);
        EXPECT_EQ(pixel.samples, maximum);
        EXPECT_EQ(pixel.state, PIXEL_AT_MAXIMUM);
    }
}

/// The rule as the report states it, in double precision: sums divided by counts, |m(n+1) - m(n)|.
uint32_t textbookCount(double epsilon, uint32_t minSamples, uint32_t maxSamples,
                       std::span<const float> samples)
{
    double sum = samples[0];
    for (uint32_t n = 1; n < maxSamples; n++) {
        double mean = sum / n;
        sum += samples[n];
        double next = sum / (n + 1);
        if (n + 1 >= minSamples && std::abs(next - mean) < epsilon) return n + 1;
    }
    return maxSamples;
}

TEST(ReportRule, stopsWhereTheTextbookStops)
{
    // Samples that are 0 or 1: the mean moves by m / n or (1 - m) / n, so that counts vary widely.
    constexpr uint32_t MAXIMUM = 1000;
    uint32_t atMinimum = 0, atMaximum = 0;
    for (uint32_t pixel = 0; pixel < 2000; pixel++) {
        std::mt19937 random(pixel);
        std::vector<float> samples(MAXIMUM);
        for (float& sample : samples) sample = random() % 100 < pixel % 100 ? 1.0f : 0.0f;
        uint32_t expected = textbookCount(3.1e-4, 20, MAXIMUM, samples);
        Stopped stopped =
            runRule(report(3.1e-4f, 20, MAXIMUM), [&](uint32_t i) { return vec3(samples[i]); });
        EXPECT_EQ(stopped.samples, expected) << pixel;
        atMinimum += expected == 20 ? 1 : 0;
        atMaximum += expected == MAXIMUM ? 1 : 0;
    }
    EXPECT_GT(atMinimum, 20u);
    EXPECT_GT(atMaximum, 20u);
    EXPECT_LT(atMinimum + atMaximum, 1500u);
}

struct Estimate {
    double mean = 0, standardError = 0;
};

/// Mean of the pictures of `pixels` pixels whose samples are 1/p with probability p and black
/// otherwise: the right answer is 1.
Estimate rareBrightSamples(const AdaptiveRule& rule, double p, uint32_t pixels)
{
    Kernel kernel = {};
    std::mt19937 random(42);
    const auto threshold = static_cast<uint32_t>(p * 4294967296.0);
    double sum = 0, sum2 = 0;
    for (uint32_t i = 0; i < pixels; i++) {
        uint32_t n = 0, bright = 0, state = PIXEL_ACTIVE;
        vec3 mean(0);
        while (state == PIXEL_ACTIVE) {
            bool hit = random() < threshold;
            bright += hit ? 1 : 0;
            state =
                kernel.stateAfter(rule, vec3(hit ? static_cast<float>(1 / p) : 0.0f), ++n, mean);
        }
        double value = bright / (p * n);
        sum += value;
        sum2 += value * value;
    }
    double m = sum / pixels;
    return {m, std::sqrt((sum2 / pixels - m * m) / pixels)};
}

TEST(ReportRule, losesRareBrightSamples)
{
    // A pixel that is black for its first 20 samples stops there; no other pixel stops, since a
    // sample moves its mean by 1 / (p n^2) at least. So of the energy that black pixels would have
    // found in their other samples nothing arrives: E = 1 - (1 - p)^20 (1 - 20 / maxSamples).
    constexpr double P = 0.02;
    constexpr uint32_t PIXELS = 1000000, MAXIMUM = 250;
    Estimate biased = rareBrightSamples(report(1e-4f, 20, MAXIMUM), P, PIXELS);
    double expected = 1 - std::pow(1 - P, 20) * (1 - 20.0 / MAXIMUM);
    EXPECT_NEAR(biased.mean, expected, 4 * biased.standardError);
    EXPECT_LT(biased.standardError, 0.002);
    EXPECT_LT(biased.mean, 0.4) << "more than 60 % of the light is lost";
    RecordProperty("mean", std::to_string(biased.mean));
    RecordProperty("error", std::to_string(biased.standardError));

    // The same pixels with the same number of samples each lose nothing.
    Estimate plain = rareBrightSamples(report(1e-4f, 100, 100), P, PIXELS / 4);
    EXPECT_NEAR(plain.mean, 1, 4 * plain.standardError);
    RecordProperty("plainMean", std::to_string(plain.mean));
    RecordProperty("plainError", std::to_string(plain.standardError));
}

AdaptiveRule crossed(float target, uint32_t pilots, uint32_t most)
{
    return {ADAPTIVE_CROSSED, 0, 2 * pilots, 2 * most, target, 0, 0, 0};
}

/// A picture of 3 x 3 pixels.
struct Picture {
    std::array<PixelEstimate, 9> estimates = {};
    uvec2 wantedInTheMiddle(const AdaptiveRule& rule, const AdaptiveFloors& floors = {}) const
    {
        Kernel kernel = {};
        kernel.estimates = std::span<const PixelEstimate>(estimates.data(), 9);
        kernel.pictureWidth = 3;
        return kernel.wantedByCrossed(rule, floors, 1, 1);
    }
};

TEST(CrossedRule, samplesOfAHalfFollowFromTheOtherHalfAlone)
{
    // A standard error of 10 % of 2 is 0.2; the mean of two means of n samples each of variance 8 has a
    // variance of 8 / (2 n): n = 100, in whole blocks 104.
    Picture picture;
    for (PixelEstimate& estimate : picture.estimates) estimate = {1, 0, 2, 0};
    picture.estimates[4] = {1, 0, 2, 8};
    uvec2 wanted = picture.wantedInTheMiddle(crossed(0.1f, 16, 512));
    EXPECT_EQ(wanted.x, 104u);
    EXPECT_EQ(wanted.y, 16u) << "pilots at least";
    for (float varianceA : {0.0f, 1.0f, 1e30f}) {
        for (float luminanceA : {0.0f, 1.0f, 1e9f}) {
            picture.estimates[4].luminanceA = luminanceA;
            picture.estimates[4].varianceA = varianceA;
            EXPECT_EQ(picture.wantedInTheMiddle(crossed(0.1f, 16, 512)).x, 104u);
        }
    }
}

TEST(CrossedRule, aNeighbourThatAsksForMoreIsHeard)
{
    for (size_t i = 0; i < 9; i++) {
        Picture picture;
        for (PixelEstimate& estimate : picture.estimates) estimate = {1, 0, 1, 0};
        picture.estimates[i].varianceA = 2;
        EXPECT_EQ(picture.wantedInTheMiddle(crossed(0.1f, 8, 512)).x, 8u);
        EXPECT_EQ(picture.wantedInTheMiddle(crossed(0.1f, 8, 512)).y, 104u) << i;  // 2 / (2 0.01), rounded up
    }
}

TEST(CrossedRule, darkPixelsAreMeasuredByTheFloor)
{
    Picture picture;
    picture.estimates[4] = {0, 0, 0.001f, 0.01f};
    EXPECT_NEAR(picture.wantedInTheMiddle(crossed(0.1f, 8, 512)).x, 500000, 8);  // 0.01 / (2 1e-8)
    EXPECT_EQ(picture.wantedInTheMiddle(crossed(0.1f, 8, 512), {0, 0.1f}).x, 56u);  // 0.01 / (2 1e-4) = 50
    EXPECT_EQ(picture.wantedInTheMiddle(crossed(0.1f, 8, 512), {9, 0.1f}).x, 56u) << "A's floor says nothing of A";
}

TEST(CrossedRule, numbersAtTheEndsOfFloatsDoNoHarm)
{
    Picture picture;
    picture.estimates[4] = {0, 1e-20f, 1e18f, 1e37f};
    EXPECT_EQ(picture.wantedInTheMiddle(crossed(1e-6f, 8, 512)).x, 1u << 24) << "5e12, cut";
    EXPECT_EQ(picture.wantedInTheMiddle(crossed(1e-6f, 8, 512)).y, 1u << 24) << "no luminance at all, but noise";
    EXPECT_EQ(picture.wantedInTheMiddle(crossed(1, 8, 512), {1e18f, 1e18f}).y, 8u);
}

TEST(JointRule, goesOnWhileANeighbourDoes)
{
    Kernel kernel = {};
    std::array<PixelEstimate, 9> estimates = {};
    for (PixelEstimate& estimate : estimates) estimate = {1, 0.0099f, 0, 0};
    kernel.estimates = std::span<const PixelEstimate>(estimates.data(), 9);
    kernel.pictureWidth = 3;
    const AdaptiveRule rule = {ADAPTIVE_JOINT, 0, 16, 64, 0.1f, 0, 0, 0};
    EXPECT_EQ(kernel.stateByJoint(rule, {}, 1, 1, 16), PIXEL_CONVERGED);
    estimates[0].varianceA = 0.0101f;
    EXPECT_EQ(kernel.stateByJoint(rule, {}, 1, 1, 16), PIXEL_ACTIVE);
    EXPECT_EQ(kernel.stateByJoint(rule, {}, 1, 1, 64), PIXEL_AT_MAXIMUM);
    EXPECT_EQ(kernel.stateByJoint(rule, {}, 2, 2, 16), PIXEL_CONVERGED) << "no neighbour of that one";
    EXPECT_EQ(kernel.stateByJoint(rule, {2, 0}, 1, 1, 16), PIXEL_CONVERGED) << "by the floor";
}

TEST(AdaptiveEstimates, areThoseOfTheSamples)
{
    // Samples 0 and 1 in turn in A; 3 in B but for one 11.
    Kernel kernel = {};
    FilmPixel film = {};
    auto add = [&](uint32_t first, std::array<float, 8> samples) {
        PixelBlock block = {};
        for (float value : samples) {
            block.sum = block.sum + vec3(value);
            block.sumY2 += value * value;
            block.samplesDone++;
        }
        kernel.addBlock(block, first, film);
    };
    add(0, {0, 1, 0, 1, 0, 1, 0, 1});
    add(8, {3, 3, 3, 3, 3, 3, 3, 11});
    const PixelEstimate apart = kernel.estimateOf(crossed(0.1f, 8, 8), film);
    EXPECT_NEAR(apart.luminanceA, 0.5, 1e-6);
    EXPECT_NEAR(apart.varianceA, 2.0 / 7, 1e-6);
    EXPECT_NEAR(apart.luminanceB, 4, 1e-5);
    EXPECT_NEAR(apart.varianceB, 8, 1e-4);
    // Together: mean 2.25, squares 4 + 63 + 121 = 188, variance (188 / 16 - 5.0625) 16 / 15.
    const PixelEstimate both = kernel.estimateOf({ADAPTIVE_JOINT, 0, 16, 16, 0.1f, 0, 0, 0}, film);
    EXPECT_NEAR(both.luminanceA, 2.25, 1e-5);
    EXPECT_NEAR(both.varianceA, (188.0 / 16 - 5.0625) / 15, 1e-5);
}

TEST(FilmSums, becomeFloatsOf24Bits)
{
    Kernel kernel = {};
    std::mt19937 random(11);
    EXPECT_EQ(kernel.floatFromFixed(uvec4(0)), 0.0f);
    for (uint32_t exponent = 127 - 40; exponent < 127 + 63; exponent++) {
        const float value = std::bit_cast<float>(exponent << 23 | static_cast<uint32_t>(random() & 0x7fffffu));
        EXPECT_EQ(kernel.floatFromFixed(kernel.fixedFromFloat(value)), value);
    }
    EXPECT_EQ(kernel.floatFromFixed(uvec4(1, 0, 0, 0)), 0x1p-64f);
    EXPECT_EQ(kernel.floatFromFixed(uvec4(0xffffffffu)), std::nextafter(0x1p64f, 0.0f)) << "cut";
}

TEST(FilmSums, wordsOf32BitsEqualTheHostsFixedPoint)
{
    Kernel kernel = {};
    std::mt19937 random(3);
    Fixed64x64 host;
    uvec4 words(0);
    auto expectEqual = [](const uvec4& w, const Fixed64x64& h, float value) {
        EXPECT_EQ((uint64_t{w.w} << 32 | w.z), h.whole) << value;
        EXPECT_EQ((uint64_t{w.y} << 32 | w.x), h.fraction) << value;
    };
    auto check = [&](uint32_t bits) {
        float value = std::bit_cast<float>(bits);
        expectEqual(kernel.fixedFromFloat(value), Fixed64x64::fromFloat(value), value);
        host.add(Fixed64x64::fromFloat(value));
        words = kernel.fixedSum(words, kernel.fixedFromFloat(value));
        expectEqual(words, host, value);
    };
    for (uint32_t exponent = 0; exponent < 255; exponent++) {
        for (uint32_t mantissa : {0u, 1u, 0x2aaaaau, 0x7fffffu}) check(exponent << 23 | mantissa);
    }
    host = {};
    words = uvec4(0);
    for (int i = 0; i < 100000; i++) check(static_cast<uint32_t>(random() % 0x4f000000u));
    EXPECT_NE(host.whole, ~uint64_t{0}) << "saturated: the sums show nothing";
    for (int i = 0; i < 20; i++) check(0x5f7fffffu);
    EXPECT_EQ(host.whole, ~uint64_t{0}) << "the top is never reached";
    check(0x7f800000u);
    check(0x80000000u);
}

TEST(FilmSums, blocksGoToTheHalvesInTurn)
{
    Kernel kernel = {};
    std::mt19937 random(5);
    AdaptivePixel pixel = {};
    Film film(1, 1);
    for (uint32_t first : {0u, 8u, 16u, 24u}) {
        PixelBlock block = kernel.emptyBlock();
        block.sum = vec3(static_cast<float>(random() % 1000) * 0.37f);
        block.sumY2 = 0.3f;
        block.samplesDone = first == 24 ? 3 : 8;
        block.digest = random() & 0xffffffffu;
        block.boxTests = 0xfffffff0u;
        block.bounces = 7;
        block.badSamples = 1;
        film.add(0, 0, 1, 1, first, {&block, 1});
        kernel.addBlock(block, first, pixel.film);
    }
    Film added(1, 1);
    added.add(0, 0, 1, 1, {&pixel, 1}, true);
    EXPECT_TRUE(added == film);
    EXPECT_EQ(film.half[0][0].samples, 16u);
    EXPECT_EQ(film.half[1][0].samples, 11u);
    EXPECT_GT(film.counters.boxTests, uint64_t{1} << 33) << "counts of 64 bits";
}

}  // namespace
}  // namespace sahl::testing
