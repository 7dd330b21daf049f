// How often the verdict of `sahl compare` is wrong: equal scenes called different, and errors of
// energy overlooked, against the rates that it states.

#include "compare/distributions.h"
#include "compare/noise.h"
#include "film/layers.h"
#include "statistical/lamp_scene.h"
#include "support/noisy_pictures.h"
#include "support/render_scenes.h"
#include "support/small_scenes.h"

#include <gtest/gtest.h>

namespace sahl::testing {
namespace {

constexpr double BOUND = 3.3;  // standard errors that a count may be off: once in 1000 tests

bool saysDifferent(const LoadedPicture& a, const LoadedPicture& b, double level)
{
    CompareOptions options;
    options.level = level;
    const Statistics s = testDifferences(a, b, options);
    return s.frameDiffers || s.differingBlocks > 0;
}

/// No more alarms than the stated level gives, but for the luck of counting.
void expectAtMost(int count, int trials, double level)
{
    const double expected = trials * level;
    EXPECT_LE(count, expected + BOUND * std::sqrt(expected * (1 - level)) + 1);
}

// Synthetic pictures.

struct Light {
    const char* name;
    double (*draw)(std::mt19937& random);
    uint32_t sppA, sppB;
};

double normalSample(std::mt19937& random)
{
    return std::normal_distribution<double>(1, 0.5)(random);
}

double exponentialSample(std::mt19937& random)
{
    return std::exponential_distribution<double>(1)(random);
}

/// One sample in 50 is bright, all others are black.
double rareSample(std::mt19937& random)
{
    return random() < 0xffffffffu / 50 ? 50 : 0;
}

LoadedPicture synthetic(const Light& light, uint32_t spp, std::mt19937& random)
{
    return noisyPicture(32, 32, spp, [&] { return light.draw(random); });
}

TEST(CompareRates, falseAlarmsOnSyntheticNoise_areWithinTheStatedLevel)
{
    const Light lights[] = {{"normal, 2 and 2 spp", normalSample, 2, 2},
                            {"normal, 16 and 16 spp", normalSample, 16, 16},
                            {"exponential, 4 and 4 spp", exponentialSample, 4, 4},
                            {"exponential, 2 and 64 spp", exponentialSample, 2, 64},
                            {"rare light, 16 and 16 spp", rareSample, 16, 16},
                            {"rare light, 4 and 256 spp", rareSample, 4, 256},
                            {"rare light, 2 and 64 spp", rareSample, 2, 64}};
    constexpr int PAIRS = 400;
    for (const Light& light : lights) {
        std::mt19937 random(11);
        int atFive = 0, atOne = 0;
        for (int i = 0; i < PAIRS; i++) {
            const LoadedPicture a = synthetic(light, light.sppA, random);
            const LoadedPicture b = synthetic(light, light.sppB, random);
            atFive += saysDifferent(a, b, 0.05);
            atOne += saysDifferent(a, b, 0.01);
        }
        std::printf("%-28s %3d of %d at level 5 %%, %d at level 1 %%\n", light.name, atFive, PAIRS,
                    atOne);
        expectAtMost(atFive, PAIRS, 0.05);
        expectAtMost(atOne, PAIRS, 0.01);
        // The test is not so careful that it never speaks.
        if (light.draw == normalSample && light.sppA == 16) {
            EXPECT_GE(atFive, 7);
        }
    }
}

TEST(CompareRates, biasesThatAreCalledDetectable_areFoundInFourOfFiveCases)
{
    constexpr int PAIRS = 400;
    std::mt19937 random(12);
    const Light light = {"exponential", exponentialSample, 16, 16};
    for (double factor : {0.5, 1.0, 1.5}) {
        int found = 0;
        double expected = 0, variance = 0;
        for (int i = 0; i < PAIRS; i++) {
            const LoadedPicture a = synthetic(light, 16, random), b = synthetic(light, 16, random);
            const Statistics plain = testDifferences(a, b, {});
            const double bias = factor * plain.detectableBias;
            const double mean = 0.5 * (plain.meanA + plain.meanB);
            const double critical = normalQuantile(1 - plain.frameLevel / 2);
            const double power = normalCdf(bias * mean / plain.frame.standardError - critical);
            expected += power;
            variance += power * (1 - power);
            const Statistics s = testDifferences(shifted(a, bias * mean), b, {});
            found += s.frameDiffers;
        }
        std::printf("%.1f times the detectable bias: found in %d of %d, predicted %.0f\n", factor,
                    found, PAIRS, expected);
        EXPECT_NEAR(found, expected, BOUND * std::sqrt(variance) + 2);
        if (factor == 1) {
            EXPECT_NEAR(expected, 0.8 * PAIRS, 2);
        }
    }
}

TEST(CompareRates, equivalence_isSeldomClaimedOfPicturesThatAreFurtherApart)
{
    // A true difference of just the margin: at most 5 % may be called equivalent.
    constexpr int PAIRS = 400;
    std::mt19937 random(13);
    const Light light = {"exponential", exponentialSample, 16, 16};
    int claimed = 0, claimedOfEqual = 0;
    for (int i = 0; i < PAIRS; i++) {
        const LoadedPicture a = synthetic(light, 16, random), b = synthetic(light, 16, random);
        CompareOptions options;
        options.margin = 0.05;  // 4.5 standard errors
        claimedOfEqual += testDifferences(a, b, options).equivalent;
        claimed +=
            testDifferences(brightened(a, 1.0513), b, options).equivalent;  // of the mean of both
    }
    std::printf("equivalent within 5 %%: %d of %d that are 5 %% apart, %d of %d equal ones\n",
                claimed, PAIRS, claimedOfEqual, PAIRS);
    expectAtMost(claimed, PAIRS, 0.05);
    EXPECT_GT(claimedOfEqual, 0.9 * PAIRS);
}

TEST(CompareRates, leavingOutPixelsWithoutSpread_wouldBeABias)
{
    // Why such pixels stay in the sums. Samples are 1 nine times in ten, else 0; 2 and 8 of them. A
    // pixel of 2 equal samples beside 8 equal ones is mostly white in both: without them white is
    // missing.
    std::mt19937 random(14);
    auto draw = [&random] { return random() % 10 < 9 ? 1.0 : 0.0; };
    const LoadedPicture a = noisyPicture(512, 512, 2, draw), b = noisyPicture(512, 512, 8, draw);
    double all = 0, kept = 0, keptPixels = 0;
    for (size_t i = 0; i < a.variance.size(); i++) {
        const double difference = double(a.image.rgb[3 * i]) - b.image.rgb[3 * i];
        all += difference;
        if (a.variance[i] + b.variance[i] > 0) {
            kept += difference;
            keptPixels += 1;
        }
    }
    const double count = double(a.variance.size());
    std::printf("mean difference of all pixels %.5f, of those with spread %.5f\n", all / count,
                kept / keptPixels);
    EXPECT_LT(std::fabs(all / count), 0.0018);  // 4 standard errors
    EXPECT_GT(std::fabs(kept / keptPixels), 0.004);
}

// Rendered pictures.

/// A clay ball on clay under an overcast sky.
Scene clayScene(uint32_t seed)
{
    Scene scene = emptyScene(24, 16, 4);
    scene.settings.seed = seed;
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0.6f));
    addLevel(scene, 0, 4);
    addSphere(scene, {0, 0.5f, 0}, 0.5f);
    scene.probe = addHalves(scene, vec3(1), vec3(0));
    lookFrom(scene, {0, 1.2, 4}, {0, 0.5, 0}, 40);
    return scene;
}

Scene smallLamp(uint32_t seed)
{
    return lampScene(24, 16, seed);
}

LoadedPicture rendered(Device& device, Scene scene, uint32_t spp)
{
    const PreparedScene prepared = prepareScene(std::move(scene), BvhBuild::sweep, 1);
    const Film film = renderFilm(device, prepared, 0, spp);
    LoadedPicture picture;
    picture.image = meanImage(film);
    for (ImageChannel& channel : statisticsChannels(film)) {
        if (channel.name == "variance.Y") picture.variance = std::move(channel.values);
        if (channel.name == "samples.Y") picture.samples = std::move(channel.values);
    }
    return picture;
}

TEST(CompareRates, twoHundredPairsOfEqualScenes_giveNoMoreFalseAlarmsThanStated)
{
    constexpr int PAIRS = 200;
    const auto device = makeCpuDevice({});
    struct Case {
        const char* name;
        Scene (*scene)(uint32_t);
        uint32_t sppA, sppB;
    };
    for (const Case& c : {Case{"clay, 8 and 8 spp", clayScene, 8, 8},
                          {"clay, 2 and 32 spp", clayScene, 2, 32},
                          {"lamp, 16 and 16 spp", smallLamp, 16, 16},
                          {"lamp, 4 and 64 spp", smallLamp, 4, 64}}) {
        int atFive = 0, atOne = 0, verdicts = 0;
        for (uint32_t i = 0; i < PAIRS; i++) {
            const LoadedPicture a = rendered(*device, c.scene(2 * i), c.sppA);
            const LoadedPicture b = rendered(*device, c.scene(2 * i + 1), c.sppB);
            atFive += saysDifferent(a, b, 0.05);
            atOne += saysDifferent(a, b, 0.01);
            verdicts += compare(a, b, {}).verdict == Verdict::differ;
        }
        std::printf("%-22s %2d of %d at level 5 %%, %d at level 1 %%\n", c.name, atFive, PAIRS,
                    atOne);
        EXPECT_EQ(verdicts, atOne);
        expectAtMost(atFive, PAIRS, 0.05);
        expectAtMost(atOne, PAIRS, 0.01);
    }
}

TEST(LongCompareRates, errorsOfEnergyInRenders_areFoundAsOftenAsPredicted)
{
    constexpr int PAIRS = 100;
    const auto device = makeCpuDevice({});
    std::printf("%6s %18s %8s %10s %7s\n", "spp", "detectable bias", "error", "predicted", "found");
    for (uint32_t spp : {16u, 128u, 1024u}) {
        double detectable = 0;
        double predicted[3] = {}, variance[3] = {};
        int found[3] = {};
        const double errors[3] = {0.01, 0.003, 0.001};
        for (uint32_t i = 0; i < PAIRS; i++) {
            const LoadedPicture a = rendered(*device, clayScene(2 * i + 1000), spp);
            const LoadedPicture b = rendered(*device, clayScene(2 * i + 1001), spp);
            const Statistics s = testDifferences(a, b, {});
            detectable += s.detectableBias / PAIRS;
            const double critical = normalQuantile(1 - s.frameLevel / 2);
            const double sigma = s.frame.standardError / (0.5 * (s.meanA + s.meanB));
            for (size_t e = 0; e < 3; e++) {
                const double power = normalCdf(errors[e] / sigma - critical) +
                                     normalCdf(-errors[e] / sigma - critical);
                predicted[e] += power;
                variance[e] += power * (1 - power);
                found[e] += testDifferences(brightened(a, 1 + errors[e]), b, {}).frameDiffers;
            }
        }
        for (size_t e = 0; e < 3; e++) {
            std::printf("%6u %16.2f %% %6.1f %% %10.1f %7d of %d\n", spp, 100 * detectable,
                        100 * errors[e], predicted[e], found[e], PAIRS);
            EXPECT_NEAR(found[e], predicted[e], BOUND * std::sqrt(variance[e]) + 1);
        }
    }
}

}  // namespace
}  // namespace sahl::testing
