// A compute shader with its layout and its one descriptor set.
#pragma once

#include "vulkan/buffer.h"

#include <array>

namespace sahl {

struct PipelineRequest {
    std::string name;                        ///< for messages
    std::span<const uint32_t> spirv;         ///< entry point "main"
    std::vector<VkDescriptorType> bindings;  ///< of set 0, from binding 0 on
    uint32_t pushConstantBytes = 0;
    std::vector<uint32_t> specialisation;  ///< constants with ids 0, 1, 2, ...
};

struct ComputePipeline {
    std::string name;
    std::vector<VkDescriptorType> bindings;
    Owned<VkDescriptorSetLayout> setLayout;
    Owned<VkPipelineLayout> layout;
    Owned<VkPipeline> handle;
    Owned<VkDescriptorPool> pool;
    VkDescriptorSet set = VK_NULL_HANDLE;
};

/// Throws noDevice when the driver refuses the shader, deviceLost when memory is short.
ComputePipeline createComputePipeline(Context& context, const PipelineRequest& request);

/// Puts buffers[i], whole, at binding i. No commands that use the pipeline may be running.
void bindBuffers(Context& context, ComputePipeline& pipeline,
                 std::span<const Buffer* const> buffers);

/// Records one dispatch of `groups` workgroups; `pushConstants` has the size of the request.
void recordDispatch(VkCommandBuffer commands, const ComputePipeline& pipeline,
                    std::span<const std::byte> pushConstants,
                    const std::array<uint32_t, 3>& groups);

/// The same, for as many workgroups as three words of the buffer `groups` say when it is their turn. Of that buffer's
/// usage is VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT.
///   offset  of the words [bytes]
void recordIndirectDispatch(VkCommandBuffer commands, const ComputePipeline& pipeline,
                            std::span<const std::byte> pushConstants, const Buffer& groups, uint64_t offset);

}  // namespace sahl
