#include "support/vulkan_hooks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>

namespace sahl::testing {

namespace {

VulkanHooks* active = nullptr;
PFN_vkGetInstanceProcAddr loaderProcAddr = nullptr;

// Allocations of the memory that a graphics card's host would not see.
std::set<VkDeviceMemory> hiddenMemory;

// Of a driver with one heap. Those of real graphics cards have two, and are left as they are.
bool pretendsDiscrete = false;

template <size_t N>
struct Name {
    char text[N];
    constexpr Name(const char (&literal)[N]) { std::copy_n(literal, N, text); }
};

/// A call that can fail, forwarded to the loader's function of that name.
template <Name NAME, class Function>
struct Fallible;

template <Name NAME, class... Args>
struct Fallible<NAME, VkResult(VKAPI_PTR*)(Args...)> {
    static inline VkResult(VKAPI_PTR* original)(Args...) = nullptr;

    static VKAPI_ATTR VkResult VKAPI_CALL call(Args... args)
    {
        std::optional<VkResult> result;
        if (active && active->onCall) result = active->onCall(NAME.text);
        // Work that runs is waited for all the same: Sahl may destroy its objects after an error.
        bool isWait = std::string_view(NAME.text) == "vkWaitForFences";
        if (result && isWait) original(args...);
        return result ? *result : original(args...);
    }
};

struct Replacement {
    PFN_vkVoidFunction function;
    void (*keepOriginal)(PFN_vkVoidFunction);
};

std::map<std::string_view, Replacement>& replacements();

template <Name NAME, class Function>
void addFallible(std::map<std::string_view, Replacement>& table)
{
    using Hook = Fallible<NAME, Function>;
    table[NAME.text] = {
        reinterpret_cast<PFN_vkVoidFunction>(&Hook::call),
        [](PFN_vkVoidFunction f) { Hook::original = reinterpret_cast<Function>(f); }};
}

/// A function that is replaced altogether; `ORIGINAL` is where the loader's own is kept.
template <auto ORIGINAL, class Function>
void addReplacement(std::map<std::string_view, Replacement>& table, std::string_view name,
                    Function function)
{
    table[name] = {reinterpret_cast<PFN_vkVoidFunction>(function),
                   [](PFN_vkVoidFunction f) { *ORIGINAL = reinterpret_cast<Function>(f); }};
}

PFN_vkGetPhysicalDeviceProperties getProperties;
PFN_vkGetPhysicalDeviceProperties2 getProperties2;
PFN_vkGetPhysicalDeviceMemoryProperties getMemoryProperties;
PFN_vkGetBufferMemoryRequirements getRequirements;
PFN_vkAllocateMemory allocateMemory;
PFN_vkFreeMemory freeMemory;
PFN_vkMapMemory mapMemory;
PFN_vkCmdDispatch cmdDispatch;
PFN_vkCmdDispatchIndirect cmdDispatchIndirect;

VKAPI_ATTR void VKAPI_CALL changedProperties(VkPhysicalDevice device,
                                             VkPhysicalDeviceProperties* out)
{
    getProperties(device, out);
    if (active && active->changeProperties) active->changeProperties(*out);
}

VKAPI_ATTR void VKAPI_CALL changedProperties2(VkPhysicalDevice device,
                                              VkPhysicalDeviceProperties2* out)
{
    getProperties2(device, out);
    if (active && active->changeProperties) active->changeProperties(out->properties);
    for (auto* next = static_cast<VkBaseOutStructure*>(out->pNext); next; next = next->pNext) {
        if (active && active->noSubgroupBallots &&
            next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES)
            reinterpret_cast<VkPhysicalDeviceSubgroupProperties*>(next)->supportedOperations &=
                ~VkSubgroupFeatureFlags{VK_SUBGROUP_FEATURE_BALLOT_BIT};
    }
}

VKAPI_ATTR void VKAPI_CALL changedMemory(VkPhysicalDevice device,
                                         VkPhysicalDeviceMemoryProperties* out)
{
    getMemoryProperties(device, out);
    pretendsDiscrete = active && active->discreteMemory && out->memoryHeapCount == 1;
    if (pretendsDiscrete) {
        uint64_t bytes = out->memoryHeaps[0].size;
        *out = {};
        out->memoryHeapCount = 2;
        out->memoryHeaps[0] = {bytes / 2, VK_MEMORY_HEAP_DEVICE_LOCAL_BIT};
        out->memoryHeaps[1] = {bytes, 0};
        VkMemoryPropertyFlags visible =
            VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
        out->memoryTypeCount = 3;
        out->memoryTypes[0] = {VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0};
        out->memoryTypes[1] = {visible, 1};
        out->memoryTypes[2] = {visible | VK_MEMORY_PROPERTY_HOST_CACHED_BIT, 1};
    }
    if (active && active->changeMemory) active->changeMemory(*out);
}

VKAPI_ATTR void VKAPI_CALL changedRequirements(VkDevice device, VkBuffer buffer,
                                               VkMemoryRequirements* out)
{
    getRequirements(device, buffer, out);
    if (pretendsDiscrete) out->memoryTypeBits = 7;
}

VKAPI_ATTR VkResult VKAPI_CALL changedAllocate(VkDevice device, const VkMemoryAllocateInfo* info,
                                               const VkAllocationCallbacks* callbacks,
                                               VkDeviceMemory* memory)
{
    if (active && active->onCall)
        if (std::optional<VkResult> result = active->onCall("vkAllocateMemory")) return *result;
    VkMemoryAllocateInfo real = *info;
    if (pretendsDiscrete) real.memoryTypeIndex = 0;  // all that the driver has
    VkResult result = allocateMemory(device, &real, callbacks, memory);
    if (pretendsDiscrete && info->memoryTypeIndex == 0)
        hiddenMemory.insert(*memory);
    return result;
}

VKAPI_ATTR void VKAPI_CALL changedFree(VkDevice device, VkDeviceMemory memory,
                                       const VkAllocationCallbacks* callbacks)
{
    hiddenMemory.erase(memory);
    freeMemory(device, memory, callbacks);
}

VKAPI_ATTR VkResult VKAPI_CALL changedMap(VkDevice device, VkDeviceMemory memory,
                                          VkDeviceSize offset, VkDeviceSize size,
                                          VkMemoryMapFlags flags, void** address)
{
    EXPECT_FALSE(hiddenMemory.contains(memory)) << "maps memory that the host does not see";
    if (active && active->onCall)
        if (std::optional<VkResult> result = active->onCall("vkMapMemory")) return *result;
    return mapMemory(device, memory, offset, size, flags, address);
}

VKAPI_ATTR void VKAPI_CALL changedDispatch(VkCommandBuffer commands, uint32_t x, uint32_t y,
                                           uint32_t z)
{
    if (active) active->groupsDispatched += uint64_t{x} * y * z;
    if (!active || !active->dropDispatches) cmdDispatch(commands, x, y, z);
}

VKAPI_ATTR void VKAPI_CALL changedDispatchIndirect(VkCommandBuffer commands, VkBuffer buffer,
                                                   VkDeviceSize offset)
{
    if (!active || !active->dropDispatches) cmdDispatchIndirect(commands, buffer, offset);
}

std::map<std::string_view, Replacement>& replacements()
{
    static std::map<std::string_view, Replacement> table = [] {
        std::map<std::string_view, Replacement> t;
        addFallible<"vkEnumeratePhysicalDevices", PFN_vkEnumeratePhysicalDevices>(t);
        addFallible<"vkEnumerateDeviceExtensionProperties",
                    PFN_vkEnumerateDeviceExtensionProperties>(t);
        addFallible<"vkCreateDevice", PFN_vkCreateDevice>(t);
        addFallible<"vkCreateCommandPool", PFN_vkCreateCommandPool>(t);
        addFallible<"vkAllocateCommandBuffers", PFN_vkAllocateCommandBuffers>(t);
        addFallible<"vkCreateFence", PFN_vkCreateFence>(t);
        addFallible<"vkResetCommandPool", PFN_vkResetCommandPool>(t);
        addFallible<"vkBeginCommandBuffer", PFN_vkBeginCommandBuffer>(t);
        addFallible<"vkEndCommandBuffer", PFN_vkEndCommandBuffer>(t);
        addFallible<"vkResetFences", PFN_vkResetFences>(t);
        addFallible<"vkQueueSubmit", PFN_vkQueueSubmit>(t);
        addFallible<"vkWaitForFences", PFN_vkWaitForFences>(t);
        addFallible<"vkCreateBuffer", PFN_vkCreateBuffer>(t);
        addFallible<"vkBindBufferMemory", PFN_vkBindBufferMemory>(t);
        addFallible<"vkCreateBufferView", PFN_vkCreateBufferView>(t);
        addFallible<"vkCreateDescriptorSetLayout", PFN_vkCreateDescriptorSetLayout>(t);
        addFallible<"vkCreatePipelineLayout", PFN_vkCreatePipelineLayout>(t);
        addFallible<"vkCreateShaderModule", PFN_vkCreateShaderModule>(t);
        addFallible<"vkCreateComputePipelines", PFN_vkCreateComputePipelines>(t);
        addFallible<"vkCreateDescriptorPool", PFN_vkCreateDescriptorPool>(t);
        addFallible<"vkAllocateDescriptorSets", PFN_vkAllocateDescriptorSets>(t);
        addReplacement<&getProperties>(t, "vkGetPhysicalDeviceProperties", changedProperties);
        addReplacement<&getProperties2>(t, "vkGetPhysicalDeviceProperties2", changedProperties2);
        addReplacement<&getMemoryProperties>(t, "vkGetPhysicalDeviceMemoryProperties",
                                             changedMemory);
        addReplacement<&getRequirements>(t, "vkGetBufferMemoryRequirements", changedRequirements);
        addReplacement<&allocateMemory>(t, "vkAllocateMemory", changedAllocate);
        addReplacement<&freeMemory>(t, "vkFreeMemory", changedFree);
        addReplacement<&mapMemory>(t, "vkMapMemory", changedMap);
        addReplacement<&cmdDispatch>(t, "vkCmdDispatch", changedDispatch);
        addReplacement<&cmdDispatchIndirect>(t, "vkCmdDispatchIndirect", changedDispatchIndirect);
        return t;
    }();
    return table;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL hookedProcAddr(VkInstance instance, const char* name)
{
    PFN_vkVoidFunction real = loaderProcAddr(instance, name);
    auto found = replacements().find(name);
    if (!real || found == replacements().end()) return real;
    found->second.keepOriginal(real);
    return found->second.function;
}

}  // namespace

VulkanHooks::VulkanHooks()
{
    if (vkGetInstanceProcAddr == nullptr && volkInitialize() != VK_SUCCESS) return;
    active = this;
    loaderProcAddr = vkGetInstanceProcAddr;
    vkGetInstanceProcAddr = hookedProcAddr;
}

VulkanHooks::~VulkanHooks()
{
    if (active != this) return;
    active = nullptr;
    pretendsDiscrete = false;
    vkGetInstanceProcAddr = loaderProcAddr;
}

std::optional<VkResult> FailAt::operator()(const std::string& call)
{
    if (reached() || countdown-- > 0) return {};
    name = call;
    return result;
}

}  // namespace sahl::testing
