// What stopping by the rule `report` does to a picture: light that is found seldom gets lost.

#include "support/adaptive_scenes.h"
#include "support/small_scenes.h"

#include <gtest/gtest.h>

namespace sahl::testing {
namespace {

/// A floor and a glass ball under a small bright lamp that paths meet by chance: for most pixels
/// about one sample in a hundred is bright, all others are black.
Scene lampScene(uint32_t size, uint32_t seed)
{
    Scene scene = emptyScene(size, size, 6);
    scene.settings.seed = seed;
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0.7f));
    addLevel(scene, 0, 4);
    addMaterialOf(scene, MATERIAL_DIELECTRIC, vec3(1), 1.5f);
    addSphere(scene, {0, 0.5f, 0}, 0.5f);
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0)).emission = vec3(60);
    addLevel(scene, 3, 0.25, false);
    lookFrom(scene, {0, 1.2, 4}, {0, 0.5, 0}, 40);
    return scene;
}

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
        PreparedScene scene = prepareScene(lampScene(size, seed), BvhBuild::sweep, 2);
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
    PreparedScene scene = prepareScene(lampScene(size, 0), BvhBuild::sweep, 2);
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

}  // namespace
}  // namespace sahl::testing
