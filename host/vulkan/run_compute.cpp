#include "vulkan/run_compute.h"

namespace sahl {

void runCompute(Context& context, std::span<const uint32_t> spirv,
                const std::vector<std::span<std::byte>>& arrays,
                const ComputeParameters& parameters)
{
    PipelineRequest request;
    request.name = parameters.name;
    request.spirv = spirv;
    request.bindings.assign(arrays.size(), VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
    request.pushConstantBytes = static_cast<uint32_t>(parameters.pushConstants.size());
    request.specialisation = parameters.specialisation;
    ComputePipeline pipeline = createComputePipeline(context, request);

    std::vector<Buffer> buffers;
    for (size_t i = 0; i < arrays.size(); i++) {
        buffers.push_back(
            createBuffer(context, {fmt::format("{}[{}]", parameters.name, i), arrays[i].size(),
                                   VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, HostUse::readBack}));
        writeBuffer(context, buffers.back(), arrays[i]);
    }
    std::vector<const Buffer*> bound;
    for (const Buffer& buffer : buffers) bound.push_back(&buffer);
    bindBuffers(context, pipeline, bound);
    runCommands(context, fmt::format("run '{}'", parameters.name), [&](VkCommandBuffer commands) {
        recordDispatch(commands, pipeline, parameters.pushConstants, parameters.groups);
        for (const Buffer& buffer : buffers) recordReadBack(commands, buffer, buffer.bytes);
    });
    for (size_t i = 0; i < arrays.size(); i++) readBuffer(buffers[i], arrays[i]);
}

}  // namespace sahl
