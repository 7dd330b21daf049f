// The Vulkan devices of this machine, as users see them.
#include "device/device.h"
#include "device/vulkan_limits.h"
#include "util/error.h"

namespace sahl {

namespace {

VulkanDeviceInfo describe(const PhysicalDevice& device)
{
    const VkPhysicalDeviceLimits& limits = device.properties.limits;
    uint32_t version = device.properties.apiVersion;
    VulkanDeviceInfo info;
    info.index = device.index;
    info.name = device.name;
    info.driver = device.driver;
    info.kind = device.kind;
    info.uuid = device.uuid;
    info.apiVersion = fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version),
                                  VK_API_VERSION_MINOR(version), VK_API_VERSION_PATCH(version));
    info.deviceMemory = mainHeapBytes(device);
    info.maxStorageBufferBytes = limits.maxStorageBufferRange;
    info.maxTexelBufferElements = limits.maxTexelBufferElements;
    info.subgroupSize = device.subgroupSize;
    info.maxGroupInvocations = limits.maxComputeWorkGroupInvocations;
    info.unusable = whyUnusable(device);
    return info;
}

}  // namespace

std::vector<VulkanDeviceInfo> listVulkanDevices(std::string& whyNone)
{
    std::vector<VulkanDeviceInfo> infos;
    whyNone.clear();
    try {
        std::shared_ptr<Instance> instance = openInstance(false);
        for (const PhysicalDevice& device : physicalDevices(*instance))
            infos.push_back(describe(device));
        if (infos.empty())
            whyNone = "no Vulkan device found: drivers are installed, and none of them finds its "
                      "hardware; install a software one (Debian: mesa-vulkan-drivers) or use "
                      "--device cpu";
    } catch (const Error& error) {
        if (error.kind != ErrorKind::noDevice) throw;
        whyNone = error.what();
    }
    return infos;
}

}  // namespace sahl
