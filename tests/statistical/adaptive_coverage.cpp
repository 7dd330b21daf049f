// Are stated errors honest? How many pixels lie within 1.96 stated standard errors of the right
// value.

#include "film/film_error.h"
#include "statistical/lamp_scene.h"
#include "support/adaptive_scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sahl::testing {
namespace {

constexpr uint32_t SIZE = 48;

/// A ball on a floor under a sky of a probe.
Scene skyScene()
{
    Scene scene = emptyScene(SIZE, SIZE, 6);
    scene.settings.seed = 5;
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0.6f));
    addLevel(scene, 0, 4);
    addSphere(scene, {0, 0.5f, 0}, 0.5f);
    scene.probe = addHalves(scene, vec3(0.5f, 0.7f, 1), vec3(0.1f));
    lookFrom(scene, {0, 1.2, 4}, {0, 0.5, 0}, 40);
    return scene;
}

Scene builtIn()
{
    Scene scene = builtInScene(smallPicture(SIZE, SIZE, 1));
    scene.settings.seed = 6;
    return scene;
}

struct Coverage {
    double inside;   // share of the pixels within 1.96 standard errors of the reference's, both
                     // errors counted
    double tooDark;  // share of the others that are darker than the reference
};

/// Of the luminances of `film`.
Coverage coverage(const Film& film, const Film& reference)
{
    const size_t count = film.half[0].size();
    size_t inside = 0, tooDark = 0;
    for (size_t i = 0; i < count; i++) {
        const PixelStatistics a = pixelStatistics(film, i), b = pixelStatistics(reference, i);
        const double allowed =
            1.96 * std::sqrt(a.varianceOfMean + b.varianceOfMean) + 1e-6 * b.luminance;
        const double off = a.luminance - b.luminance;
        inside += std::abs(off) <= allowed ? 1 : 0;
        tooDark += off < -allowed ? 1 : 0;
    }
    return {double(inside) / double(count), double(tooDark) / double(count - inside)};
}

struct Case {
    const char* name;
    Scene scene;
    uint32_t maxSamples;
    double least;  // coverage that `none` must have
};

void measure(Case tested, uint32_t referenceSamples)
{
    const PreparedScene scene = prepareScene(std::move(tested.scene), BvhBuild::sweep, 2);
    auto device = makeCpuDevice({});
    const Film reference = renderFilm(*device, scene, 1u << 20, referenceSamples);
    auto byNone = [&](uint32_t samples) {
        return coverage(renderFilm(*device, scene, 0, samples), reference);
    };
    auto byRule = [&](const AdaptiveRule& rule) {
        return coverage(renderAdaptiveFilm(*device, scene, rule).film, reference);
    };
    const Coverage none = byNone(tested.maxSamples / 2);
    const Coverage few = byNone(64);
    const Coverage crossed = byRule(targetRule(ADAPTIVE_CROSSED, 0.05f, 64, tested.maxSamples));
    const Coverage joint = byRule(targetRule(ADAPTIVE_JOINT, 0.05f, 64, tested.maxSamples));
    std::printf("%-15s none %.1f %% with %u samples, %.1f %% with 64; crossed %.1f %%, joint %.1f "
                "%%; too dark of those "
                "outside: %.0f, %.0f, %.0f and %.0f %%\n",
                tested.name, 100 * none.inside, tested.maxSamples / 2, 100 * few.inside,
                100 * crossed.inside, 100 * joint.inside, 100 * none.tooDark, 100 * few.tooDark,
                100 * crossed.tooDark, 100 * joint.tooDark);
    // 2304 pixels: one standard error of the share is 0.45 %. Samples of a pixel that has few are
    // not normal; rules stop where they are few.
    EXPECT_GT(none.inside, tested.least);
    EXPECT_LT(none.inside, 0.975);
    EXPECT_GT(crossed.inside, few.inside - 0.02);
}

TEST(LongAdaptiveCoverage, statedErrorsAreHonestWhereSamplesAreManyAndAlike)
{
    measure({"sky", skyScene(), 512, 0.93}, 16384);
    measure({"built-in", builtIn(), 512, 0.90}, 16384);
}

// By `sobol` errors are of the spread of blocks of 8: 64 samples are 8 numbers, and 1.96 standard
// errors estimated from 8 normal numbers hold 90.9 % (Student's t with 7 degrees of freedom), from
// 32 numbers 94.1 %.
TEST(LongAdaptiveCoverage, statedErrorsOfSobolAreThoseOfItsBlocks)
{
    auto bySobol = [](Scene scene) {
        scene.settings.samplerKind = SAMPLER_SOBOL;
        return scene;
    };
    measure({"sky, sobol", bySobol(skyScene()), 512, 0.92}, 16384);
    // Less than that: 89.3 % were measured. A quarter of the pixels are sky that varies by less than
    // the rounding of its squares (docs/adaptive.md).
    measure({"built-in, sobol", bySobol(builtIn()), 512, 0.85}, 16384);
    measure({"lamp, sobol", bySobol(lampScene(SIZE, SIZE, 7)), 1024, 0.80}, 65536);
}

TEST(LongAdaptiveCoverage, statedErrorsAreTooSmallWhereBrightSamplesAreRare)
{
    measure({"lamp", lampScene(SIZE, SIZE, 7), 1024, 0.80}, 65536);
}

}  // namespace
}  // namespace sahl::testing
