// Both ways of finding light together, against the better one alone: of the whole picture, ray for
// ray, and of each of its regions, sample for sample.
#include "support/render_scenes.h"
#include "support/sample_statistics.h"
#include "support/veach_scene.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace sahl::testing {
namespace {

constexpr uint32_t COLUMNS = 8, ROWS = 4;  // regions of the picture

/// Mean and its standard error, of numbers that are measured again and again.
struct Estimate {
    double mean = 0, error = 0;
};

Estimate estimateOf(const std::vector<double>& values)
{
    const double n = double(values.size());
    double sum = 0, sum2 = 0;
    for (double value : values) sum += value / n;
    for (double value : values) sum2 += (value - sum) * (value - sum);
    return {sum, std::sqrt(sum2 / (n * (n - 1)))};
}

/// The mean of a over that of b, which were measured together.
Estimate ratioOf(const std::vector<double>& a, const std::vector<double>& b)
{
    const double below = estimateOf(b).mean;
    const double ratio = estimateOf(a).mean / below;
    std::vector<double> residues;
    for (size_t i = 0; i < a.size(); i++) residues.push_back((a[i] - ratio * b[i]) / below);
    return {ratio, estimateOf(residues).error};
}

/// What a way of finding light costs and is worth, in several parts of the samples.
struct Measured {
    std::vector<double> regions[COLUMNS * ROWS];  ///< variance of a sample, in each part
    std::vector<double> frame;
    double rays = 0;
};

Measured measure(Scene scene, uint32_t way, uint32_t parts, uint32_t spp)
{
    scene.settings.lightSampling = way;
    const PreparedScene prepared = prepareScene(std::move(scene), BvhBuild::automatic, 2);
    const auto device = makeCpuDevice({});
    Measured found;
    for (uint32_t part = 0; part < parts; part++) {
        const Film film = renderFilm(*device, prepared, part * spp, spp);
        double regions[COLUMNS * ROWS] = {}, frame = 0;
        for (uint32_t y = 0; y < film.height; y++) {
            for (uint32_t x = 0; x < film.width; x++) {
                const double variance = sampleStatistics(film, size_t{y} * film.width + x).variance;
                regions[y * ROWS / film.height * COLUMNS + x * COLUMNS / film.width] += variance;
                frame += variance;
            }
        }
        const double pixels = double(film.width) * film.height;
        for (size_t r = 0; r < COLUMNS * ROWS; r++)
            found.regions[r].push_back(regions[r] * COLUMNS * ROWS / pixels);
        found.frame.push_back(frame / pixels);
        found.rays += double(film.counters.cameraRays + film.counters.indirectRays +
                             film.counters.shadowRays) /
                      (pixels * parts * spp);
    }
    return found;
}
/// The ways by themselves, and both together.
struct Ways {
    Measured mis, lights, bsdf;
};

Ways measure(const Scene& scene, uint32_t parts, uint32_t spp)
{
    return {measure(scene, LIGHTS_MIS, parts, spp), measure(scene, LIGHTS_ONLY, parts, spp),
            measure(scene, LIGHTS_BSDF_ONLY, parts, spp)};
}

/// In every region at most 1.1 times the variance of the better way, at the same samples: as far as
/// is known with a chance of 1 % to be wrong about any of them, and known to 0.1 or better.
/// Returns the largest such ratio.
double expectNoRegionMuchWorse(const Ways& ways)
{
    constexpr double SIDAK = 3.42;  // of 32 one-sided tests, 1 %
    double worst = 0;
    for (size_t r = 0; r < COLUMNS * ROWS; r++) {
        const double lights = estimateOf(ways.lights.regions[r]).mean;
        const double bsdf = estimateOf(ways.bsdf.regions[r]).mean;
        const Measured& better = lights < bsdf ? ways.lights : ways.bsdf;
        if (!(std::min(lights, bsdf) > 0)) continue;
        const Estimate ratio = ratioOf(ways.mis.regions[r], better.regions[r]);
        EXPECT_LT(ratio.mean - SIDAK * ratio.error, 1.1)
            << "region " << r % COLUMNS << ", " << r / COLUMNS << ": " << ratio.mean << " +- "
            << ratio.error << " of the better of " << lights << " and " << bsdf;
        EXPECT_LT(ratio.error, 0.1);
        worst = std::max(worst, ratio.mean);
    }
    return worst;
}

/// Variance of a sample in each part of the samples, in a quarter of the picture.
std::vector<double> ofQuarter(const Measured& found, uint32_t right, uint32_t below)
{
    std::vector<double> sum(found.frame.size());
    for (uint32_t y = 0; y < ROWS / 2; y++) {
        for (uint32_t x = 0; x < COLUMNS / 2; x++) {
            const size_t region = (y + below * ROWS / 2) * COLUMNS + x + right * COLUMNS / 2;
            for (size_t part = 0; part < sum.size(); part++)
                sum[part] += found.regions[region][part];
        }
    }
    return sum;
}

/// In every quarter at most 1.1 times the variance of the better way, at the same samples, by two
/// standard errors. Returns the largest such ratio.
Estimate expectNoQuarterMuchWorse(const Ways& ways)
{
    Estimate worst;
    for (uint32_t quarter = 0; quarter < 4; quarter++) {
        const auto of = [&](const Measured& way) {
            return ofQuarter(way, quarter % 2, quarter / 2);
        };
        const bool lights = estimateOf(of(ways.lights)).mean < estimateOf(of(ways.bsdf)).mean;
        const Estimate ratio = ratioOf(of(ways.mis), of(lights ? ways.lights : ways.bsdf));
        EXPECT_LT(ratio.mean + 2 * ratio.error, 1.1)
            << "quarter " << quarter << ": " << ratio.mean << " +- " << ratio.error;
        if (ratio.mean > worst.mean) worst = ratio;
    }
    return worst;
}

/// At equal rays: variance of both ways over that of one.
Estimate ofFrame(const Ways& ways, const Measured& one)
{
    const Estimate ratio = ratioOf(ways.mis.frame, one.frame);
    const double rays = ways.mis.rays / one.rays;
    return {ratio.mean * rays, ratio.error * rays};
}

void record(const char* name, const Estimate& ratio)
{
    ::testing::Test::RecordProperty(name, fmt::format("{:.5g} +- {:.2g}", ratio.mean, ratio.error));
}

/// The whole picture at equal rays, by three standard errors.
void expectFrameLessNoisyThanByEitherWay(const Ways& ways)
{
    const Estimate overLights = ofFrame(ways, ways.lights), overBsdf = ofFrame(ways, ways.bsdf);
    record("frame, of lights alone", overLights);
    record("frame, of bsdf alone", overBsdf);
    EXPECT_LT(overLights.mean + 3 * overLights.error, 1);
    EXPECT_LT(overBsdf.mean + 3 * overBsdf.error, 1);
}

TEST(LongLightRegions, ofVeachsSceneAreNeverMuchNoisierThanByTheBetterWay)
{
    const Ways ways = measure(veachScene(128, 72), 32, 64);
    RecordProperty("worst region", std::to_string(expectNoRegionMuchWorse(ways)));
    expectFrameLessNoisyThanByEitherWay(ways);
}

/// Sponza without light; the last material is that of what is to shine in it.
Scene sponza()
{
    Scene scene = loadScene(assetFolder() / "meshes/miro/sponza.obj", {});
    scene.settings = {128, 72, 0, 6, 1};
    scene.settings.shading |= SHADING_FLAT;
    scene.probe = blackProbe();
    scene.background.reset();
    scene.materials.clear();
    scene.materialNames.clear();
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0.7f));
    for (Primitive& primitive : scene.primitives) primitive.material = 0;
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0)).emission = vec3(900, 800, 600);
    lookFrom(scene, {-9.5, 3, 0}, {0, 3.6, 0}, 65);
    return scene;
}

/// A point of the nearest column on the right, at eye level on the side that is turned to the nave:
/// its normal is -z.
const vec3 COLUMN_SIDE = {-6.6f, 1.9f, 2.52f};

/// A lantern hangs a hand's breadth off the column: a cube of 0.2 m.
Scene sponzaWithLantern()
{
    constexpr float HALF = 0.1f, GAP = 0.1f;
    Scene scene = sponza();
    const size_t first = scene.primitives.size();
    addBox(scene, COLUMN_SIDE - vec3(0, 0, GAP + HALF), HALF);
    for (size_t i = first; i < scene.primitives.size(); i++) scene.primitives[i].material = 1;
    return scene;
}

/// Scattered rays hardly ever find so small a lamp: there is nothing to win over shadow rays, and
/// nothing is lost.
TEST(LongLightRegions, ofSponzaUnderASmallLampAreThoseOfShadowRays)
{
    SAHL_REQUIRE_ASSET("meshes/miro/sponza.obj");
    Scene scene = sponza();
    addSphere(scene, {-10.2f, 4.5f, 1}, 0.1f);  // in the open, behind the camera
    const Ways ways = measure(scene, 16, 16);
    RecordProperty("worst region", std::to_string(expectNoRegionMuchWorse(ways)));
    const Estimate overLights = ofFrame(ways, ways.lights), overBsdf = ofFrame(ways, ways.bsdf);
    record("frame, of lights alone", overLights);
    record("frame, of bsdf alone", overBsdf);
    EXPECT_LT(overLights.mean, 1.001);
    EXPECT_LT(overBsdf.mean + 3 * overBsdf.error, 0.1);
}

/// Points close to the lantern receive much from the little of it that is closest, where a shadow
/// ray seldom goes; from elsewhere the lantern is small. Quarters rather than regions: most of the
/// picture is lit by paths that come by the lantern, which are too rare to tell smaller parts from
/// each other.
TEST(LongLightRegions, ofSponzaByALanternOnAColumnAreLessNoisyThanByEitherWay)
{
    SAHL_REQUIRE_ASSET("meshes/miro/sponza.obj");
    const Ways ways = measure(sponzaWithLantern(), 32, 16);
    record("worst quarter", expectNoQuarterMuchWorse(ways));
    expectFrameLessNoisyThanByEitherWay(ways);
}

/// Without light by way of other surfaces all regions are known.
TEST(LongLightRegions, ofSponzaRightFromALanternAreNeverMuchNoisierThanByTheBetterWay)
{
    SAHL_REQUIRE_ASSET("meshes/miro/sponza.obj");
    Scene scene = sponzaWithLantern();
    scene.settings.maxBounces = 1;
    const Ways ways = measure(scene, 32, 8);
    RecordProperty("worst region", std::to_string(expectNoRegionMuchWorse(ways)));
    expectFrameLessNoisyThanByEitherWay(ways);
}

/// Balls are sampled by the solid angle that they fill, from which no point is too close.
TEST(LongLightRegions, ofSponzaRightFromABallAreAlmostThoseOfShadowRays)
{
    SAHL_REQUIRE_ASSET("meshes/miro/sponza.obj");
    Scene scene = sponza();
    scene.settings.maxBounces = 1;
    constexpr float RADIUS = 0.1f, GAP = 0.01f;
    addSphere(scene, COLUMN_SIDE - vec3(0, 0, GAP + RADIUS), RADIUS);
    const Ways ways = measure(scene, 32, 16);
    RecordProperty("worst region", std::to_string(expectNoRegionMuchWorse(ways)));
    const Estimate overLights = ofFrame(ways, ways.lights), overBsdf = ofFrame(ways, ways.bsdf);
    record("frame, of lights alone", overLights);
    record("frame, of bsdf alone", overBsdf);
    EXPECT_LT(overLights.mean, 1.001);
    EXPECT_LT(overBsdf.mean + 3 * overBsdf.error, 1);
}

}  // namespace
}  // namespace sahl::testing
