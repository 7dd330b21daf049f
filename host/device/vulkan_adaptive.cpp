#include "device/vulkan_adaptive.h"

#include "kernels/spirv.h"
#include "shared/bindings.h"
#include "util/error.h"

#include <chrono>

namespace sahl {

namespace {

class VulkanAdaptiveTile final : public AdaptiveTile {
public:
    VulkanAdaptiveTile(const AdaptiveHost& host, const TileRequest& tile, const AdaptiveRule& rule);

    AdaptivePass runPass() override;
    void read(std::span<AdaptivePixel> pixels) override;

private:
    /// A queue of pixels on the device.
    struct Queue {
        uint32_t number = QUEUE_ALL;
        uint32_t size = 0;
    };

    std::string name() const;
    void bind();
    RoundState runRound(uint32_t dispatches, bool begin);
    void recordStage(VkCommandBuffer commands, const ComputePipeline& pipeline, const Queue& queue,
                     uint32_t stage);
    void recordEndOfRound(VkCommandBuffer commands);

    AdaptiveHost host_;
    TileRequest tile_;
    AdaptiveRule rule_;
    Buffer buffer_;      // AdaptiveCounts, then AdaptivePixel[]
    Queue active_;       // pixels of the next pass, or of the one under way
    Queue before_;       // pixels of the newest pass that is complete: not yet in the film
    uint32_t next_ = 0;  // number of the queue that this pass fills
    uint32_t passes_ = 0;
    AdaptiveCounts counts_ = {};
};

VulkanAdaptiveTile::VulkanAdaptiveTile(const AdaptiveHost& host, const TileRequest& tile,
                                       const AdaptiveRule& rule)
    : host_(host), tile_(tile), rule_(rule)
{
    active_.size = tile.width * tile.height;
    uint64_t bytes = sizeof(AdaptiveCounts) + uint64_t{active_.size} * sizeof(AdaptivePixel);
    buffer_ = createBuffer(host_.context, {"adaptive pixels", bytes,
                                           VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, HostUse::readBack});
    runCommands(host_.context, name(), [&](VkCommandBuffer commands) {
        vkCmdFillBuffer(commands, buffer_.handle.get(), 0, VK_WHOLE_SIZE, 0);
        recordBarrier(commands, TRANSFER_WRITE, COMPUTE_USE);
    });
}

std::string VulkanAdaptiveTile::name() const
{
    return fmt::format("adaptive tile {}x{} at {},{}, pass {}", tile_.width, tile_.height, tile_.x,
                       tile_.y, passes_ + 1);
}

/// Tiles share pipelines, and a pipeline has one descriptor set.
void VulkanAdaptiveTile::bind()
{
    std::array<const Buffer*, BINDING_COUNT> buffers = {};
    for (uint32_t i = 0; i < SCENE_BUFFER_COUNT; i++) buffers[i] = &host_.scene.arrays[i];
    buffers[BINDING_FRAME] = &host_.scene.frame;
    buffers[BINDING_PIXELS] = &buffer_;
    buffers[BINDING_SUSPENDED] = &host_.suspended;
    bindBuffers(host_.context, host_.pipelines.path, buffers);
    const Buffer* own[] = {&buffer_};
    bindBuffers(host_.context, host_.pipelines.pass, own);
}

AdaptivePass VulkanAdaptiveTile::runPass()
{
    if (active_.size == 0) return {};
    auto start = std::chrono::steady_clock::now();
    bind();
    RoundState state = runRound(BLOCK_SIZE, true);
    host_.work.finish({name(), host_.scene.stepsPerSample, host_.stackSize}, state,
                      [&](uint32_t dispatches) { return runRound(dispatches, false); });
    passes_++;
    before_ = active_;
    active_ = {next_, counts_.activePixels};
    next_ = 1 - next_;
    std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    host_.statistics.renderSeconds += seconds.count();
    return {counts_.activePixels, counts_.samplesDone,
            uint64_t{counts_.rays.y} << 32 | uint64_t{counts_.rays.x}};
}

/// Runs `dispatches` dispatches over the active pixels, then looks at what they left. `begin`: it
/// is the first round of a pass, and the blocks of the pass before go into the film.
RoundState VulkanAdaptiveTile::runRound(uint32_t dispatches, bool begin)
{
    host_.work.runInParts(active_.size, dispatches, [&](uint32_t count, bool isFirst, bool isLast) {
        runCommands(host_.context, name(), [&](VkCommandBuffer commands) {
            if (begin && isFirst && before_.size > 0) {
                recordStage(commands, host_.pipelines.pass, before_, STAGE_FOLD);
                recordBarrier(commands, COMPUTE_WRITE, COMPUTE_USE);
            }
            for (uint32_t i = 0; i < count; i++) {
                recordStage(commands, host_.pipelines.path, active_, 0);
                recordBarrier(commands, COMPUTE_WRITE, COMPUTE_USE);
            }
            if (isLast) recordEndOfRound(commands);
        });
    });
    readBuffer(buffer_, std::as_writable_bytes(std::span(&counts_, 1)));
    return {counts_.samplesMissing, counts_.samplesDone, counts_.faults};
}

void VulkanAdaptiveTile::recordStage(VkCommandBuffer commands, const ComputePipeline& pipeline,
                                     const Queue& queue, uint32_t stage)
{
    AdaptiveDispatch job = {};
    job.tileX = tile_.x;
    job.tileY = tile_.y;
    job.tileWidth = tile_.width;
    job.queue = queue.number;
    job.queueSize = queue.size;
    job.nextQueue = next_;
    job.stage = stage;
    job.stepBudget = host_.statistics.stepBudget;
    job.rule = rule_;
    uint32_t groupSize = host_.pipelines.groupSize;
    recordDispatch(commands, pipeline, std::as_bytes(std::span(&job, 1)),
                   {(queue.size + groupSize - 1) / groupSize, 1, 1});
}

void VulkanAdaptiveTile::recordEndOfRound(VkCommandBuffer commands)
{
    recordBarrier(commands, COMPUTE_WRITE, TRANSFER_WRITE);
    vkCmdFillBuffer(commands, buffer_.handle.get(), 0, sizeof(AdaptiveCounts), 0);
    recordBarrier(commands, TRANSFER_WRITE, COMPUTE_USE);
    recordStage(commands, host_.pipelines.pass, active_, STAGE_INSPECT);
    recordBarrier(commands, COMPUTE_WRITE, COMPUTE_USE);
    recordStage(commands, host_.pipelines.pass, active_, STAGE_ADVANCE);
    recordBarrier(commands, COMPUTE_WRITE, COMPUTE_USE);
    recordReadBack(commands, buffer_, sizeof(AdaptiveCounts));
}

void VulkanAdaptiveTile::read(std::span<AdaptivePixel> pixels)
{
    runCommands(host_.context, "read adaptive pixels", [&](VkCommandBuffer commands) {
        recordReadBack(commands, buffer_, buffer_.bytes);
    });
    readBuffer(buffer_, std::as_writable_bytes(pixels), sizeof(AdaptiveCounts));
}

}  // namespace

AdaptivePipelines makeAdaptivePipelines(Context& context, ComputePipeline path,
                                        const std::array<uint32_t, 2>& group)
{
    PipelineRequest request;
    request.name = "adaptive_pass";
    request.spirv = kernelSpirv(request.name);
    request.bindings = {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};
    request.pushConstantBytes = sizeof(AdaptiveDispatch);
    request.specialisation = {group[0], group[1]};
    return {std::move(path), createComputePipeline(context, request), group[0] * group[1]};
}

std::unique_ptr<AdaptiveTile> makeVulkanAdaptiveTile(const AdaptiveHost& host,
                                                     const TileRequest& tile,
                                                     const AdaptiveRule& rule)
{
    return std::make_unique<VulkanAdaptiveTile>(host, tile, rule);
}

}  // namespace sahl
