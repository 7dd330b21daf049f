// The film is a function of the scene and the sample counts alone: whatever else changes, no bit
// does.

#include "device/variants.h"
#include "render/outline.h"
#include "shared/bindings.h"
#include "support/device_test.h"
#include "support/render_scenes.h"

namespace sahl::testing {
namespace {

constexpr uint32_t WIDTH = 56, HEIGHT = 40, SPP = 16;

class SameBits : public DeviceTest {
protected:
    static const PreparedScene& scene()
    {
        static const PreparedScene prepared =
            prepareScene(builtInScene(smallPicture(WIDTH, HEIGHT, SPP)), BvhBuild::sweep, 2);
        return prepared;
    }

    static const Film& reference()
    {
        static const Film film = renderFilm(*makeCpuDevice({}), scene());
        return film;
    }

    static Film onDevice(const DeviceOptions& options, uint32_t tileSize = 0)
    {
        return renderFilm(*openFirstDevice(options), scene(), 0, SPP, tileSize);
    }
};

TEST_F(SameBits, onTheDeviceAndTheReference)
{
    EXPECT_TRUE(onDevice({}) == reference());
    EXPECT_GT(reference().counters.shadowRays, 0u);
    EXPECT_GT(reference().counters.indirectRays, reference().counters.cameraRays / 4);
    EXPECT_EQ(reference().counters.badSamples, 0u);
}

TEST_F(SameBits, onTheDeviceThatExpectedTheScene_withTheKernelsMadeAhead)
{
    auto device = openFirstDevice();
    device->expectScene(outlineOf(builtInScene(smallPicture(WIDTH, HEIGHT, SPP))));
    EXPECT_EQ(device->statistics().pipelines, 1u);
    EXPECT_TRUE(renderFilm(*device, scene(), 0, SPP) == reference());
    EXPECT_EQ(device->statistics().pipelines, 1u);
}

TEST_F(SameBits, onTheDeviceThatExpectedFewSamples_withKernelsOfAllRegisters)
{
    auto device = openFirstDevice();
    SceneOutline outline = outlineOf(builtInScene(smallPicture(WIDTH, HEIGHT, SPP)));
    outline.samples = uint64_t{WIDTH} * HEIGHT * SPP;
    device->expectScene(outline);
    EXPECT_TRUE(renderFilm(*device, scene(), 0, SPP) == reference());
    EXPECT_EQ(device->statistics().pipelines, 1u);

    // A scene of which nothing was said may be rendered for long
    EXPECT_TRUE(renderFilm(*device, scene(), 0, SPP) == reference());
    const bool registers = device->statistics().variant.find("registers") != std::string::npos;
    EXPECT_EQ(device->statistics().pipelines, registers ? 2u : 1u);
}

TEST_F(SameBits, onTheDeviceThatExpectedAnother_withOtherKernels)
{
    auto device = openFirstDevice();
    Scene other = builtInScene(smallPicture(WIDTH, HEIGHT, SPP));
    other.settings.integrator = INTEGRATOR_PHONG;
    device->expectScene(outlineOf(other));
    EXPECT_TRUE(renderFilm(*device, scene(), 0, SPP) == reference());
    EXPECT_EQ(device->statistics().pipelines, 2u);
}

TEST_F(SameBits, forOneAndManyThreads)
{
    for (unsigned threads : {1u, 2u, 5u}) {
        DeviceOptions options;
        options.threads = threads;
        EXPECT_TRUE(renderFilm(*makeCpuDevice(options), scene()) == reference()) << threads;
    }
}

TEST_F(SameBits, forEveryTileSize)
{
    for (uint32_t tile : {16u, 37u, 64u, 0u}) {
        EXPECT_TRUE(onDevice({}, tile) == reference()) << tile;
        EXPECT_TRUE(renderFilm(*makeCpuDevice({}), scene(), 0, SPP, tile) == reference()) << tile;
    }
}

TEST_F(SameBits, whereTilesAreBegunAhead)
{
    constexpr uint32_t MORE_SAMPLES = 37;
    const Film expected = renderFilm(*makeCpuDevice({}), scene(), 0, MORE_SAMPLES);
    for (uint32_t steps : {0u, 29u}) {
        DeviceOptions options;
        options.beginsAhead = true;
        options.stepBudget = steps;  // with 29 hardly a tile is complete
        auto device = openFirstDevice(options);
        for (uint32_t tile : {19u, 32u, 0u})
            EXPECT_TRUE(renderFilm(*device, scene(), 0, MORE_SAMPLES, tile) == expected) << tile << ", " << steps;
        // Of 9, 4 and 1 tiles a pass, in 5 passes each, nearly all
        if (steps == 0)
            EXPECT_GT(device->statistics().tilesBegunAhead, 50u);
        else
            EXPECT_GT(device->statistics().resumptions, 50u);
    }
}

TEST_F(SameBits, wherePathsRunOutOfSteps_byAnotherKernelThatSavesThem)
{
    for (uint32_t steps : {0u, 29u}) {
        DeviceOptions options;
        options.variant = "storage-8x8-by8";
        options.stepBudget = steps;
        auto device = openFirstDevice(options);
        EXPECT_TRUE(renderFilm(*device, scene(), 0, SPP) == reference()) << steps;
        EXPECT_EQ(device->statistics().pipelines, steps == 0 ? 1u : 2u);
        EXPECT_EQ(device->statistics().resumptions > 0, steps != 0);
    }
}

TEST_F(SameBits, whereAnotherTileFollowsThanWasBegunAhead)
{
    DeviceOptions options;
    options.beginsAhead = true;
    auto device = openFirstDevice(options), cpu = makeCpuDevice({});
    const TileRequest tile = {8, 4, 16, 12, 0, 8}, expected = {24, 4, 16, 12, 0, 8}, another = {3, 2, 40, 30, 8, 5};
    for (Device* each : {device.get(), cpu.get()}) each->setScene(scene().deviceScene());
    for (int round = 0; round < 3; round++) {
        for (const TileRequest& asked : {tile, another, tile, expected, tile}) {
            std::vector<PixelBlock> blocks(size_t{asked.width} * asked.height), reference = blocks;
            device->expectTile(expected);
            device->render(asked, blocks);
            cpu->render(asked, reference);
            EXPECT_EQ(std::memcmp(blocks.data(), reference.data(), blocks.size() * sizeof(PixelBlock)), 0);
        }
        device->setScene(scene().deviceScene());
    }
    EXPECT_EQ(device->statistics().tilesBegunAhead, 3u) << "the expected one in each round";
}

TEST_F(SameBits, forEveryWorkgroupShape)
{
    for (auto [width, height] : {std::pair{8u, 8u}, {32u, 4u}, {1u, 1u}, {5u, 3u}}) {
        DeviceOptions options;
        options.groupWidth = width;
        options.groupHeight = height;
        EXPECT_TRUE(onDevice(options) == reference()) << width << "x" << height;
    }
}

TEST_F(SameBits, forEveryVariantThatCanBeTuned)
{
    for (const Variant& variant : allVariants()) {
        DeviceOptions options;
        options.variant = nameOf(variant);
        EXPECT_TRUE(onDevice(options) == reference()) << options.variant;
    }
}

TEST_F(SameBits, whateverAWalkKeepsItsStackIn_stepByStepOrNot)
{
    for (const char* walk : {"", "-registers", "-steps", "-registers-steps"}) {
        DeviceOptions options;
        options.variant = std::string("storage-8x8-by8") + walk;
        EXPECT_TRUE(onDevice(options) == reference()) << options.variant;
    }
}

TEST_F(SameBits, whereWalksAreNotWatched_stepByStepOrNot)
{
    for (const char* variant : {"texel-8x8-by8", "texel-8x8-by8-steps", "texel-8x8-by8-registers-steps", "texel-wave-steps"}) {
        DeviceOptions options;
        options.variant = variant;
        options.trustsLoops = true;
        auto device = openFirstDevice(options);
        EXPECT_TRUE(renderFilm(*device, scene(), 0, SPP) == reference()) << variant;
        EXPECT_FALSE(device->statistics().walksWatched) << variant;
    }
}

TEST_F(SameBits, throughStorageBuffersAndTexelBuffers)
{
    DeviceOptions options;
    options.buffers = DeviceOptions::Buffers::storage;
    EXPECT_TRUE(onDevice(options) == reference());
    options.buffers = DeviceOptions::Buffers::texel;
    EXPECT_TRUE(onDevice(options) == reference());
}

/// The film without the work that was counted: what another tree may not change.
void expectSameLight(const Film& a, const Film& b)
{
    EXPECT_TRUE(a.half[0] == b.half[0]);
    EXPECT_TRUE(a.half[1] == b.half[1]);
    EXPECT_EQ(a.digest, b.digest);
}

TEST_F(SameBits, ofFirstHits)
{
    TileRequest tile = {0, 0, WIDTH, HEIGHT, 0, BLOCK_SIZE};
    std::vector<FirstHits> expected(WIDTH * HEIGHT), found(WIDTH * HEIGHT);
    auto cpu = makeCpuDevice({});
    cpu->setScene(scene().deviceScene());
    cpu->renderFirstHits(tile, expected);
    for (uint32_t steps : {0u, 29u}) {
        DeviceOptions options;
        options.stepBudget = steps;
        auto device = openFirstDevice(options);
        device->setScene(scene().deviceScene());
        device->renderFirstHits(tile, found);
        EXPECT_EQ(std::memcmp(found.data(), expected.data(), found.size() * sizeof(FirstHits)), 0);
    }
}

TEST_F(SameBits, withExactDivisionAndRoot)
{
    DeviceOptions options;
    options.math = DeviceOptions::Math::exact;
    auto device = openFirstDevice(options);
    EXPECT_TRUE(device->statistics().exactMath);
    EXPECT_TRUE(renderFilm(*device, scene()) == reference());
}

TEST_F(SameBits, forSweepAndBinnedTrees)
{
    PreparedScene binned =
        prepareScene(builtInScene(smallPicture(WIDTH, HEIGHT, SPP)), BvhBuild::binned, 2);
    Film cpu = renderFilm(*makeCpuDevice({}), binned);
    expectSameLight(cpu, reference());
    EXPECT_TRUE(renderFilm(*openFirstDevice(), binned) == cpu);
}

TEST_F(SameBits, forEveryOrderOfTraversal)
{
    for (uint32_t order : {ORDER_LEFT_FIRST, ORDER_RIGHT_FIRST}) {
        DeviceOptions options;
        options.traversalOrder = order;
        Film cpu = renderFilm(*makeCpuDevice(options), scene());
        expectSameLight(cpu, reference());
        EXPECT_TRUE(onDevice(options) == cpu);
    }
}

TEST_F(SameBits, forNodesOfTwoAndOfFourChildren)
{
    DeviceOptions options;
    options.nodeWidth = 2;
    const Film cpu = renderFilm(*makeCpuDevice(options), scene());
    expectSameLight(cpu, reference());
    EXPECT_NE(cpu.counters.boxTests, reference().counters.boxTests);
    EXPECT_TRUE(onDevice(options) == cpu);
}

TEST_F(SameBits, inOneGoAndMergedFromParts)
{
    auto device = openFirstDevice();
    Film whole = renderFilm(*device, scene(), 0, 64);
    Film first = renderFilm(*device, scene(), 0, 32);
    Film second = renderFilm(*device, scene(), 32, 32);
    Film merged = first;
    merged.merge(second);
    EXPECT_TRUE(merged == whole);
    second.merge(first);
    EXPECT_TRUE(second == whole);
}

TEST_F(SameBits, withAPartialBlock)
{
    auto device = openFirstDevice();
    auto cpu = makeCpuDevice({});
    for (uint32_t spp : {1u, 3u, 13u}) {
        EXPECT_TRUE(renderFilm(*device, scene(), 0, spp) == renderFilm(*cpu, scene(), 0, spp))
            << spp;
    }
}

TEST_F(SameBits, whenPathsRunOutOfStepsAndGoOn)
{
    DeviceOptions options;
    options.stepBudget = 37;
    auto device = openFirstDevice(options);
    EXPECT_TRUE(renderFilm(*device, scene()) == reference());
    EXPECT_GT(device->statistics().resumptions, 0u);
}

TEST_F(SameBits, whenTheDriverCutsLoops)
{
    // lavapipe 22.3 ends every loop after 65,535 iterations of a SIMD group, without a word. With
    // an unlimited step budget, 4,000 bounces in a closed white box go far beyond that.
    Scene scene = builtInScene(smallPicture(16, 16, 1));
    scene.settings.maxBounces = 4000;
    for (Material& material : scene.materials) material.baseColor = vec3(1);
    addBox(scene, scene.camera.position, 9);
    PreparedScene box = prepareScene(std::move(scene), BvhBuild::sweep, 2);

    DeviceOptions options;
    options.stepBudget = 1u << 30;
    auto device = openFirstDevice(options);
    Film film = renderFilm(*device, box);
    EXPECT_TRUE(film == renderFilm(*makeCpuDevice({}), box));
    EXPECT_GT(film.counters.bounces, 16u * 16 * 1000) << "the box does not hold the paths";
    if (device->info().driver.find("Mesa 22.3") != std::string::npos) {
        EXPECT_GT(device->statistics().retries, 0u) << "the guard did not see the cut";
    }
}

}  // namespace
}  // namespace sahl::testing
