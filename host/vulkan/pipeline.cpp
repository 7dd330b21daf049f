#include "vulkan/pipeline.h"

#include <cassert>
#include <map>

namespace sahl {

namespace {

bool isTexelBuffer(VkDescriptorType type)
{
    return type == VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER ||
           type == VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER;
}

void createLayouts(Context& context, const PipelineRequest& request, ComputePipeline& pipeline)
{
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    for (uint32_t i = 0; i < request.bindings.size(); i++)
        bindings.push_back({i, request.bindings[i], 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
    auto set = vulkanStruct<VkDescriptorSetLayoutCreateInfo>(
        VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
    set.bindingCount = static_cast<uint32_t>(bindings.size());
    set.pBindings = bindings.data();
    VkDescriptorSetLayout setLayout = VK_NULL_HANDLE;
    check(vkCreateDescriptorSetLayout(context.device, &set, nullptr, &setLayout),
          "create descriptor set layout of pipeline '{}'", request.name);
    pipeline.setLayout = {context, setLayout, vkDestroyDescriptorSetLayout};

    VkPushConstantRange range = {VK_SHADER_STAGE_COMPUTE_BIT, 0, request.pushConstantBytes};
    auto info =
        vulkanStruct<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
    info.setLayoutCount = 1;
    info.pSetLayouts = &setLayout;
    info.pushConstantRangeCount = request.pushConstantBytes > 0 ? 1 : 0;
    info.pPushConstantRanges = &range;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    check(vkCreatePipelineLayout(context.device, &info, nullptr, &layout),
          "create layout of pipeline '{}'", request.name);
    pipeline.layout = {context, layout, vkDestroyPipelineLayout};
}

Owned<VkShaderModule> createShader(Context& context, const PipelineRequest& request)
{
    auto info = vulkanStruct<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
    info.codeSize = request.spirv.size_bytes();
    info.pCode = request.spirv.data();
    VkShaderModule shader = VK_NULL_HANDLE;
    check(vkCreateShaderModule(context.device, &info, nullptr, &shader),
          "create shader module of pipeline '{}'", request.name);
    return {context, shader, vkDestroyShaderModule};
}

void createPipeline(Context& context, const PipelineRequest& request, ComputePipeline& pipeline)
{
    constexpr uint32_t WORD = sizeof(uint32_t);
    std::vector<VkSpecializationMapEntry> entries;
    for (uint32_t i = 0; i < request.specialisation.size(); i++)
        entries.push_back({i, i * WORD, WORD});
    VkSpecializationInfo specialisation = {};
    specialisation.mapEntryCount = static_cast<uint32_t>(entries.size());
    specialisation.pMapEntries = entries.data();
    specialisation.dataSize = entries.size() * WORD;
    specialisation.pData = request.specialisation.data();

    Owned<VkShaderModule> shader = createShader(context, request);
    auto info =
        vulkanStruct<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = shader.get();
    info.stage.pName = "main";
    info.stage.pSpecializationInfo = entries.empty() ? nullptr : &specialisation;
    info.layout = pipeline.layout.get();
    VkPipeline handle = VK_NULL_HANDLE;
    check(vkCreateComputePipelines(context.device, VK_NULL_HANDLE, 1, &info, nullptr, &handle),
          "create pipeline '{}' on '{}'", request.name, context.physical.name);
    pipeline.handle = {context, handle, vkDestroyPipeline};
}

void createDescriptorSet(Context& context, const PipelineRequest& request,
                         ComputePipeline& pipeline)
{
    std::map<VkDescriptorType, uint32_t> counts;
    for (VkDescriptorType type : request.bindings) counts[type]++;
    std::vector<VkDescriptorPoolSize> sizes;
    for (const auto& [type, count] : counts) sizes.push_back({type, count});
    auto info =
        vulkanStruct<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
    info.maxSets = 1;
    info.poolSizeCount = static_cast<uint32_t>(sizes.size());
    info.pPoolSizes = sizes.data();
    VkDescriptorPool pool = VK_NULL_HANDLE;
    check(vkCreateDescriptorPool(context.device, &info, nullptr, &pool),
          "create descriptor pool of pipeline '{}'", request.name);
    pipeline.pool = {context, pool, vkDestroyDescriptorPool};

    VkDescriptorSetLayout setLayout = pipeline.setLayout.get();
    auto allocate =
        vulkanStruct<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
    allocate.descriptorPool = pool;
    allocate.descriptorSetCount = 1;
    allocate.pSetLayouts = &setLayout;
    check(vkAllocateDescriptorSets(context.device, &allocate, &pipeline.set),
          "allocate descriptor set of pipeline '{}'", request.name);
}

}  // namespace

ComputePipeline createComputePipeline(Context& context, const PipelineRequest& request)
{
    ComputePipeline pipeline;
    pipeline.name = request.name;
    pipeline.bindings = request.bindings;
    createLayouts(context, request, pipeline);
    createPipeline(context, request, pipeline);
    createDescriptorSet(context, request, pipeline);
    return pipeline;
}

void bindBuffers(Context& context, ComputePipeline& pipeline,
                 std::span<const Buffer* const> buffers)
{
    assert(buffers.size() == pipeline.bindings.size());
    std::vector<VkDescriptorBufferInfo> infos(buffers.size());
    std::vector<VkBufferView> views(buffers.size());
    std::vector<VkWriteDescriptorSet> writes(buffers.size());
    for (uint32_t i = 0; i < buffers.size(); i++) {
        infos[i] = {buffers[i]->handle.get(), 0, VK_WHOLE_SIZE};
        views[i] = buffers[i]->texels.get();
        writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        writes[i].dstSet = pipeline.set;
        writes[i].dstBinding = i;
        writes[i].descriptorCount = 1;
        writes[i].descriptorType = pipeline.bindings[i];
        if (isTexelBuffer(pipeline.bindings[i]))
            writes[i].pTexelBufferView = &views[i];
        else
            writes[i].pBufferInfo = &infos[i];
    }
    vkUpdateDescriptorSets(context.device, static_cast<uint32_t>(writes.size()), writes.data(), 0,
                           nullptr);
}

namespace {

void recordState(VkCommandBuffer commands, const ComputePipeline& pipeline,
                 std::span<const std::byte> pushConstants)
{
    VkPipelineLayout layout = pipeline.layout.get();
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.handle.get());
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &pipeline.set,
                            0, nullptr);
    if (!pushConstants.empty())
        vkCmdPushConstants(commands, layout, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                           static_cast<uint32_t>(pushConstants.size()), pushConstants.data());
}

}  // namespace

void recordDispatch(VkCommandBuffer commands, const ComputePipeline& pipeline,
                    std::span<const std::byte> pushConstants, const std::array<uint32_t, 3>& groups)
{
    recordState(commands, pipeline, pushConstants);
    vkCmdDispatch(commands, groups[0], groups[1], groups[2]);
}

void recordIndirectDispatch(VkCommandBuffer commands, const ComputePipeline& pipeline,
                            std::span<const std::byte> pushConstants, const Buffer& groups,
                            uint64_t offset)
{
    recordState(commands, pipeline, pushConstants);
    vkCmdDispatchIndirect(commands, groups.handle.get(), offset);
}

}  // namespace sahl
