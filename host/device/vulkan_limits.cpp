#include "device/vulkan_limits.h"

#include <algorithm>
#include <numeric>

namespace sahl {

namespace {

constexpr uint64_t TEXEL_BYTES = 16;
constexpr uint32_t TILE_STORAGE_BUFFERS = 2;  // pixels and suspended paths
// Instances are read through a texel buffer in any case, which every Vulkan device has.
constexpr uint32_t ALL_STORAGE_BUFFERS = TILE_STORAGE_BUFFERS + SCENE_BUFFER_COUNT - 1;

/// Empty, or why a shader cannot have so many texel buffers.
std::string whyNoTexelBuffers(const PhysicalDevice& device, uint32_t needed)
{
    uint32_t allowed = device.properties.limits.maxPerStageDescriptorSampledImages;
    if (!device.rgba32uiTexelBuffers) return "no texel buffers of format R32G32B32A32_UINT";
    if (allowed < needed)
        return fmt::format("{} texel buffers a shader, needs {}", allowed, needed);
    return {};
}

/// Empty, or why scenes cannot be read through texel buffers at all.
std::string whyNoTexelBuffers(const PhysicalDevice& device)
{
    return whyNoTexelBuffers(device, SCENE_BUFFER_COUNT);
}

std::string whyNoStorageBuffers(const PhysicalDevice& device)
{
    std::string noInstances = whyNoTexelBuffers(device, 1);
    if (!noInstances.empty()) return noInstances;
    uint32_t allowed = device.properties.limits.maxPerStageDescriptorStorageBuffers;
    if (allowed < ALL_STORAGE_BUFFERS)
        return fmt::format("{} storage buffers a shader, needs {}", allowed, ALL_STORAGE_BUFFERS);
    return {};
}

/// Empty, or why the array at a binding is too large for it.
std::string whyTooLarge(const SceneBytes& bytes, uint32_t binding, uint64_t unit, uint64_t limit,
                        const char* unitName)
{
    if (bytes[binding] / unit <= limit) return {};
    return fmt::format("array '{}' has {} {}, the device allows {}", sceneArrayName(binding),
                       bytes[binding] / unit, unitName, limit);
}

/// Empty, or the first array that is too large for its binding.
std::string whyTooLarge(const PhysicalDevice& device, const SceneBytes& bytes, bool texel)
{
    const VkPhysicalDeviceLimits& limits = device.properties.limits;
    std::string why;
    for (uint32_t i = 0; i < SCENE_BUFFER_COUNT && why.empty(); i++)
        why = texel || i == BINDING_INSTANCES
                  ? whyTooLarge(bytes, i, TEXEL_BYTES, limits.maxTexelBufferElements, "texels")
                  : whyTooLarge(bytes, i, 1, limits.maxStorageBufferRange, "bytes");
    return why;
}

}  // namespace

const char* sceneArrayName(uint32_t binding)
{
    constexpr const char* NAMES[SCENE_BUFFER_COUNT] = {"nodes",  "primitives", "corners",  "materials",
                                                       "tables", "probe",      "instances"};
    return NAMES[binding];
}

std::string whyUnusable(const PhysicalDevice& device)
{
    if (!device.unusable.empty()) return device.unusable;
    const VkPhysicalDeviceLimits& limits = device.properties.limits;
    std::string noTexels = whyNoTexelBuffers(device);
    std::string noStorage = whyNoStorageBuffers(device);
    if (limits.maxPerStageDescriptorStorageBuffers < TILE_STORAGE_BUFFERS) return noStorage;
    if (!noTexels.empty() && !noStorage.empty())
        return fmt::format("it has {}, and {}", noTexels, noStorage);
    if (limits.maxPushConstantsSize < sizeof(AdaptiveDispatch))
        return fmt::format("it has {} bytes of push constants, needs {}",
                           limits.maxPushConstantsSize, sizeof(AdaptiveDispatch));
    if (limits.maxUniformBufferRange < sizeof(Frame))
        return fmt::format("it has {} bytes of uniform buffer, needs {}",
                           limits.maxUniformBufferRange, sizeof(Frame));
    return {};
}

bool chooseTexelBuffers(const PhysicalDevice& device, const SceneBytes& bytes,
                        const BufferChoice& choice)
{
    const DeviceOptions::Buffers wanted = choice.wanted;
    std::string noTexels = whyNoTexelBuffers(device);
    if (noTexels.empty()) noTexels = whyTooLarge(device, bytes, true);
    std::string noStorage = whyNoStorageBuffers(device);
    if (noStorage.empty()) noStorage = whyTooLarge(device, bytes, false);

    const bool texelsFit = wanted != DeviceOptions::Buffers::storage && noTexels.empty();
    const bool storageFits = wanted != DeviceOptions::Buffers::texel && noStorage.empty();
    if (texelsFit && (choice.preferTexels || !storageFits)) return true;
    if (storageFits) return false;
    std::string why = fmt::format("texel buffers: {}; storage buffers: {}", noTexels, noStorage);
    if (wanted == DeviceOptions::Buffers::texel) why = "texel buffers: " + noTexels;
    if (wanted == DeviceOptions::Buffers::storage) why = "storage buffers: " + noStorage;
    throw Error(ErrorKind::noDevice,
                fmt::format("the scene does not fit '{}' ({}); try another device or --device cpu",
                            device.name, why));
}

std::array<uint32_t, 2> chooseGroupShape(const PhysicalDevice& device, uint32_t width,
                                         uint32_t height)
{
    const VkPhysicalDeviceLimits& limits = device.properties.limits;
    width = std::clamp(width, 1u, limits.maxComputeWorkGroupSize[0]);
    height = std::clamp(height, 1u, limits.maxComputeWorkGroupSize[1]);
    while (uint64_t{width} * height > limits.maxComputeWorkGroupInvocations)
        (width >= height ? width : height) /= 2;
    return {width, height};
}

uint32_t chooseStackSize(uint32_t treeDepth)
{
    for (uint32_t size : {8u, 12u, 16u, 24u, 32u, 48u, MAX_STACK_SIZE})
        if (size >= treeDepth) return size;
    throw badInput(
        "the scene's tree is {} levels deep, at most {} can be traversed; build it again",
        treeDepth, MAX_STACK_SIZE);
}

uint32_t defaultStepBudget(const PhysicalDevice& device)
{
    // Mesa 22.3's lavapipe ends all loops of a SIMD group of 8 invocations after 65,535 iterations
    // together. 4000 steps each stay well below, with room for the loops inside a step.
    return device.kind == "software" ? 4000 : 1u << 16;
}

uint64_t bufferShare(const PhysicalDevice& device, uint64_t bytesEach, uint64_t most)
{
    return std::clamp<uint64_t>(mainHeapBytes(device) / 16 / bytesEach, 1u << 16, most);
}

uint32_t tilePixelLimit(const PhysicalDevice& device, const std::array<uint32_t, 2>& group)
{
    // Enough invocations to fill the device several times, lest few long paths at the end leave it idle; small enough
    // on software to answer Ctrl-C soon.
    uint64_t wanted = device.kind == "software" ? 1u << 16 : bufferShare(device, sizeof(SuspendedPath), 1u << 20);
    const VkPhysicalDeviceLimits& limits = device.properties.limits;
    uint64_t range = std::min<uint64_t>(limits.maxStorageBufferRange, device.maxAllocationBytes);
    uint64_t invocations = uint64_t{limits.maxComputeWorkGroupCount[0]} * group[0] * group[1];
    return static_cast<uint32_t>(std::min({wanted, range / sizeof(SuspendedPath), invocations}));
}

uint64_t adaptivePixelLimit(const PhysicalDevice& device)
{
    uint64_t range = std::min<uint64_t>(device.properties.limits.maxStorageBufferRange, device.maxAllocationBytes);
    uint64_t memory = mainHeapBytes(device) / 2 / (sizeof(AdaptivePixel) + sizeof(PixelEstimate));
    return std::min(memory, range / sizeof(PixelEstimate));
}

}  // namespace sahl
