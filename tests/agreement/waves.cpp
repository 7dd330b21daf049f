// Paths in waves: the bits of the reference whatever the queues do with the paths on their way.
#include "support/device_test.h"
#include "support/light_scenes.h"
#include "support/render_scenes.h"
#include "support/small_scenes.h"
#include "support/source_folder.h"
#include "support/vulkan_hooks.h"

namespace sahl::testing {
namespace {

constexpr uint32_t WIDTH = 24, HEIGHT = 20, SPP = 16;

class Waves : public DeviceTest {
protected:
    static DeviceOptions inWaves(const std::string& variant = "texel-wave")
    {
        DeviceOptions options;
        options.variant = variant;
        return options;
    }

    static PreparedScene load(const std::string& file)
    {
        return prepareScene(
            loadScene(sourceFolder() / "tests/scenes" / file, smallPicture(WIDTH, HEIGHT, SPP)),
            BvhBuild::sweep, 2);
    }

    /// Renders on a device in waves, which must give what the CPU gives.
    static DeviceStatistics expectReference(const DeviceOptions& options,
                                            const PreparedScene& scene)
    {
        auto device = openFirstDevice(options);
        EXPECT_TRUE(renderFilm(*device, scene) == renderFilm(*makeCpuDevice({}), scene))
            << options.variant;
        EXPECT_NE(device->statistics().variant.find("-wave"), std::string::npos);
        return device->statistics();
    }

    static const PreparedScene& builtIn()
    {
        static const PreparedScene prepared =
            prepareScene(builtInScene(smallPicture(WIDTH, HEIGHT, SPP)), BvhBuild::sweep, 2);
        return prepared;
    }
};

TEST_F(Waves, ofFewSlots_takeAllSamplesThroughThem)
{
    for (const char* variant : {"texel-wave-registers", "storage-wave-shared"}) {
        DeviceOptions options = inWaves(variant);
        options.waveSlots = 137;
        const DeviceStatistics statistics = expectReference(options, builtIn());
        EXPECT_GT(statistics.dispatches, 4u * WIDTH * HEIGHT * SPP / 137);
    }
}

TEST_F(Waves, ofOddWorkgroups_haveTheSameBits)
{
    for (const char* variant : {"texel-wave", "texel-wave-shared"}) {
        DeviceOptions options = inWaves(variant);
        options.groupWidth = 5;
        options.groupHeight = 3;
        expectReference(options, builtIn());
    }
}

TEST_F(Waves, withAPartialBlockAndTilesOfAllSizes_haveTheSameBits)
{
    auto device = openFirstDevice(inWaves());
    auto cpu = makeCpuDevice({});
    for (uint32_t spp : {1u, 13u}) {
        const Film expected = renderFilm(*cpu, builtIn(), 0, spp);
        for (uint32_t tile : {0u, 7u})
            EXPECT_TRUE(renderFilm(*device, builtIn(), 0, spp, tile) == expected) << spp;
    }
}

TEST_F(Waves, inWhichWalksRunOutOfSteps_goOn)
{
    DeviceOptions options = inWaves();
    options.stepBudget = 3;
    EXPECT_GT(expectReference(options, builtIn()).resumptions, 0u);
    options.variant = "texel-wave-registers";
    options.waveSlots = 99;
    EXPECT_GT(expectReference(options, load("instances.json")).resumptions, 0u)
        << "inside instances";
}

TEST_F(Waves, ofThePhongIntegrator_haveTheSameBits)
{
    DeviceOptions options = inWaves("texel-wave-shared");
    expectReference(options, load("phong.json"));
    options.stepBudget = 5;
    EXPECT_GT(expectReference(options, load("phong.json")).resumptions, 0u);
}

TEST_F(Waves, thatLookForLightsOfAllKinds_haveTheSameBits)
{
    expectReference(inWaves(), prepareScene(lightScenes(16).back().scene, BvhBuild::sweep, 2));
}

/// Triangles one behind the other; all rays go through all their boxes and past all of them.
Scene stackOfTriangles(uint32_t count)
{
    Scene scene = emptyScene(8, 8, 1);
    scene.settings.spp = 1;
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0.5f));
    scene.probe = addHalves(scene, vec3(1), vec3(1));
    scene.background = scene.probe;
    for (uint32_t i = 0; i < count; i++) {
        Primitive triangle = {};
        const float z = static_cast<float>(i) * 1e-5f;
        triangle.p0 = vec3(0, 0, z);
        triangle.p1 = vec3(1, 0, z);
        triangle.p2 = vec3(0, 1, z);
        triangle.number = i;
        triangle.shape = SHAPE_FLAT;
        scene.primitives.push_back(triangle);
    }
    lookParallel(scene, {0.9, 0.9, -1}, {0.9, 0.9, 0}, 0.05);
    return scene;
}

TEST_F(Waves, inWhichTheDriverCutsAWalk_lowerTheStepsUntilItDoesNot)
{
    // See SameBits.whenTheDriverCutsLoops.
    const PreparedScene scene = prepareScene(stackOfTriangles(90000), BvhBuild::binned, 2);
    DeviceOptions options = inWaves();
    options.stepBudget = 1u << 18;
    auto device = openFirstDevice(options);
    const Film film = renderFilm(*device, scene);
    EXPECT_TRUE(film == renderFilm(*makeCpuDevice({}), scene));
    EXPECT_GT(film.counters.primitiveTests, 64u * 80000) << "the rays miss the boxes";
    if (device->info().driver.find("Mesa 22.3") != std::string::npos) {
        EXPECT_GT(device->statistics().retries, 0u) << "the guard did not see the cut";
        EXPECT_GT(device->statistics().resumptions, 0u);
    }
}

TEST_F(Waves, onADeviceThatBindsFewBuffers_giveWayToWholePaths)
{
    VulkanHooks hooks;
    hooks.changeProperties = [](VkPhysicalDeviceProperties& p) {
        p.limits.maxPerStageDescriptorStorageBuffers = 6;
    };
    auto device = openFirstDevice(inWaves());
    EXPECT_TRUE(renderFilm(*device, builtIn()) == renderFilm(*makeCpuDevice({}), builtIn()));
    EXPECT_EQ(device->statistics().variant.find("-wave"), std::string::npos);
}

TEST_F(Waves, onADeviceWithoutBallots_fillTheirQueuesThroughSharedMemory)
{
    VulkanHooks hooks;
    hooks.noSubgroupBallots = true;
    EXPECT_EQ(expectReference(inWaves(), builtIn()).variant, "texel-wave-shared");
}

}  // namespace
}  // namespace sahl::testing
