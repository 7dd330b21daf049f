// Three ways of finding light: by shadow rays, by scattered rays, and by both. They have the same
// mean, and both together have less noise than either alone.
#include "support/light_scenes.h"
#include "support/render_scenes.h"
#include "support/sample_statistics.h"
#include "support/veach_scene.h"

#include <gtest/gtest.h>

namespace sahl::testing {
namespace {

struct Statistics {
    double mean = 0;      ///< of the luminance, over all pixels
    double variance = 0;  ///< of a sample about its pixel's mean, over all pixels
    double error = 0;     ///< of the mean
};

/// Rows [top, bottom) of the picture.
Statistics statisticsOf(const Film& film, uint32_t width, size_t top, size_t bottom)
{
    Statistics all;
    const double pixels = double(bottom - top) * width;
    for (size_t i = top * width; i < bottom * width; i++) {
        const SampleStatistics pixel = sampleStatistics(film, i);
        all.mean += pixel.mean / pixels;
        all.variance += pixel.variance / pixels;
        all.error += pixel.variance / pixel.count / (pixels * pixels);
    }
    all.error = std::sqrt(all.error);
    return all;
}

Film filmBy(Scene scene, uint32_t lightSampling, uint32_t spp)
{
    scene.settings.lightSampling = lightSampling;
    scene.settings.seed = lightSampling;
    const PreparedScene prepared = prepareScene(std::move(scene), BvhBuild::sweep, 2);
    return renderFilm(*makeCpuDevice({}), prepared, 0, spp);
}

TEST(LightStrategies, haveTheSameMean)
{
    constexpr uint32_t SIZE = 24, SPP = 256;
    double worst = 0;
    for (const LightScene& lit : lightScenes(SIZE)) {
        std::vector<Statistics> found;
        for (uint32_t way : {LIGHTS_MIS, LIGHTS_ONLY, LIGHTS_BSDF_ONLY})
            found.push_back(statisticsOf(filmBy(lit.scene, way, SPP), SIZE, 0, SIZE));
        for (int way : {1, 2}) {
            const double z =
                (found[way].mean - found[0].mean) /
                std::sqrt(found[way].error * found[way].error + found[0].error * found[0].error);
            worst = std::max(worst, std::abs(z));
            // 12 tests: 1 % that any of them is beyond 3.4
            EXPECT_LT(std::abs(z), 3.4)
                << lit.name << ", way " << way << ": " << found[way].mean << " +- "
                << found[way].error << ", mis " << found[0].mean << " +- " << found[0].error;
        }
        EXPECT_LT(found[0].variance, found[2].variance) << lit.name;
    }
    EXPECT_GT(worst, 0.1) << "as if the ways were one";
}

/// A floor from above, on which a bright panel stands upright along the top of the picture:
/// scattered rays find it more easily close to it, shadow rays farther away.
Scene panelOnFloor(uint32_t size)
{
    Scene scene = emptyScene(size, size, 1);
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0.7f));
    addRectangle(scene, {-9, 0, 9}, {18, 0, 0}, {0, 0, -18});
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0)).emission = vec3(1);
    addRectangle(scene, {-2, 0, -2}, {4, 0, 0}, {0, 1, 0});
    lookFrom(scene, {0, 7, 0}, {0, 0, 0}, 31.5, {0, 0, -1});
    return scene;
}

TEST(LightStrategies, togetherAreLessNoisyThanEither)
{
    constexpr uint32_t SIZE = 48, SPP = 256;
    const Scene scene = panelOnFloor(SIZE);
    std::vector<Film> films;
    for (uint32_t way : {LIGHTS_MIS, LIGHTS_ONLY, LIGHTS_BSDF_ONLY})
        films.push_back(filmBy(scene, way, SPP));
    auto variance = [&](uint32_t way, size_t top, size_t bottom) {
        return statisticsOf(films[way], SIZE, top, bottom).variance;
    };
    const double all = variance(LIGHTS_MIS, 0, SIZE);
    RecordProperty("lights over mis", std::to_string(variance(LIGHTS_ONLY, 0, SIZE) / all));
    RecordProperty("bsdf over mis", std::to_string(variance(LIGHTS_BSDF_ONLY, 0, SIZE) / all));
    EXPECT_LT(all, variance(LIGHTS_ONLY, 0, SIZE));
    EXPECT_LT(all, variance(LIGHTS_BSDF_ONLY, 0, SIZE));
    for (size_t top = 0; top < SIZE; top += 6) {
        const double lights = variance(LIGHTS_ONLY, top, top + 6);
        const double bsdf = variance(LIGHTS_BSDF_ONLY, top, top + 6);
        EXPECT_LT(variance(LIGHTS_MIS, top, top + 6), 1.1 * std::min(lights, bsdf))
            << top << ": " << lights << " " << bsdf;
    }
}

TEST(LightStrategies, togetherAreLessNoisyThanEitherOnVeachsScene)
{
    constexpr uint32_t SIZE = 64, SPP = 256;
    const Scene scene = veachScene(SIZE, SIZE);
    std::vector<Film> films;
    for (uint32_t way : {LIGHTS_MIS, LIGHTS_ONLY, LIGHTS_BSDF_ONLY}) {
        films.push_back(filmBy(scene, way, SPP));
        EXPECT_EQ(films[way].counters.badSamples, 0u);
    }
    auto variance = [&](uint32_t way, size_t top, size_t bottom) {
        return statisticsOf(films[way], SIZE, top, bottom).variance;
    };
    // Above, the spheres themselves are seen: no way of sampling matters there.
    constexpr size_t PLATES = 24;
    const double all = variance(LIGHTS_MIS, PLATES, SIZE);
    RecordProperty("lights over mis", std::to_string(variance(LIGHTS_ONLY, PLATES, SIZE) / all));
    RecordProperty("bsdf over mis", std::to_string(variance(LIGHTS_BSDF_ONLY, PLATES, SIZE) / all));
    EXPECT_LT(all, variance(LIGHTS_ONLY, PLATES, SIZE) / 2);
    EXPECT_LT(all, variance(LIGHTS_BSDF_ONLY, PLATES, SIZE) / 2);
    for (size_t top = PLATES; top < SIZE; top += 4) {
        const double lights = variance(LIGHTS_ONLY, top, top + 4);
        const double bsdf = variance(LIGHTS_BSDF_ONLY, top, top + 4);
        EXPECT_LT(variance(LIGHTS_MIS, top, top + 4), 1.1 * std::min(lights, bsdf))
            << top << ": " << lights << " " << bsdf;
    }
}

}  // namespace
}  // namespace sahl::testing
