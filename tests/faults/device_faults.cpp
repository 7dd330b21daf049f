// Devices that run out of memory, vanish, hang, lack something or compute nothing: each ends in an
// error that says so, and nothing is left behind (the validation layer reports what is).
#include "support/device_test.h"
#include "support/torus_scene.h"
#include "support/vulkan_hooks.h"
#include "util/error.h"

#include <cstdlib>

namespace sahl::testing {
namespace {

class DeviceFaults : public DeviceTest {
protected:
    static void openAndRender(const TorusScene& torus, DeviceOptions options = {})
    {
        // Cards are asked first how they divide, by buffers of their own; what fails there is not what tests mean.
        options.math = DeviceOptions::Math::exact;
        auto device = openFirstDevice(options);
        torus.render(*device, TorusScene::wholePicture());
        if (options.beginsAhead) renderAhead(*device);
    }

    /// Three tiles, of which each is begun while the one before is read.
    static void renderAhead(Device& device)
    {
        TileRequest tile = TorusScene::wholePicture();
        std::vector<PixelBlock> blocks(size_t{tile.width} * tile.height);
        for (int i = 0; i < 3; i++) {
            tile.firstSample += BLOCK_SIZE;
            TileRequest next = tile;
            next.firstSample += BLOCK_SIZE;
            if (i < 2) device.expectTile(next);
            device.render(tile, blocks);
        }
        EXPECT_EQ(device.statistics().tilesBegunAhead, 2u);
    }

    /// The error that opening a device and rendering ends in; fails the test when there is none.
    Error errorOfRendering(const DeviceOptions& options = {})
    {
        try {
            openAndRender(torus_, options);
        } catch (const Error& error) {
            return error;
        }
        ADD_FAILURE() << "rendering did not fail";
        return Error(ErrorKind::usage, "");
    }

    static void expectMentions(const Error& error, const std::vector<std::string>& words)
    {
        std::string text = error.what();
        for (const std::string& word : words) {
            EXPECT_NE(text.find(word), std::string::npos) << '"' << word << "\" in: " << text;
        }
    }

    /// Runs out of memory at the first call that can, in another run at the one `step` calls later,
    /// and so on; of either kind of memory, and with staging every other time. Gives the number of
    /// runs.
    uint64_t failAtCalls(uint64_t step, const DeviceOptions& options = {})
    {
        uint64_t runs = 0;
        for (bool reached = true; reached; runs++) {
            const VkResult result =
                runs / 2 % 2 == 0 ? VK_ERROR_OUT_OF_DEVICE_MEMORY : VK_ERROR_OUT_OF_HOST_MEMORY;
            FailAt failure = {runs * step, result, ""};
            hooks_.onCall = [&](const std::string& name) { return failure(name); };
            hooks_.discreteMemory = runs % 2 == 1;
            try {
                openAndRender(torus_, options);
                EXPECT_FALSE(failure.reached()) << failure.name << " failed in silence";
            } catch (const Error& error) {
                EXPECT_EQ(error.kind, ErrorKind::deviceLost) << failure.name;
                expectMentions(error, {"out of", "memory", "--device cpu"});
            }
            reached = failure.reached();
        }
        return runs;
    }

    TorusScene torus_;
    VulkanHooks hooks_;
};

TEST_F(DeviceFaults, outOfMemoryAtEverySeventhCall_isAnErrorAndLeavesNothingBehind)
{
    EXPECT_GT(failAtCalls(7), 50u / 7);
}

using LongDeviceFaults = DeviceFaults;

TEST_F(LongDeviceFaults, outOfMemoryAtAnyCall_isAnErrorAndLeavesNothingBehind)
{
    EXPECT_GT(failAtCalls(1), 50u);
}

TEST_F(LongDeviceFaults, outOfMemoryAtAnyCallInWaves_isAnErrorAndLeavesNothingBehind)
{
    DeviceOptions options;
    options.variant = "texel-wave";
    EXPECT_GT(failAtCalls(1, options), 50u);
}

TEST_F(LongDeviceFaults, outOfMemoryAtAnyCallWithTilesBegunAhead_isAnErrorAndLeavesNothingBehind)
{
    DeviceOptions options;
    options.beginsAhead = true;
    EXPECT_GT(failAtCalls(1, options), 70u);
}

TEST_F(DeviceFaults, deviceLostWhileATileIsBegunAhead_isNamedWithTheTile)
{
    DeviceOptions options;
    options.beginsAhead = true;
    for (const char* call : {"vkQueueSubmit", "vkWaitForFences"}) {
        uint64_t calls = 0;
        hooks_.onCall = {};
        auto device = openFirstDevice(options);
        torus_.render(*device, TorusScene::wholePicture());
        hooks_.onCall = [&](const std::string& name) -> std::optional<VkResult> {
            if (name == call && ++calls == 2) return VK_ERROR_DEVICE_LOST;
            return {};
        };
        try {
            renderAhead(*device);
            ADD_FAILURE() << call << ": rendering did not fail";
        } catch (const Error& error) {
            EXPECT_EQ(error.kind, ErrorKind::deviceLost);
            expectMentions(error, {"render tile 32x24 at 0,0, samples 16 to 19", "lost"});
        }
    }
}

TEST_F(DeviceFaults, allocationFails_saysHowMuchWasNeededAndForWhat)
{
    hooks_.onCall = [](const std::string& name) -> std::optional<VkResult> {
        if (name == "vkAllocateMemory") return VK_ERROR_OUT_OF_DEVICE_MEMORY;
        return {};
    };
    expectMentions(errorOfRendering(), {"buffer 'nodes'", "bytes", "GiB"});
}

TEST_F(DeviceFaults, lostDevice_isNamedWithTheTile)
{
    for (const char* call : {"vkQueueSubmit", "vkWaitForFences"}) {
        hooks_.onCall = [&](const std::string& name) -> std::optional<VkResult> {
            if (name == call) return VK_ERROR_DEVICE_LOST;
            return {};
        };
        Error error = errorOfRendering();
        EXPECT_EQ(error.kind, ErrorKind::deviceLost);
        expectMentions(error, {"render tile 32x24 at 0,0, samples 0 to 3", "lost"});
    }
}

TEST_F(DeviceFaults, driverFailure_isNoDevice)
{
    hooks_.onCall = [](const std::string& name) -> std::optional<VkResult> {
        if (name == "vkCreateDevice") return VK_ERROR_INITIALIZATION_FAILED;
        return {};
    };
    Error error = errorOfRendering();
    EXPECT_EQ(error.kind, ErrorKind::noDevice);
    expectMentions(error, {"open device", "VK_ERROR_INITIALIZATION_FAILED"});
}

/// Renders on a device whose work never ends, and leaves with the error's kind.
[[noreturn]] void renderOnHungDevice(VulkanHooks& hooks, const TorusScene& torus)
{
    hooks.onCall = [](const std::string& name) -> std::optional<VkResult> {
        if (name == "vkWaitForFences") return VK_TIMEOUT;
        return {};
    };
    try {
        torus.render(*makeVulkanDevice(0, {}), TorusScene::wholePicture());
    } catch (const Error& error) {
        fmt::print(stderr, "{}\n", error.what());
        std::_Exit(static_cast<int>(error.kind));
    }
    std::_Exit(0);
}

TEST_F(DeviceFaults, deviceThatNeverAnswers_isGivenUpWithoutTouchingItsObjects)
{
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(renderOnHungDevice(hooks_, torus_), ::testing::ExitedWithCode(6), "not responding");
}

TEST_F(DeviceFaults, deviceThatComputesNothing_isNoticed)
{
    hooks_.dropDispatches = true;
    for (const char* variant : {"texel-8x8-by8", "texel-wave"}) {
        DeviceOptions options;
        options.variant = variant;
        Error error = errorOfRendering(options);
        EXPECT_EQ(error.kind, ErrorKind::deviceLost);
        expectMentions(error, {"render tile 32x24 at 0,0", "makes no progress"});
    }
}

TEST_F(DeviceFaults, smallHeap_isRefusedWithNumbersBeforeAnyAllocation)
{
    bool allocated = false;
    hooks_.changeMemory = [](VkPhysicalDeviceMemoryProperties& memory) {
        memory.memoryHeaps[0].size = 50000;
    };
    hooks_.onCall = [&](const std::string& name) -> std::optional<VkResult> {
        allocated = allocated || name == "vkAllocateMemory";
        return {};
    };
    Error error = errorOfRendering();
    EXPECT_EQ(error.kind, ErrorKind::deviceLost);
    expectMentions(error, {"50000 bytes", "--device cpu"});
    EXPECT_FALSE(allocated);
}

TEST_F(DeviceFaults, heapFilledByTheScene_isRefusedForTheTileWithNumbers)
{
    uint64_t scene = torus_.scene.nodes.size_bytes() + torus_.scene.primitives.size_bytes();
    hooks_.changeMemory = [&](VkPhysicalDeviceMemoryProperties& memory) {
        memory.memoryHeaps[0].size = scene + 4096;
    };
    expectMentions(errorOfRendering(), {"buffer 'pixels'", "in use"});
}

TEST_F(DeviceFaults, arraysTooLargeForAnyBuffer_areRefusedWithNumbers)
{
    uint64_t nodes = torus_.scene.nodes.size_bytes();
    hooks_.changeProperties = [](VkPhysicalDeviceProperties& p) {
        p.limits.maxStorageBufferRange = 10000;
        p.limits.maxTexelBufferElements = 1000;
    };
    Error error = errorOfRendering();
    EXPECT_EQ(error.kind, ErrorKind::noDevice);
    expectMentions(error, {"'nodes'", std::to_string(nodes / 16) + " texels", "allows 1000;",
                           std::to_string(nodes) + " bytes", "allows 10000"});
    for (auto buffers : {DeviceOptions::Buffers::texel, DeviceOptions::Buffers::storage}) {
        DeviceOptions options;
        options.buffers = buffers;
        EXPECT_EQ(errorOfRendering(options).kind, ErrorKind::noDevice);
    }
}

TEST_F(DeviceFaults, deviceBelowOurNeeds_isListedAsUnusableWithTheReason)
{
    auto reasonOf = [&](auto change) {
        hooks_.changeProperties = change;
        std::string whyNone;
        std::string reason = listVulkanDevices(whyNone).at(0).unusable;
        try {
            openFirstDevice();
            ADD_FAILURE() << "opened though unusable: " << reason;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind, ErrorKind::noDevice);
            expectMentions(error, {reason});
        }
        return reason;
    };
    EXPECT_NE(reasonOf([](VkPhysicalDeviceProperties& p) {
                  p.apiVersion = VK_API_VERSION_1_0;
              }).find("1.1 is needed"),
              std::string::npos);
    EXPECT_NE(reasonOf([](VkPhysicalDeviceProperties& p) {
                  p.limits.maxPerStageDescriptorStorageBuffers = 4;
                  p.limits.maxPerStageDescriptorSampledImages = 4;
              }).find("4 texel buffers a shader, needs 7, and 4 storage buffers a shader, needs 8"),
              std::string::npos);
}

TEST_F(DeviceFaults, tileThatTheDeviceCannotTake_isRefused)
{
    auto device = openFirstDevice();
    std::vector<PixelBlock> blocks(16);
    EXPECT_THROW(device->render({0, 0, 4, 4, 0, 8}, blocks), Error) << "no scene";
    device->setScene(torus_.scene);
    EXPECT_THROW(device->render({0, 0, 4, 5, 0, 8}, blocks), Error) << "too few blocks";
    EXPECT_THROW(device->render({0, 0, 4, 4, 0, 9}, blocks), Error) << "too many samples";
    EXPECT_THROW(device->render({0, 0, 4, 4, 4, 4}, blocks), Error) << "not at a block's start";
    EXPECT_NO_THROW(device->render({0, 0, 4, 4, 0, 8}, blocks));
}

TEST_F(DeviceFaults, treeDeeperThanAnyStack_isBadInput)
{
    torus_.scene.treeDepth = MAX_STACK_SIZE + 1;
    EXPECT_EQ(errorOfRendering().kind, ErrorKind::badInput);
}

}  // namespace
}  // namespace sahl::testing
