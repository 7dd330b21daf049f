// Results of Vulkan calls turned into sahl::Error, and handles that destroy themselves.
// host/vulkan knows nothing of path tracing: it is plain structs and free functions over
// Vulkan 1.1.
#pragma once

#include "util/error.h"

#include <volk.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace sahl {

/// Throws the Error that `result` stands for: deviceLost for a lost device and for exhausted
/// memory, noDevice for everything else. `what` says what was tried, on which object.
[[noreturn]] void throwVulkanError(VkResult result, const std::string& what);

/// check(vkCreateFence(...), "create fence of {}", name): throws unless the call succeeded.
/// The text is only formatted on failure.
template <class... Args>
void check(VkResult result, fmt::format_string<Args...> what, Args&&... args)
{
    if (result != VK_SUCCESS)
        throwVulkanError(result, fmt::format(what, std::forward<Args>(args)...));
}

/// "VK_ERROR_DEVICE_LOST" and so on.
std::string resultName(VkResult result);

/// "2.0 GiB", "131072 bytes": exact below 1 MiB, one decimal above.
std::string bytesText(uint64_t bytes);

/// One of Vulkan's structures, all zero but for its type.
template <class T>
T vulkanStruct(VkStructureType type)
{
    T structure = {};
    structure.sType = type;
    return structure;
}

/// All elements of one of Vulkan's two-call enumerations; `list(&count, data)` makes the call.
template <class T, class List>
std::vector<T> enumerate(const char* what, List list)
{
    for (;;) {
        uint32_t count = 0;
        check(list(&count, nullptr), "{}", what);
        std::vector<T> items(count);
        VkResult result = list(&count, items.data());
        if (result == VK_INCOMPLETE) continue;  // the list grew between the two calls
        check(result, "{}", what);
        items.resize(count);
        return items;
    }
}

struct Context;

/// True when the context's work never ended: its objects may still be in use and are left alone.
bool isAbandoned(const Context& context);
VkDevice deviceHandle(const Context& context);

/// A handle of a VkDevice that is destroyed with its owner. The context must outlive it.
template <class T>
class Owned {
public:
    using Destroy = void(VKAPI_PTR*)(VkDevice, T, const VkAllocationCallbacks*);

    Owned() = default;
    Owned(const Context& context, T handle, Destroy destroy)
        : context_(&context), handle_(handle), destroy_(destroy)
    {
    }
    Owned(Owned&& other) noexcept { swap(other); }
    Owned& operator=(Owned&& other) noexcept
    {
        Owned moved(std::move(other));
        swap(moved);
        return *this;
    }
    Owned(const Owned&) = delete;
    Owned& operator=(const Owned&) = delete;
    ~Owned()
    {
        if (handle_ != VK_NULL_HANDLE && !isAbandoned(*context_))
            destroy_(deviceHandle(*context_), handle_, nullptr);
    }

    T get() const { return handle_; }

private:
    void swap(Owned& other)
    {
        std::swap(context_, other.context_);
        std::swap(handle_, other.handle_);
        std::swap(destroy_, other.destroy_);
    }

    const Context* context_ = nullptr;
    T handle_ = VK_NULL_HANDLE;
    Destroy destroy_ = nullptr;
};

}  // namespace sahl
