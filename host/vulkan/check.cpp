#include "vulkan/check.h"

namespace sahl {

namespace {

struct ResultText {
    VkResult result;
    const char* name;
    const char* meaning;
};

// Those that Vulkan 1.1 compute can give; others are shown by number.
constexpr ResultText RESULTS[] = {
    {VK_TIMEOUT, "VK_TIMEOUT", "a wait ran out of time"},
    {VK_NOT_READY, "VK_NOT_READY", "not finished yet"},
    {VK_INCOMPLETE, "VK_INCOMPLETE", "the answer did not fit"},
    {VK_ERROR_OUT_OF_HOST_MEMORY, "VK_ERROR_OUT_OF_HOST_MEMORY", "out of host memory"},
    {VK_ERROR_OUT_OF_DEVICE_MEMORY, "VK_ERROR_OUT_OF_DEVICE_MEMORY", "out of device memory"},
    {VK_ERROR_OUT_OF_POOL_MEMORY, "VK_ERROR_OUT_OF_POOL_MEMORY", "out of pool memory"},
    {VK_ERROR_FRAGMENTED_POOL, "VK_ERROR_FRAGMENTED_POOL", "the pool is fragmented"},
    {VK_ERROR_FRAGMENTATION, "VK_ERROR_FRAGMENTATION", "memory is fragmented"},
    {VK_ERROR_MEMORY_MAP_FAILED, "VK_ERROR_MEMORY_MAP_FAILED", "memory cannot be mapped"},
    {VK_ERROR_TOO_MANY_OBJECTS, "VK_ERROR_TOO_MANY_OBJECTS", "too many objects"},
    {VK_ERROR_DEVICE_LOST, "VK_ERROR_DEVICE_LOST", "the device was lost"},
    {VK_ERROR_INITIALIZATION_FAILED, "VK_ERROR_INITIALIZATION_FAILED", "the driver failed"},
    {VK_ERROR_INCOMPATIBLE_DRIVER, "VK_ERROR_INCOMPATIBLE_DRIVER", "no usable driver"},
    {VK_ERROR_LAYER_NOT_PRESENT, "VK_ERROR_LAYER_NOT_PRESENT", "a layer is missing"},
    {VK_ERROR_EXTENSION_NOT_PRESENT, "VK_ERROR_EXTENSION_NOT_PRESENT", "an extension is missing"},
    {VK_ERROR_FEATURE_NOT_PRESENT, "VK_ERROR_FEATURE_NOT_PRESENT", "a feature is missing"},
    {VK_ERROR_FORMAT_NOT_SUPPORTED, "VK_ERROR_FORMAT_NOT_SUPPORTED", "format not supported"},
    {VK_ERROR_INVALID_SHADER_NV, "VK_ERROR_INVALID_SHADER_NV", "the shader was refused"},
    {VK_ERROR_UNKNOWN, "VK_ERROR_UNKNOWN", "the driver does not say why"},
};

const ResultText* findResult(VkResult result)
{
    for (const ResultText& entry : RESULTS)
        if (entry.result == result) return &entry;
    return nullptr;
}

bool isMemoryShortage(VkResult result)
{
    return result == VK_ERROR_OUT_OF_HOST_MEMORY || result == VK_ERROR_OUT_OF_DEVICE_MEMORY ||
           result == VK_ERROR_OUT_OF_POOL_MEMORY || result == VK_ERROR_FRAGMENTED_POOL ||
           result == VK_ERROR_FRAGMENTATION || result == VK_ERROR_MEMORY_MAP_FAILED ||
           result == VK_ERROR_TOO_MANY_OBJECTS;
}

}  // namespace

std::string resultName(VkResult result)
{
    const ResultText* known = findResult(result);
    return known ? known->name : fmt::format("VkResult {}", static_cast<int>(result));
}

void throwVulkanError(VkResult result, const std::string& what)
{
    const ResultText* known = findResult(result);
    std::string text = known ? fmt::format("{}: {} ({})", what, known->meaning, known->name)
                             : fmt::format("{}: {}", what, resultName(result));
    if (result == VK_ERROR_DEVICE_LOST) {
        text +=
            "; the driver gave up on the device, its log may say why; try again, or --device cpu";
        throw Error(ErrorKind::deviceLost, text);
    }
    if (isMemoryShortage(result)) {
        text += "; close other programs that use the device, or try --device cpu";
        throw Error(ErrorKind::deviceLost, text);
    }
    throw Error(ErrorKind::noDevice, text);
}

std::string bytesText(uint64_t bytes)
{
    constexpr uint64_t MIB = uint64_t{1} << 20;
    constexpr uint64_t GIB = uint64_t{1} << 30;
    if (bytes < MIB) return fmt::format("{} bytes", bytes);
    if (bytes < GIB)
        return fmt::format("{:.1f} MiB", static_cast<double>(bytes) / static_cast<double>(MIB));
    return fmt::format("{:.1f} GiB", static_cast<double>(bytes) / static_cast<double>(GIB));
}

}  // namespace sahl
