// One picture on devices of many kinds: what a driver offers decides how the work is done and
// changes no bit of the result.
#include "support/device_test.h"
#include "support/torus_scene.h"
#include "support/vulkan_hooks.h"
#include "vulkan/buffer.h"

namespace sahl::testing {
namespace {

class VulkanDeviceTest : public DeviceTest {
protected:
    void expectSamePicture(const DeviceOptions& options = {})
    {
        auto device = openFirstDevice(options);
        expectSameBlocks(torus_.render(*device, tile_), torus_.expected(tile_));
        statistics_ = device->statistics();
    }

    TorusScene torus_;
    TileRequest tile_ = TorusScene::wholePicture();
    DeviceStatistics statistics_;
    VulkanHooks hooks_;
};

TEST_F(VulkanDeviceTest, torusIsMetByAGoodPartOfTheRays)
{
    uint64_t met = 0;
    for (const PixelBlock& block : torus_.expected(tile_)) met += block.bounces > 0 ? 1 : 0;
    EXPECT_GT(met, 32u * 24 / 4);
}

TEST_F(VulkanDeviceTest, validationIsOnAndSeesAMissingBarrier)
{
    uint64_t before = validationMessageCount();
    auto context = openFirstContext();
    Buffer buffer = createBuffer(
        *context, {"filled twice", 64, VK_BUFFER_USAGE_TRANSFER_DST_BIT, HostUse::none});
    runCommands(*context, "fill twice without a barrier", [&](VkCommandBuffer commands) {
        vkCmdFillBuffer(commands, buffer.handle.get(), 0, 64, 1);
        vkCmdFillBuffer(commands, buffer.handle.get(), 0, 64, 2);
    });
    EXPECT_GT(validationMessageCount(), before);
    forgiveMessages();
}

TEST_F(VulkanDeviceTest, memoryOfItsOwn_goesThroughStagingBuffers)
{
    hooks_.discreteMemory = true;
    expectSamePicture();
    DeviceOptions storage;
    storage.buffers = DeviceOptions::Buffers::storage;
    expectSamePicture(storage);
}

TEST_F(VulkanDeviceTest, fewTexels_readsTheSceneThroughStorageBuffers)
{
    expectSamePicture();
    EXPECT_TRUE(statistics_.texelBuffers);
    uint64_t texels = torus_.scene.nodes.size_bytes() / 16;
    hooks_.changeProperties = [&](VkPhysicalDeviceProperties& p) {
        p.limits.maxTexelBufferElements = static_cast<uint32_t>(texels - 1);
    };
    expectSamePicture();
    EXPECT_FALSE(statistics_.texelBuffers);
}

TEST_F(VulkanDeviceTest, fourStorageBuffers_areEnoughWithTexelBuffers)
{
    hooks_.changeProperties = [](VkPhysicalDeviceProperties& p) {
        p.limits.maxPerStageDescriptorStorageBuffers = 4;  // what Vulkan promises everywhere
    };
    expectSamePicture();
    EXPECT_TRUE(statistics_.texelBuffers);
}

TEST_F(VulkanDeviceTest, smallWorkgroups_areUsedAsLargeAsTheyMayBe)
{
    for (uint32_t invocations : {1u, 7u, 32u}) {
        hooks_.changeProperties = [&](VkPhysicalDeviceProperties& p) {
            p.limits.maxComputeWorkGroupInvocations = invocations;
            p.limits.maxComputeWorkGroupSize[1] = 3;
        };
        expectSamePicture();
    }
}

TEST_F(VulkanDeviceTest, smallStorageRange_boundsTheTile)
{
    hooks_.changeProperties = [&](VkPhysicalDeviceProperties& p) {
        p.limits.maxStorageBufferRange = 100 * sizeof(SuspendedPath);
    };
    auto device = openFirstDevice();
    EXPECT_EQ(device->maxTilePixels(), 100u);
    tile_ = {3, 5, 20, 5, 8, 8};
    expectSameBlocks(torus_.render(*device, tile_), torus_.expected(tile_));
}

TEST_F(VulkanDeviceTest, scenesAndTilesOfManySizes_oneAfterTheOther)
{
    auto device = openFirstDevice();
    for (uint rings : {3u, 40u, 4u}) {
        TorusScene other(rings, 12, rings);
        for (TileRequest tile : {TileRequest{30, 22, 2, 2, 16, 1}, TorusScene::wholePicture(),
                                 TileRequest{0, 0, 32, 1, 0, 3}}) {
            expectSameBlocks(other.render(*device, tile), other.expected(tile));
        }
    }
}

TEST_F(VulkanDeviceTest, emptyScene_isTheSkyEverywhere)
{
    DeviceScene empty;
    vec4 sky(0.25f, 0.5f, 1.0f, 0.0f);
    empty.frame = torus_.scene.frame;
    empty.frame.rootRef = REF_NONE;
    empty.frame.lightCount = 0;
    empty.probeTexels = {&sky, 1};
    auto device = openFirstDevice();
    device->setScene(empty);
    std::vector<PixelBlock> blocks(32 * 24);
    device->render(tile_, blocks);
    for (const PixelBlock& block : blocks) {
        EXPECT_EQ(block.sum.x, 4 * 0.25f);
        EXPECT_EQ(block.sum.z, 4 * 1.0f);
    }
    empty.frame.background.height = 0;  // no sky, and not a single array
    empty.probeTexels = {};
    device->setScene(empty);
    device->render(tile_, blocks);
    for (const PixelBlock& block : blocks) EXPECT_EQ(block.sum.y, 0.0f);
}

}  // namespace
}  // namespace sahl::testing
