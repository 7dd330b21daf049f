// Adaptive sampling: the counts of samples and the film are a function of the scene and the rule
// alone.

#include "render/verify.h"
#include "shared/bindings.h"
#include "support/adaptive_scenes.h"
#include "support/device_test.h"
#include "support/vulkan_hooks.h"

#include <algorithm>
#include <set>

namespace sahl::testing {
namespace {

constexpr uint32_t WIDTH = 40, HEIGHT = 24;
const AdaptiveRule RULE = reportRule(0.005f, 5, 45);

class Adaptive : public DeviceTest {
protected:
    /// Lamps found by chance make samples differ enough for every kind of count.
    static Scene noisyScene()
    {
        Scene scene = builtInScene(smallPicture(WIDTH, HEIGHT, 1));
        scene.settings.lightSampling = LIGHTS_BSDF_ONLY;
        return scene;
    }

    static const PreparedScene& scene()
    {
        static const PreparedScene prepared = prepareScene(noisyScene(), BvhBuild::sweep, 2);
        return prepared;
    }

    static const RenderResult& reference()
    {
        static const RenderResult result = renderAdaptiveFilm(*makeCpuDevice({}), scene(), RULE);
        return result;
    }

    /// Renders on the device and compares film, counts and outcome with the reference.
    static void expectSame(Device& device, uint32_t tileSize = 0)
    {
        const RenderResult result = renderAdaptiveFilm(device, scene(), RULE, tileSize);
        EXPECT_TRUE(result.film == reference().film);
        EXPECT_EQ(result.adaptive.converged, reference().adaptive.converged);
        EXPECT_EQ(result.adaptive.atMaximum, reference().adaptive.atMaximum);
        EXPECT_EQ(result.passes, reference().passes);
    }

    static void expectSameOnDevice(const DeviceOptions& options, uint32_t tileSize = 0)
    {
        expectSame(*openFirstDevice(options), tileSize);
    }
};

TEST_F(Adaptive, hasTheSameBitsOnTheDeviceAndTheReference)
{
    expectSameOnDevice({});
    // Counts of all kinds occur: the minimum, the maximum, and others inside of blocks.
    std::set<uint32_t> counts;
    for (size_t i = 0; i < WIDTH * HEIGHT; i++) counts.insert(samplesOf(reference().film, i));
    EXPECT_EQ(*counts.begin(), RULE.minSamples);
    EXPECT_EQ(*counts.rbegin(), RULE.maxSamples);
    EXPECT_GT(counts.size(), 30u);
    EXPECT_GT(reference().adaptive.converged, 50u);
    EXPECT_GT(reference().adaptive.atMaximum, 50u);
    EXPECT_EQ(reference().adaptive.converged + reference().adaptive.atMaximum, WIDTH * HEIGHT);
}

TEST_F(Adaptive, hasTheSameBitsForEveryTileSizeAndNumberOfThreads)
{
    expectSameOnDevice({}, 17);
    for (uint32_t tile : {5u, 16u, 37u}) expectSame(*makeCpuDevice({}), tile);
    for (unsigned threads : {1u, 2u, 5u}) {
        DeviceOptions options;
        options.threads = threads;
        expectSame(*makeCpuDevice(options));
    }
}

TEST_F(Adaptive, hasTheSameBitsForEveryWorkgroupShape)
{
    for (auto [width, height] : {std::pair{32u, 4u}, {5u, 3u}}) {
        DeviceOptions options;
        options.groupWidth = width;
        options.groupHeight = height;
        expectSameOnDevice(options);
    }
}

TEST_F(Adaptive, hasTheSameBitsThroughStorageBuffersAndWithExactMath)
{
    DeviceOptions options;
    options.buffers = DeviceOptions::Buffers::storage;
    options.math = DeviceOptions::Math::exact;
    expectSameOnDevice(options);
}

TEST_F(Adaptive, hasTheSameBitsWhenPathsRunOutOfSteps)
{
    DeviceOptions options;
    options.stepBudget = 37;
    auto device = openFirstDevice(options);
    expectSame(*device);
    EXPECT_GT(device->statistics().resumptions, 0u);
}

TEST_F(Adaptive, hasTheSameBitsWhenTheDriverCutsLoops)
{
    // As SameBits.whenTheDriverCutsLoops: lavapipe 22.3 ends loops after 65,535 iterations.
    Scene scene = builtInScene(smallPicture(8, 8, 1));
    scene.settings.maxBounces = 4000;
    for (Material& material : scene.materials) material.baseColor = vec3(1);
    addBox(scene, scene.camera.position, 9);
    PreparedScene box = prepareScene(std::move(scene), BvhBuild::sweep, 2);
    const AdaptiveRule few = reportRule(0.5f, 2, 3);

    DeviceOptions options;
    options.stepBudget = 1u << 30;
    auto device = openFirstDevice(options);
    const RenderResult result = renderAdaptiveFilm(*device, box, few);
    EXPECT_TRUE(result.film == renderAdaptiveFilm(*makeCpuDevice({}), box, few).film);
    if (device->info().driver.find("Mesa 22.3") != std::string::npos) {
        EXPECT_GT(device->statistics().retries, 0u) << "the guard did not see the cut";
    }
}

TEST_F(Adaptive, aWindowHasTheBitsOfTheFullPicture)
{
    for (const char* side : {"cpu", "device"}) {
        auto device = side == std::string("cpu") ? makeCpuDevice({}) : openFirstDevice();
        device->setScene(scene().deviceScene());
        RenderPlan plan = {13, 9, 0, 0, 5, 11, 7};
        const Film window = renderAdaptive(*device, plan, RULE, [](const RenderProgress&) {}).film;
        for (uint32_t y = 0; y < plan.height; y++) {
            for (uint32_t x = 0; x < plan.width; x++) {
                const size_t here = y * plan.width + x, there = (y + plan.top) * WIDTH + x + plan.left;
                for (int h = 0; h < 2; h++)
                    EXPECT_TRUE(window.half[h][here] == reference().film.half[h][there]) << x << " " << y;
            }
        }
    }
}

TEST_F(Adaptive, tilesThatDoNotFitTogetherAreRenderedOneAfterTheOther)
{
    SmallDevice device;
    device.inner = openFirstDevice();
    expectSame(device, 20);
}

TEST_F(Adaptive, verifyComparesCountsAndFindsTheFirstDifferingSample)
{
    auto cpu = makeCpuDevice({});
    auto device = openFirstDevice();
    auto verify = [&](Device& tested) {
        return verifyAdaptive(tested, *cpu, scene().deviceScene(), RULE, 16, [](double) {});
    };
    const VerifyResult same = verify(*device);
    EXPECT_TRUE(same.equal());
    EXPECT_TRUE(same.deviceFilm == reference().film);

    // Another rule on one side: all samples are the same, and some pixels get more of them.
    struct Patient final : SmallDevice {
        std::unique_ptr<AdaptivePicture> beginAdaptive(const AdaptiveWindow& window,
                                                       const AdaptiveRule& rule) override
        {
            AdaptiveRule patient = rule;
            patient.epsilon /= 2;
            return inner->beginAdaptive(window, patient);
        }
    } patient;
    patient.inner = makeCpuDevice({});
    const VerifyResult later = verify(patient);
    EXPECT_FALSE(later.equal());
    EXPECT_GT(later.differingPixels, 50u);
    ASSERT_TRUE(later.first.has_value());
    EXPECT_EQ(later.first->stage, "decision to stop");

    // Another scene on one side: paths differ from the first sample on.
    struct Elsewhere final : SmallDevice {
        void setScene(const DeviceScene& scene) override
        {
            DeviceScene other = scene;
            other.frame.seed++;
            inner->setScene(other);
        }
    } elsewhere;
    elsewhere.inner = makeCpuDevice({});
    const VerifyResult other = verify(elsewhere);
    ASSERT_TRUE(other.first.has_value());
    EXPECT_EQ(other.first->sample, 0u);
    EXPECT_NE(other.first->stage, "decision to stop");
}

TEST_F(Adaptive, memoryOfItsOwn_goesThroughStagingBuffers)
{
    VulkanHooks hooks;
    hooks.discreteMemory = true;
    expectSameOnDevice({}, 23);
}

TEST_F(Adaptive, filmIsThatOfTheSamplesThatEachPixelTook)
{
    // Every pixel again, alone and without a rule, with as many samples as the rule took.
    auto cpu = makeCpuDevice({});
    cpu->setScene(scene().deviceScene());
    const Film& film = reference().film;
    Film expected(WIDTH, HEIGHT);
    for (uint32_t y = 0; y < HEIGHT; y++) {
        for (uint32_t x = 0; x < WIDTH; x++) {
            uint32_t samples = samplesOf(film, y * WIDTH + x);
            for (uint32_t first = 0; first < samples; first += BLOCK_SIZE) {
                PixelBlock block = {};
                cpu->render({x, y, 1, 1, first, std::min(BLOCK_SIZE, samples - first)},
                            {&block, 1});
                expected.add(x, y, 1, 1, first, {&block, 1});
            }
        }
    }
    EXPECT_TRUE(film == expected);
}

TEST_F(Adaptive, finishedPixelsLeaveTheQueue)
{
    auto device = openFirstDevice();
    device->setScene(scene().deviceScene());
    auto picture = device->beginAdaptive({0, 0, WIDTH, HEIGHT}, RULE);
    auto tile = picture->beginTile({0, 0, WIDTH, HEIGHT, 0, 0});
    uint64_t samples = 0, rays = 0;
    uint32_t active = WIDTH * HEIGHT;
    std::vector<AdaptivePixel> pixels(active);
    for (uint32_t pass = 1; active > 0; pass++) {
        AdaptivePass done = tile->runPass();
        samples += done.samples;
        rays += done.rays;
        EXPECT_LE(done.samples, uint64_t{active} * BLOCK_SIZE);
        tile->read(pixels);
        auto isActive = [](const AdaptivePixel& pixel) { return pixel.state == PIXEL_ACTIVE; };
        EXPECT_EQ(done.activePixels, std::ranges::count_if(pixels, isActive)) << "pass " << pass;
        // Only pixels that were active took samples.
        auto tookSamples = [](const AdaptivePixel& pixel) { return pixel.block.samplesDone > 0; };
        EXPECT_EQ(std::ranges::count_if(pixels, tookSamples), active) << "pass " << pass;
        active = done.activePixels;
    }
    EXPECT_EQ(tile->runPass().samples, 0u) << "nothing is left to do";
    const Counters& counters = reference().film.counters;
    EXPECT_EQ(samples, counters.cameraRays);
    EXPECT_EQ(rays, counters.cameraRays + counters.indirectRays + counters.shadowRays);
}

TEST_F(Adaptive, workgroupsAreThoseOfTheActivePixels)
{
    VulkanHooks hooks;
    auto device = openFirstDevice();
    device->setScene(scene().deviceScene());
    auto picture = device->beginAdaptive({0, 0, WIDTH, HEIGHT}, RULE);
    auto tile = picture->beginTile({0, 0, WIDTH, HEIGHT, 0, 0});
    uint32_t active = WIDTH * HEIGHT;
    uint32_t before = 0;
    while (active > 0) {
        hooks.groupsDispatched = 0;
        uint64_t dispatches = device->statistics().dispatches;
        AdaptivePass done = tile->runPass();
        dispatches = device->statistics().dispatches - dispatches;
        ASSERT_EQ(dispatches, BLOCK_SIZE) << "paths ran out of steps";
        // The blocks of the pass before, the paths, and what looks at their blocks.
        EXPECT_EQ(hooks.groupsDispatched,
                  (before + 63) / 64 + (dispatches + 2) * ((active + 63) / 64));
        before = active;
        active = done.activePixels;
    }
}

TEST_F(Adaptive, pictureAfterEachPassIsThatOfAsManySamples)
{
    auto cpu = makeCpuDevice({});
    auto vulkan = openFirstDevice();
    for (Device* device : {cpu.get(), vulkan.get()}) {
        device->setScene(scene().deviceScene());
        auto picture = device->beginAdaptive({0, 0, WIDTH, HEIGHT}, RULE);
        auto tile = picture->beginTile({0, 0, WIDTH, HEIGHT, 0, 0});
        auto other = makeCpuDevice({});
        Film before(WIDTH, HEIGHT);
        std::vector<AdaptivePixel> pixels(WIDTH * HEIGHT);
        for (uint32_t pass = 1; pass <= 3; pass++) {
            tile->runPass();
            tile->read(pixels);
            Film with(WIDTH, HEIGHT), without(WIDTH, HEIGHT);
            with.add(0, 0, WIDTH, HEIGHT, pixels, true);
            without.add(0, 0, WIDTH, HEIGHT, pixels, false);
            const AdaptiveRule shorter =
                reportRule(RULE.epsilon, RULE.minSamples, pass * BLOCK_SIZE);
            EXPECT_TRUE(with == renderAdaptiveFilm(*other, scene(), shorter).film);
            EXPECT_TRUE(without == before) << "a signal in the pass would leave another picture";
            before = with;
        }
    }
}

TEST_F(Adaptive, samplesThatAreNotFiniteCountAsBlackAndAreCounted)
{
    // Light that leaves the range of floats on surfaces that face it.
    Scene bright = noisyScene();
    for (Light& light : bright.lights) light.intensity = vec3(3e38f);
    for (Material& material : bright.materials) material.emission = material.emission * 1e37f;
    PreparedScene prepared = prepareScene(std::move(bright), BvhBuild::sweep, 2);
    const RenderResult onCpu = renderAdaptiveFilm(*makeCpuDevice({}), prepared, RULE);
    const RenderResult onDevice = renderAdaptiveFilm(*openFirstDevice(), prepared, RULE);
    EXPECT_GT(onCpu.film.counters.badSamples, 100u);
    EXPECT_TRUE(onDevice.film == onCpu.film);
}

}  // namespace
}  // namespace sahl::testing
