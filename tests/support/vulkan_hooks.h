// Stands between Sahl and the Vulkan loader: lets calls fail, and lets a driver look like another.
#pragma once

#include "vulkan/check.h"

#include <functional>
#include <optional>
#include <string>

namespace sahl::testing {

/// While one of these lives, instances opened by Sahl go through it. One at a time.
class VulkanHooks {
public:
    VulkanHooks();
    ~VulkanHooks();
    VulkanHooks(const VulkanHooks&) = delete;
    VulkanHooks& operator=(const VulkanHooks&) = delete;

    /// Asked before every call that can fail; a result other than nothing is given back in place of
    /// making the call.
    std::function<std::optional<VkResult>(const std::string& name)> onCall;

    /// Change what the device says of itself.
    std::function<void(VkPhysicalDeviceProperties&)> changeProperties;
    std::function<void(VkPhysicalDeviceMemoryProperties&)> changeMemory;

    /// The device looks like a graphics card: its own memory, which the host does not see, and two
    /// kinds of host memory. Mapping the former fails the test.
    bool discreteMemory = false;

    /// Compute shaders have no ballots of subgroups.
    bool noSubgroupBallots = false;

    /// vkCmdDispatch and vkCmdDispatchIndirect do nothing.
    bool dropDispatches = false;

    /// Workgroups of all calls of vkCmdDispatch.
    uint64_t groupsDispatched = 0;
};

/// The k-th call from now on, counted from 0, gives `result`. `reached` says whether it came to
/// that.
struct FailAt {
    uint64_t countdown;
    VkResult result;
    std::string name;  ///< of the call that failed; empty while none did

    std::optional<VkResult> operator()(const std::string& call);
    bool reached() const { return !name.empty(); }
};

}  // namespace sahl::testing
