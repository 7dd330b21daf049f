#include "vulkan/physical_device.h"

#include <algorithm>
#include <cstring>

namespace sahl {

namespace {

std::string versionText(uint32_t version)
{
    return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version),
                       VK_API_VERSION_PATCH(version));
}

std::string kindText(VkPhysicalDeviceType type)
{
    switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
        return "discrete";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
        return "integrated";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
        return "virtual";
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
        return "software";
    default:
        return "other";
    }
}

std::string uuidText(const uint8_t (&bytes)[VK_UUID_SIZE])
{
    std::string text;
    for (uint32_t i = 0; i < VK_UUID_SIZE; i++) {
        if (i == 4 || i == 6 || i == 8 || i == 10) text += '-';
        text += fmt::format("{:02x}", bytes[i]);
    }
    return text;
}

bool hasExtension(const std::vector<VkExtensionProperties>& extensions, const char* name)
{
    return std::any_of(extensions.begin(), extensions.end(), [&](const VkExtensionProperties& e) {
        return std::strcmp(e.extensionName, name) == 0;
    });
}

void queryProperties(PhysicalDevice& device, bool driverProperties)
{
    auto driver = vulkanStruct<VkPhysicalDeviceDriverProperties>(
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES);
    auto subgroup = vulkanStruct<VkPhysicalDeviceSubgroupProperties>(
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES);
    auto allocation = vulkanStruct<VkPhysicalDeviceMaintenance3Properties>(
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES);
    auto id =
        vulkanStruct<VkPhysicalDeviceIDProperties>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ID_PROPERTIES);
    auto all =
        vulkanStruct<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2);
    all.pNext = &id;
    id.pNext = &allocation;
    allocation.pNext = &subgroup;
    if (driverProperties) subgroup.pNext = &driver;
    vkGetPhysicalDeviceProperties2(device.handle, &all);

    device.properties = all.properties;
    device.uuid = uuidText(id.deviceUUID);
    device.maxAllocationBytes = allocation.maxMemoryAllocationSize;
    device.subgroupSize = subgroup.subgroupSize;
    constexpr VkSubgroupFeatureFlags BALLOTS = VK_SUBGROUP_FEATURE_BASIC_BIT | VK_SUBGROUP_FEATURE_BALLOT_BIT;
    device.subgroupBallots = (subgroup.supportedOperations & BALLOTS) == BALLOTS &&
                             (subgroup.supportedStages & VK_SHADER_STAGE_COMPUTE_BIT) != 0;
    if (driverProperties) {
        device.driverId = driver.driverID;
        if (driver.driverInfo[0] != '\0')
            device.driver = fmt::format("{} {}", driver.driverName, driver.driverInfo);
        else
            device.driver = fmt::format("{} {}", driver.driverName, device.driver);
    }
}

// Prefers a family without graphics: on real GPUs its work does not compete with the screen's.
bool findQueueFamily(PhysicalDevice& device)
{
    uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device.handle, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(device.handle, &count, families.data());
    bool found = false;
    for (uint32_t i = 0; i < count; i++) {
        VkQueueFlags flags = families[i].queueFlags;
        if (families[i].queueCount == 0 || !(flags & VK_QUEUE_COMPUTE_BIT)) continue;
        bool dedicated = !(flags & VK_QUEUE_GRAPHICS_BIT);
        if (!found || dedicated) device.queueFamily = i;
        found = true;
        if (dedicated) break;
    }
    return found;
}

PhysicalDevice describe(VkPhysicalDevice handle, uint32_t index)
{
    PhysicalDevice device;
    device.handle = handle;
    device.index = index;
    vkGetPhysicalDeviceProperties(handle, &device.properties);
    vkGetPhysicalDeviceMemoryProperties(handle, &device.memory);
    device.name = device.properties.deviceName;
    device.kind = kindText(device.properties.deviceType);
    uint32_t version = device.properties.apiVersion;
    device.driver = "version " + versionText(device.properties.driverVersion);
    if (version < VK_API_VERSION_1_1) {
        device.unusable =
            fmt::format("its driver has Vulkan {}, 1.1 is needed", versionText(version));
        return device;
    }

    auto extensions = enumerate<VkExtensionProperties>(
        "list device extensions", [&](uint32_t* count, VkExtensionProperties* items) {
            return vkEnumerateDeviceExtensionProperties(handle, nullptr, count, items);
        });
    device.portabilitySubset = hasExtension(extensions, "VK_KHR_portability_subset");
    queryProperties(device, version >= VK_API_VERSION_1_2 ||
                                hasExtension(extensions, VK_KHR_DRIVER_PROPERTIES_EXTENSION_NAME));
    VkFormatProperties format = {};
    vkGetPhysicalDeviceFormatProperties(handle, VK_FORMAT_R32G32B32A32_UINT, &format);
    device.rgba32uiTexelBuffers =
        (format.bufferFeatures & VK_FORMAT_FEATURE_UNIFORM_TEXEL_BUFFER_BIT) != 0;
    device.rgba32uiImageBuffers = (format.bufferFeatures & VK_FORMAT_FEATURE_STORAGE_TEXEL_BUFFER_BIT) != 0;
    if (!findQueueFamily(device)) device.unusable = "it has no queue for compute";
    return device;
}

}  // namespace

std::vector<PhysicalDevice> physicalDevices(const Instance& instance)
{
    // Loaders answer so when drivers are installed and none of them finds hardware.
    uint32_t count = 0;
    VkResult result = vkEnumeratePhysicalDevices(instance.handle, &count, nullptr);
    if (result == VK_ERROR_INITIALIZATION_FAILED) return {};
    check(result, "count Vulkan devices");
    auto handles = enumerate<VkPhysicalDevice>(
        "list Vulkan devices", [&](uint32_t* size, VkPhysicalDevice* items) {
            return vkEnumeratePhysicalDevices(instance.handle, size, items);
        });
    std::vector<PhysicalDevice> devices;
    for (uint32_t i = 0; i < handles.size(); i++) devices.push_back(describe(handles[i], i));
    return devices;
}

uint32_t mainHeap(const PhysicalDevice& device)
{
    uint32_t best = 0;
    uint64_t bestBytes = 0;
    for (uint32_t i = 0; i < device.memory.memoryHeapCount; i++) {
        const VkMemoryHeap& heap = device.memory.memoryHeaps[i];
        if (!(heap.flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) || heap.size <= bestBytes) continue;
        best = i;
        bestBytes = heap.size;
    }
    return best;
}

uint64_t mainHeapBytes(const PhysicalDevice& device)
{
    return device.memory.memoryHeapCount == 0 ? 0
                                              : device.memory.memoryHeaps[mainHeap(device)].size;
}

}  // namespace sahl
