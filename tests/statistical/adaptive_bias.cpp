// What rules of adaptive sampling do to a picture whose light is found seldom: `report` and `joint`
// lose some of it, `crossed` does not.

#include "film/film_error.h"
#include "statistical/lamp_scene.h"
#include "support/adaptive_scenes.h"

#include <gtest/gtest.h>

namespace sahl::testing {
namespace {

/// Mean of all pixels' radiance (green).
double frameMean(const Film& film)
{
    const Image image = meanImage(film);
    double sum = 0;
    for (size_t i = 1; i < image.rgb.size(); i += 3) sum += image.rgb[i];
    return 3 * sum / double(image.rgb.size());
}

struct Estimate {
    double mean = 0, standardError = 0, samplesPerPixel = 0;
};

/// Frame mean over independent pictures by a rule, one for each of `seeds` seeds.
Estimate meanOver(uint32_t size, const AdaptiveRule& rule, uint32_t seeds)
{
    double sum = 0, sum2 = 0, samples = 0;
    auto device = makeCpuDevice({});
    for (uint32_t seed = 1; seed <= seeds; seed++) {
        PreparedScene scene = prepareScene(lampScene(size, size, seed), BvhBuild::sweep, 2);
        Film film = renderAdaptiveFilm(*device, scene, rule).film;
        double mean = frameMean(film);
        sum += mean;
        sum2 += mean * mean;
        samples += double(film.counters.cameraRays) / (size * size);
    }
    double mean = sum / seeds;
    return {mean, std::sqrt((sum2 / seeds - mean * mean) / (seeds - 1)), samples / seeds};
}

/// Compares the rule, and as many samples in each pixel without it, with a long reference. Prints
/// and returns the bias relative to the reference.
double expectBias(uint32_t size, const AdaptiveRule& rule, uint32_t seeds,
                  uint32_t referenceSamples)
{
    PreparedScene scene = prepareScene(lampScene(size, size, 0), BvhBuild::sweep, 2);
    double reference = frameMean(renderFilm(*makeCpuDevice({}), scene, 0, referenceSamples));
    Estimate biased = meanOver(size, rule, seeds);
    auto same = static_cast<uint32_t>(biased.samplesPerPixel);
    Estimate plain = meanOver(size, reportRule(rule.epsilon, same, same), seeds);
    double bias = biased.mean / reference - 1;
    std::printf(
        "reference %.5f; report: %.2f %% +- %.2f %%, %.1f samples per pixel; as many everywhere: "
        "%.2f %% +- %.2f %%\n",
        reference, 100 * bias, 100 * biased.standardError / reference, biased.samplesPerPixel,
        100 * (plain.mean / reference - 1), 100 * plain.standardError / reference);
    // The reference is as good as some pictures of the plain kind, hence 5 standard errors for
    // both.
    EXPECT_LT(std::abs(plain.mean / reference - 1), 5 * plain.standardError / reference + 0.002);
    EXPECT_LT(biased.mean, reference - 20 * biased.standardError);
    return bias;
}

TEST(AdaptiveBias, lampFoundByChanceLosesLight)
{
    EXPECT_LT(expectBias(16, reportRule(1e-4f, 20, 200), 64, 40000), -0.2);
}

TEST(LongAdaptiveBias, lampFoundByChanceLosesLightWithTheReportsNumbers)
{
    EXPECT_LT(expectBias(64, reportRule(1e-4f, 20, 1000), 64, 16384), -0.2);
}

/// Frame means by the three rules against a long reference.
void expectOnlyCrossedIsRight(uint32_t size, uint32_t seeds, uint32_t referenceSamples,
                              double mostBias)
{
    PreparedScene scene = prepareScene(lampScene(size, size, 0), BvhBuild::sweep, 2);
    const Film film = renderFilm(*makeCpuDevice({}), scene, 0, referenceSamples);
    const double reference = frameMean(film);
    const double ofReference = filmError(film, 1).ofFrameMean;
    std::printf("reference %.5f +- %.3f %%\n", reference, 100 * ofReference);
    auto measure = [&](const char* name, const AdaptiveRule& rule) {
        const Estimate estimate = meanOver(size, rule, seeds);
        const double error = std::hypot(estimate.standardError / reference, ofReference);
        const double bias = estimate.mean / reference - 1;
        std::printf("%-8s %7.3f %% +- %.3f %%, %.1f samples per pixel\n", name, 100 * bias,
                    100 * error, estimate.samplesPerPixel);
        return std::pair{bias, error};
    };
    const auto [crossed, ofCrossed] =
        measure("crossed", targetRule(ADAPTIVE_CROSSED, 0.3f, 32, 512));
    const auto [joint, ofJoint] = measure("joint", targetRule(ADAPTIVE_JOINT, 0.3f, 32, 512));
    const auto [report, ofReport] = measure("report", reportRule(1e-4f, 32, 512));
    EXPECT_LT(std::abs(crossed), 4 * ofCrossed);
    EXPECT_LT(std::abs(crossed), mostBias);
    EXPECT_LT(joint, -4 * ofJoint);
    EXPECT_LT(report, -20 * ofReport);
}

TEST(AdaptiveBias, onlyCrossedFindsAllLight)
{
    expectOnlyCrossedIsRight(16, 48, 16384, 0.05);
}

TEST(LongAdaptiveBias, onlyCrossedFindsAllLight_256Renders)
{
    expectOnlyCrossedIsRight(64, 256, 65536, 0.01);
}

}  // namespace
}  // namespace sahl::testing
