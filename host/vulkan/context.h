// A device opened for compute: one queue, and commands that run on it.
#pragma once

#include "vulkan/physical_device.h"

#include <functional>

namespace sahl {

/// A command buffer, with the pool that it is of and the fence that its end is known by.
struct CommandSlot {
    VkCommandPool pool = VK_NULL_HANDLE;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    VkFence fence = VK_NULL_HANDLE;
};

/// Everything made from a context (buffers, pipelines) must be gone before it.
struct Context {
    std::shared_ptr<Instance> instance;
    PhysicalDevice physical;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;
    CommandSlot slot;            ///< of runCommands()
    double timeoutSeconds = 0;   ///< that one submission may take
    bool notResponding = false;  ///< a submission never ended: nothing is destroyed any more
    uint64_t heapBytesInUse[VK_MAX_MEMORY_HEAPS] = {};  ///< allocated by this context

    Context() = default;
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;
    ~Context();
};

/// Opens one of physicalDevices(*instance). Throws noDevice, or deviceLost when memory is short.
std::unique_ptr<Context> openContext(std::shared_ptr<Instance> instance,
                                     const PhysicalDevice& physical);

/// Records commands by `record`, submits them and waits until they are done. Throws deviceLost when
/// the device is lost or does not answer within context.timeoutSeconds. `what` names the work.
void runCommands(Context& context, const std::string& what,
                 const std::function<void(VkCommandBuffer)>& record);

/// Commands that run while the host does something else. What is submitted later runs later, but only a barrier makes it
/// wait.
class Submission {
public:
    explicit Submission(Context& context);
    Submission(const Submission&) = delete;
    Submission& operator=(const Submission&) = delete;
    ~Submission();  ///< waits

    /// Records commands by `record` and submits them; none are under way. Throws as runCommands() does.
    void begin(const std::string& what, const std::function<void(VkCommandBuffer)>& record);

    /// Until the commands are done, if any are under way. Throws as runCommands() does.
    void wait();

private:
    Context& context_;
    CommandSlot slot_;
    std::string what_;  // is under way; empty: nothing
};

/// Who reads or writes on one side of a barrier.
struct Access {
    VkPipelineStageFlags stage;
    VkAccessFlags access;
};
constexpr Access COMPUTE_WRITE = {VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT};
constexpr Access COMPUTE_USE = {VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                                VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT};
/// The same, and workgroups counted by the device (recordIndirectDispatch).
constexpr Access COMPUTE_USE_AND_COUNT = {
    VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT,
    VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_INDIRECT_COMMAND_READ_BIT};
constexpr Access TRANSFER_READ = {VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_READ_BIT};
constexpr Access TRANSFER_WRITE = {VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT};
constexpr Access HOST_READ = {VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT};

/// What came `before` is finished and visible to what comes `after`, for all memory.
void recordBarrier(VkCommandBuffer commands, Access before, Access after);

}  // namespace sahl
