#include "vulkan/context.h"

namespace sahl {

namespace {

// Software drivers on busy machines are slow without being stuck; a real GPU's own watchdog acts
// within seconds. What is submitted at a time is meant to take well under a second on either.
constexpr double SOFTWARE_TIMEOUT_SECONDS = 120;
constexpr double HARDWARE_TIMEOUT_SECONDS = 30;

void createDevice(Context& context)
{
    const PhysicalDevice& physical = context.physical;
    float priority = 1.0f;
    auto queue = vulkanStruct<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
    queue.queueFamilyIndex = physical.queueFamily;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    const char* subset = "VK_KHR_portability_subset";
    auto info = vulkanStruct<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.enabledExtensionCount = physical.portabilitySubset ? 1 : 0;
    info.ppEnabledExtensionNames = &subset;
    VkDevice device = VK_NULL_HANDLE;
    check(vkCreateDevice(physical.handle, &info, nullptr, &device), "open device '{}'",
          physical.name);
    context.device = device;
    vkGetDeviceQueue(device, physical.queueFamily, 0, &context.queue);
}

void createCommandSlot(const Context& context, CommandSlot& slot)
{
    const std::string& name = context.physical.name;
    auto pool = vulkanStruct<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
    pool.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
    pool.queueFamilyIndex = context.physical.queueFamily;
    check(vkCreateCommandPool(context.device, &pool, nullptr, &slot.pool), "create command pool on '{}'", name);
    auto commands =
        vulkanStruct<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
    commands.commandPool = slot.pool;
    commands.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    commands.commandBufferCount = 1;
    check(vkAllocateCommandBuffers(context.device, &commands, &slot.commands), "allocate command buffer on '{}'", name);
    auto fence = vulkanStruct<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
    check(vkCreateFence(context.device, &fence, nullptr, &slot.fence), "create fence on '{}'", name);
}

void destroyCommandSlot(VkDevice device, const CommandSlot& slot)
{
    vkDestroyFence(device, slot.fence, nullptr);
    vkDestroyCommandPool(device, slot.pool, nullptr);
}

void submitCommands(Context& context, const CommandSlot& slot, const std::string& what,
                    const std::function<void(VkCommandBuffer)>& record)
{
    const std::string& name = context.physical.name;
    check(vkResetCommandPool(context.device, slot.pool, 0), "{}: reset commands of '{}'", what, name);
    auto begin =
        vulkanStruct<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vkBeginCommandBuffer(slot.commands, &begin), "{}: begin commands for '{}'", what, name);
    record(slot.commands);
    check(vkEndCommandBuffer(slot.commands), "{}: end commands for '{}'", what, name);

    check(vkResetFences(context.device, 1, &slot.fence), "{}: reset fence of '{}'", what, name);
    auto submit = vulkanStruct<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &slot.commands;
    check(vkQueueSubmit(context.queue, 1, &submit, slot.fence), "{}: submit to '{}'", what, name);
}

void waitForFence(Context& context, const CommandSlot& slot, const std::string& what)
{
    auto nanoseconds = static_cast<uint64_t>(context.timeoutSeconds * 1e9);
    VkResult result = vkWaitForFences(context.device, 1, &slot.fence, VK_TRUE, nanoseconds);
    if (result == VK_TIMEOUT) {
        context.notResponding = true;
        throw Error(ErrorKind::deviceLost,
                    fmt::format("{}: '{}' is not responding: nothing came back within {:g} s; try "
                                "again, smaller, or --device cpu",
                                what, context.physical.name, context.timeoutSeconds));
    }
    check(result, "{}: wait for '{}'", what, context.physical.name);
}

}  // namespace

Context::~Context()
{
    if (notResponding) {
        // The device still works on our objects and Vulkan cannot cancel that: destroying them
        // would crash and waiting might never end. They are left for the end of the process.
        new std::shared_ptr<Instance>(std::move(instance));
        return;
    }
    if (device == VK_NULL_HANDLE) return;
    destroyCommandSlot(device, slot);
    vkDestroyDevice(device, nullptr);
}

bool isAbandoned(const Context& context)
{
    return context.notResponding;
}
VkDevice deviceHandle(const Context& context)
{
    return context.device;
}

std::unique_ptr<Context> openContext(std::shared_ptr<Instance> instance,
                                     const PhysicalDevice& physical)
{
    auto context = std::make_unique<Context>();
    context->instance = std::move(instance);
    context->physical = physical;
    context->timeoutSeconds =
        physical.kind == "software" ? SOFTWARE_TIMEOUT_SECONDS : HARDWARE_TIMEOUT_SECONDS;
    createDevice(*context);
    createCommandSlot(*context, context->slot);
    return context;
}

void runCommands(Context& context, const std::string& what,
                 const std::function<void(VkCommandBuffer)>& record)
{
    submitCommands(context, context.slot, what, record);
    waitForFence(context, context.slot, what);
}

Submission::Submission(Context& context) : context_(context)
{
    try {
        createCommandSlot(context, slot_);
    } catch (...) {
        destroyCommandSlot(context.device, slot_);
        throw;
    }
}

Submission::~Submission()
{
    if (isAbandoned(context_)) return;
    try {
        wait();
    } catch (const Error&) {
        // A device that is lost runs nothing any more; one that does not respond is abandoned.
    }
    if (!isAbandoned(context_)) destroyCommandSlot(context_.device, slot_);
}

void Submission::begin(const std::string& what, const std::function<void(VkCommandBuffer)>& record)
{
    submitCommands(context_, slot_, what, record);
    what_ = what;
}

void Submission::wait()
{
    if (what_.empty()) return;
    const std::string what = std::exchange(what_, {});
    waitForFence(context_, slot_, what);
}

void recordBarrier(VkCommandBuffer commands, Access before, Access after)
{
    auto barrier = vulkanStruct<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
    barrier.srcAccessMask = before.access;
    barrier.dstAccessMask = after.access;
    vkCmdPipelineBarrier(commands, before.stage, after.stage, 0, 1, &barrier, 0, nullptr, 0,
                         nullptr);
}

}  // namespace sahl
