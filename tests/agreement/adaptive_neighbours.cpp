// The rules `crossed` and `joint`, which look at neighbours: counts and film are a function of the
// scene and the rule alone, however the picture is cut up.

#include "render/verify.h"
#include "support/adaptive_scenes.h"
#include "support/device_test.h"
#include "support/source_folder.h"
#include "support/vulkan_hooks.h"

#include <algorithm>
#include <map>
#include <set>

namespace sahl::testing {
namespace {

constexpr uint32_t WIDTH = 24, HEIGHT = 16;
constexpr uint32_t PILOTS = 32, MOST = 192;
constexpr float TARGET = 0.1f;

PreparedScene smallScene(uint32_t width = WIDTH, uint32_t height = HEIGHT)
{
    // Lamps found by chance make samples differ enough for every kind of count.
    Scene scene = builtInScene(smallPicture(width, height, 1));
    scene.settings.lightSampling = LIGHTS_BSDF_ONLY;
    return prepareScene(std::move(scene), BvhBuild::sweep, 2);
}

RenderPlan wholePicture(uint32_t tileSize = 0)
{
    return {WIDTH, HEIGHT, 0, 0, tileSize};
}

void ignore(const RenderProgress&) {}

class AdaptiveNeighbours : public DeviceTest, public ::testing::WithParamInterface<uint32_t> {
protected:
    AdaptiveRule rule() const { return targetRule(GetParam(), TARGET, PILOTS, MOST); }

    static const PreparedScene& scene()
    {
        static const PreparedScene prepared = smallScene();
        return prepared;
    }

    const RenderResult& reference() const
    {
        static std::map<uint32_t, RenderResult> results;  // by rule
        if (!results.contains(GetParam()))
            results[GetParam()] = renderAdaptiveFilm(*makeCpuDevice({}), scene(), rule());
        return results.at(GetParam());
    }

    void expectSame(Device& device, uint32_t tileSize = 0) const
    {
        const RenderResult result = renderAdaptiveFilm(device, scene(), rule(), tileSize);
        EXPECT_TRUE(result.film == reference().film);
        EXPECT_TRUE(result.adaptive == reference().adaptive);
        EXPECT_EQ(result.passes, reference().passes);
    }

    void expectSameOnDevice(const DeviceOptions& options, uint32_t tileSize = 0) const
    {
        expectSame(*openFirstDevice(options), tileSize);
    }
};

INSTANTIATE_TEST_SUITE_P(, AdaptiveNeighbours, ::testing::Values(ADAPTIVE_CROSSED, ADAPTIVE_JOINT),
                         [](const auto& tested) {
                             return tested.param == ADAPTIVE_CROSSED ? "crossed" : "joint";
                         });

TEST_P(AdaptiveNeighbours, hasTheSameBitsOnTheDeviceAndTheReference)
{
    expectSameOnDevice({});
    // Counts of all kinds occur: the minimum, the maximum, and others.
    std::set<uint32_t> counts;
    for (size_t i = 0; i < WIDTH * HEIGHT; i++) counts.insert(samplesOf(reference().film, i));
    EXPECT_EQ(*counts.begin(), PILOTS);
    EXPECT_EQ(*counts.rbegin(), MOST);
    EXPECT_GT(counts.size(), 5u);
    EXPECT_GT(reference().adaptive.converged, 20u);
    EXPECT_GT(reference().adaptive.atMaximum, 20u);
    EXPECT_EQ(reference().adaptive.converged + reference().adaptive.atMaximum, WIDTH * HEIGHT);
}

TEST_P(AdaptiveNeighbours, hasTheSameBitsForEveryTileSizeAndNumberOfThreads)
{
    expectSameOnDevice({}, 7);
    for (uint32_t tile : {5u, 37u}) expectSame(*makeCpuDevice({}), tile);
    DeviceOptions options;
    options.threads = 5;
    expectSame(*makeCpuDevice(options));
}

TEST_P(AdaptiveNeighbours, hasTheSameBitsForOtherGroupsBuffersAndArithmetic)
{
    DeviceOptions options;
    options.groupWidth = 5;
    options.groupHeight = 3;
    options.buffers = DeviceOptions::Buffers::storage;
    options.math = DeviceOptions::Math::exact;
    expectSameOnDevice(options);
}

TEST_P(AdaptiveNeighbours, hasTheSameBitsWhenPathsRunOutOfSteps)
{
    DeviceOptions options;
    options.stepBudget = 200;
    auto device = openFirstDevice(options);
    expectSame(*device, 13);
    EXPECT_GT(device->statistics().resumptions, 0u);
}

TEST_P(AdaptiveNeighbours, memoryOfItsOwn_goesThroughStagingBuffers)
{
    VulkanHooks hooks;
    hooks.discreteMemory = true;
    expectSameOnDevice({}, 23);
}

TEST_P(AdaptiveNeighbours, verifyComparesAllTilesTogether)
{
    auto cpu = makeCpuDevice({});
    auto device = openFirstDevice();
    const VerifyResult same =
        verifyAdaptive(*device, *cpu, scene().deviceScene(), rule(), 16, [](double) {});
    EXPECT_TRUE(same.equal());
    EXPECT_TRUE(same.deviceFilm == reference().film);

    // Another target on one side: all samples are the same, and some pixels get more of them.
    struct Patient final : SmallDevice {
        std::unique_ptr<AdaptivePicture> beginAdaptive(const AdaptiveWindow& window,
                                                       const AdaptiveRule& rule) override
        {
            AdaptiveRule patient = rule;
            patient.targetError *= 0.7f;
            return inner->beginAdaptive(window, patient);
        }
    } patient;
    patient.inner = makeCpuDevice({});
    const VerifyResult later =
        verifyAdaptive(patient, *cpu, scene().deviceScene(), rule(), 16, [](double) {});
    EXPECT_GT(later.differingPixels, 50u);
    ASSERT_TRUE(later.first.has_value());
    EXPECT_EQ(later.first->stage, "decision to stop");
}

/// A window of a picture of instances on the device and on the CPU.
void expectSameWindowOfInstances(std::unique_ptr<Device> device, const AdaptiveRule& rule)
{
    const fs::path path = sourceFolder() / "tests/scenes/instances.json";
    SceneOptions options;
    options.width = 32;
    options.height = 24;
    const PreparedScene instances = prepareScene(loadScene(path, options), BvhBuild::sweep, 2);
    ASSERT_FALSE(instances.deviceScene().instances.empty());
    const RenderPlan window = {19, 11, 0, 0, 7, 6, 5};
    auto filmOn = [&](Device& renderer) {
        renderer.setScene(instances.deviceScene());
        return renderAdaptive(renderer, window, rule, ignore).film;
    };
    const Film film = filmOn(*device);
    EXPECT_TRUE(film == filmOn(*makeCpuDevice({})));
    EXPECT_GT(film.counters.indirectRays, 1000u);
}

TEST_P(AdaptiveNeighbours, windowsOfInstancesHaveTheSameBits)
{
    expectSameWindowOfInstances(openFirstDevice(), rule());
}

TEST_P(AdaptiveNeighbours, passesAddUpToThePictureAndCanBeHadAlone)
{
    // The picture after each pass, as --partial gets it, is the one that --passes makes.
    auto device = openFirstDevice();
    device->setScene(scene().deviceScene());
    auto cpu = makeCpuDevice({});
    cpu->setScene(scene().deviceScene());
    uint32_t passes = 0, compared = 0;
    renderAdaptive(*device, wholePicture(19), rule(), ignore,
                   [&](const std::function<RenderResult()>& soFar) {
                       passes++;
                       if (passes != 3 && passes != 7 && passes != 8) return;
                       RenderPlan plan = wholePicture();
                       plan.maxPasses = passes;
                       const RenderResult alone = renderAdaptive(*cpu, plan, rule(), ignore);
                       EXPECT_TRUE(soFar().film == alone.film) << passes;
                       EXPECT_EQ(alone.passes, passes);
                       EXPECT_EQ(alone.stoppedBy, StoppedBy::passes);
                       compared++;
                   });
    EXPECT_EQ(compared, 3u);
    EXPECT_EQ(passes + 1, reference().passes);
}

TEST_P(AdaptiveNeighbours, aPictureThatDoesNotFitIsRefused)
{
    SmallDevice device;
    device.inner = makeCpuDevice({});
    device.setScene(scene().deviceScene());
    try {
        renderAdaptive(device, wholePicture(8), rule(), ignore);
        FAIL() << "not refused";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind, ErrorKind::deviceLost);
        EXPECT_NE(
            std::string(error.what()).find("room for 300 of them; render it in parts with --crop"),
            std::string::npos)
            << error.what();
    }
}

TEST_P(AdaptiveNeighbours, finishedPixelsLeaveTheQueues)
{
    auto device = openFirstDevice();
    device->setScene(scene().deviceScene());
    uint64_t rays = 0;
    double fraction = 0;
    const RenderResult result =
        renderAdaptive(*device, wholePicture(), rule(), [&](const RenderProgress& progress) {
            rays = progress.rays;
            EXPECT_GE(progress.fraction, fraction * 0.999);
            fraction = progress.fraction;
        });
    const Counters& counters = result.film.counters;
    EXPECT_EQ(rays, counters.cameraRays + counters.indirectRays + counters.shadowRays);
    EXPECT_LT(counters.cameraRays, uint64_t{WIDTH} * HEIGHT * MOST * 9 / 10);
}

/// The rule `crossed` alone.
class AdaptiveCrossed : public DeviceTest {};

const AdaptiveRule CROSSED = targetRule(ADAPTIVE_CROSSED, TARGET, PILOTS, MOST);

TEST_F(AdaptiveCrossed, filmIsThatOfTheBlocksOfEachHalf)
{
    const PreparedScene scene = smallScene();
    auto cpu = makeCpuDevice({});
    const Film film = renderAdaptiveFilm(*cpu, scene, CROSSED).film;
    Film expected(WIDTH, HEIGHT);
    expected.halvesWeighEqually = true;
    size_t unequal = 0;
    for (uint32_t pixel = 0; pixel < WIDTH * HEIGHT; pixel++) {
        const uint32_t x = pixel % WIDTH, y = pixel / WIDTH;
        for (uint32_t h = 0; h < 2; h++) {
            const uint32_t samples = film.half[h][pixel].samples;
            EXPECT_EQ(samples % BLOCK_SIZE, 0u);
            EXPECT_GE(samples, PILOTS / 2);
            EXPECT_LE(samples, MOST / 2);
            for (uint32_t i = 0; i < samples / BLOCK_SIZE; i++) {
                PixelBlock block = {};
                const uint32_t first = (2 * i + h) * BLOCK_SIZE;
                cpu->render({x, y, 1, 1, first, BLOCK_SIZE}, {&block, 1});
                expected.add(x, y, 1, 1, first, {&block, 1});
            }
        }
        unequal += film.half[0][pixel].samples != film.half[1][pixel].samples ? 1 : 0;
    }
    EXPECT_TRUE(film == expected);
    EXPECT_GT(unequal, 100u) << "the halves have equal counts: nothing is crossed";
}

TEST_F(AdaptiveCrossed, samplesOfAHalfAfterAnyPassDependOnThatHalfAlone)
{
    const PreparedScene scene = smallScene();
    auto cpu = makeCpuDevice({});
    const Film whole = renderAdaptiveFilm(*cpu, scene, CROSSED).film;
    for (uint32_t passes : {1u, 4u, 5u, 9u, 14u}) {
        RenderPlan plan = wholePicture();
        plan.maxPasses = passes;
        const Film film = renderAdaptive(*cpu, plan, CROSSED, ignore).film;
        for (size_t i = 0; i < film.half[0].size(); i++) {
            ASSERT_EQ(film.half[0][i].samples,
                      std::min(whole.half[0][i].samples, (passes + 1) / 2 * 8));
            ASSERT_EQ(film.half[1][i].samples, std::min(whole.half[1][i].samples, passes / 2 * 8));
        }
    }
}

TEST_F(DeviceTest, reportHasTheSameBitsWithInstancesAndInWindows)
{
    expectSameWindowOfInstances(openFirstDevice(), reportRule(0.01f, 5, 45));
}

}  // namespace
}  // namespace sahl::testing
