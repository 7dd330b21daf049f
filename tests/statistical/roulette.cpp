// Russian roulette and the clamp of indirect light in pictures: the one changes no mean, the other
// only what it says.

#include "film/film_error.h"
#include "scene/mesh.h"
#include "statistical/lamp_scene.h"
#include "support/render_scenes.h"
#include "support/witness.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sahl::testing {
namespace {

Mean frameMean(const Film& film)
{
    Mean mean;
    const double pixels = double(film.half[0].size());
    double variance = 0;
    for (size_t i = 0; i < film.half[0].size(); i++) {
        const PixelStatistics pixel = pixelStatistics(film, i);
        mean.value += pixel.luminance / pixels;
        variance += pixel.varianceOfMean / (pixels * pixels);
    }
    mean.standardError = std::sqrt(variance);
    return mean;
}

/// The camera is within a sphere that emits 1 and reflects `albedo`.
Scene furnace(float albedo, uint32_t bounces)
{
    Scene scene = emptyScene(16, 16, bounces);
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(albedo)).emission = vec3(1);
    appendShape(scene, makeSphere({0, 0, 0}, 2, 2, false), {}, 0, "sphere");
    lookFrom(scene, {0.3, -0.2, 0.1}, {1, 1, 1}, 70);
    return scene;
}

Film rendered(Scene scene, uint32_t spp)
{
    const PreparedScene prepared = prepareScene(std::move(scene), BvhBuild::sweep, 2);
    Film film = renderFilm(*makeCpuDevice({}), prepared, 0, spp);
    EXPECT_EQ(film.counters.badSamples, 0u);
    return film;
}

/// Indirect rays a camera ray in the furnace, where after every scattering, from `depth` on, a path
/// that carries T goes on with the chance of T's fourth root.
double raysInFurnace(double albedo, uint32_t depth, uint32_t bounces)
{
    double rays = 0, alive = 1, carried = 1;
    for (uint32_t i = 0; i < bounces; i++) {
        carried *= albedo;
        const double survival = i < depth ? 1 : std::max(0.05, std::pow(carried, 0.25));
        alive *= survival;
        carried /= survival;
        rays += alive;
    }
    return rays;
}

TEST(Roulette, leavesTheFurnaceItsClosedForm)
{
    for (float albedo : {0.2f, 0.5f, 0.9f}) {
        for (uint32_t depth : {0u, 3u}) {
            for (uint32_t samplerKind : {SAMPLER_INDEPENDENT, SAMPLER_SOBOL}) {
                constexpr uint32_t BOUNCES = 64;
                const Film plain = rendered(furnace(albedo, BOUNCES), 8);
                Scene scene = furnace(albedo, BOUNCES);
                scene.settings.rouletteDepth = depth;
                scene.settings.samplerKind = samplerKind;
                const Film film = rendered(std::move(scene), 64);
                const Mean mean = frameMean(film);
                const double expected =
                    (1 - std::pow(double(albedo), BOUNCES + 1)) / (1 - double(albedo));
                showWitness(mean, expected, samplerKind == SAMPLER_SOBOL ? "sobol" : "independent");
                EXPECT_NEAR(mean.value, expected, 4 * mean.standardError + 1e-5 * expected)
                    << albedo << ", from depth " << depth << " on";
                EXPECT_LT(mean.standardError, 0.01 * expected);
                const double raysBefore =
                    double(plain.counters.indirectRays) / double(plain.counters.cameraRays);
                const double rays =
                    double(film.counters.indirectRays) / double(film.counters.cameraRays);
                EXPECT_GT(raysBefore, 40) << "all bounces, but that 0.2^43 counts as 0";
                const double raysExpected = raysInFurnace(double(albedo), depth, BOUNCES);
                // 16,384 paths, whose rays have a standard deviation like their mean
                EXPECT_NEAR(rays, raysExpected, 5 * raysExpected / 128) << albedo << ", " << depth;
                EXPECT_LT(rays, raysBefore / 4);
            }
        }
    }
}

/// Diffuse, mirrors and glass under a lamp, in a box whose walls send much back.
Scene busyScene(uint32_t seed)
{
    Scene scene = lampScene(24, 24, seed);
    scene.settings.maxBounces = 32;
    addMaterialOf(scene, MATERIAL_MIRROR, vec3(0.8f));
    addSphere(scene, {1, 0.4f, 0}, 0.4f);
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0.7f, 0.8f, 0.5f));
    addRectangle(scene, {-3, 0, -2}, {6, 0, 0}, {0, 4, 0});
    scene.probe = addHalves(scene, vec3(0.3f), vec3(0));
    return scene;
}

TEST(Roulette, changesNoMean)
{
    const Film without = rendered(busyScene(1), 512);
    Scene scene = busyScene(2);
    scene.settings.rouletteDepth = 0;
    const Film with = rendered(std::move(scene), 512);
    const Mean a = frameMean(without), b = frameMean(with);
    const double error = std::hypot(a.standardError, b.standardError);
    EXPECT_NEAR(a.value, b.value, 4 * error);
    EXPECT_LT(error, 0.03 * a.value);
    EXPECT_LT(with.counters.indirectRays, 0.9 * double(without.counters.indirectRays));
    std::printf(
        "mean %.5f without, %.5f with roulette, +- %.5f; indirect rays %.2f of those without\n",
        a.value, b.value, error,
        double(with.counters.indirectRays) / double(without.counters.indirectRays));
}

TEST(Roulette, playedOnlyAfterTheLastScattering_changesNoBit)
{
    Scene scene = busyScene(1);
    scene.settings.rouletteDepth = scene.settings.maxBounces;
    EXPECT_TRUE(rendered(std::move(scene), 8) == rendered(busyScene(1), 8));
}

TEST(ClampIndirect, cutsOnlyLightThatWasScatteredMoreThanOnce)
{
    auto clamped = [](uint32_t bounces, float most) {
        Scene scene = busyScene(1);
        scene.settings.maxBounces = bounces;
        scene.settings.clampIndirect = most;
        return rendered(std::move(scene), 64);
    };
    // A lamp of 60 is seen directly and by one scattering, but nothing is cut.
    for (uint32_t bounces : {0u, 1u}) {
        const Film film = clamped(bounces, 0.01f);
        EXPECT_TRUE(film == clamped(bounces, 0));
        EXPECT_EQ(film.counters.clamped, 0u);
    }
    const Film free = clamped(8, 0), wide = clamped(8, 1e6f), tight = clamped(8, 0.5f);
    EXPECT_TRUE(free == wide) << "nothing is that bright";
    EXPECT_GT(tight.counters.clamped, 20u);
    EXPECT_LT(frameMean(tight).value, frameMean(free).value);
    EXPECT_GT(frameMean(tight).value, frameMean(clamped(1, 0)).value);
    EXPECT_EQ(tight.counters.indirectRays, free.counters.indirectRays) << "paths are the same";
    EXPECT_TRUE(tight.digest == free.digest);
}

}  // namespace
}  // namespace sahl::testing
