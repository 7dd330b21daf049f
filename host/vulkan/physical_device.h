// What the machine's Vulkan devices are and can do.
#pragma once

#include "vulkan/instance.h"

#include <string>
#include <vector>

namespace sahl {

/// One device as its driver describes it.
struct PhysicalDevice {
    VkPhysicalDevice handle = VK_NULL_HANDLE;
    uint32_t index = 0;                          ///< in the loader's order
    VkPhysicalDeviceProperties properties = {};  ///< with the limits
    VkPhysicalDeviceMemoryProperties memory = {};
    VkDriverId driverId = {};  ///< 0 when the driver does not tell
    std::string name, driver;
    std::string kind;                 ///< discrete, integrated, virtual, software, other
    std::string uuid;                 ///< 8-4-4-4-12 hexadecimal digits
    uint64_t maxAllocationBytes = 0;  ///< of one vkAllocateMemory
    uint32_t subgroupSize = 0;
    bool subgroupBallots = false;       ///< in compute shaders
    uint32_t queueFamily = 0;           ///< with compute; used for everything
    bool rgba32uiTexelBuffers = false;  ///< R32G32B32A32_UINT as uniform texel buffer
    bool rgba32uiImageBuffers = false;  ///< the same as storage texel buffer
    bool portabilitySubset = false;     ///< the subset extension must be enabled
    std::string unusable;               ///< empty, or why nothing can be computed on it
};

/// All devices of an instance, in the loader's order; may be empty. Throws noDevice.
std::vector<PhysicalDevice> physicalDevices(const Instance& instance);

/// Index of the largest device-local heap.
uint32_t mainHeap(const PhysicalDevice& device);

/// Bytes of the largest device-local heap.
uint64_t mainHeapBytes(const PhysicalDevice& device);

}  // namespace sahl
