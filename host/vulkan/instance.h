// The Vulkan loader, an instance on it, and the Khronos validation layer where asked for.
#pragma once

#include "vulkan/check.h"

#include <memory>

namespace sahl {

/// A Vulkan 1.1 instance; closed with the last owner.
struct Instance {
    VkInstance handle = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;  ///< null without validation
    bool validation = false;

    Instance() = default;
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;
    ~Instance();
};

/// Loads libvulkan and opens an instance. `validation` (or SAHL_VALIDATION=1 in the environment)
/// turns on VK_LAYER_KHRONOS_validation with synchronization checks; its warnings and errors go to
/// stderr and are counted. An instance that is still open with the same setting is shared.
/// Throws noDevice when there is no loader, no driver or no validation layer.
std::shared_ptr<Instance> openInstance(bool validation);

/// Warnings and errors of the validation layer so far in this process.
uint64_t vulkanMessageCount();

}  // namespace sahl
