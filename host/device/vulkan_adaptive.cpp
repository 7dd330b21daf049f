#include "device/vulkan_adaptive.h"

#include "device/adaptive_schedule.h"
#include "device/driver_habits.h"
#include "device/kernels.h"
#include "shared/bindings.h"
#include "util/error.h"

#include <chrono>
#include <utility>

namespace sahl {

namespace {

/// What the tiles of a picture share.
struct Shared {
    AdaptiveHost host;
    AdaptiveWindow window;
    AdaptiveRule rule;
    Buffer estimates;  // PixelEstimate[] of the window, for rules that look at neighbours
};

class VulkanAdaptiveTile final : public AdaptiveTile {
public:
    VulkanAdaptiveTile(Shared& shared, const TileRequest& tile);

    AdaptivePass runPass() override;
    uint32_t decide(const AdaptiveFloors& floors) override;
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
    void foldAlone();
    void recordStage(VkCommandBuffer commands, const ComputePipeline& pipeline, const Queue& queue,
                     uint32_t stage, const AdaptiveFloors& floors = {});
    void recordClearCounts(VkCommandBuffer commands);
    void recordEndOfRound(VkCommandBuffer commands);
    void readCounts();
    uint32_t queueToFill() const;
    uint32_t activePixels() const { return active_.size + activeAfter_.size; }

    Shared& shared_;
    AdaptiveHost& host_;
    TileRequest tile_;
    Buffer buffer_;      // AdaptiveCounts, then AdaptivePixel[]
    Queue active_;       // pixels of the next pass, or of the one under way
    Queue activeAfter_;  // of the pass after that, where halves go apart
    Queue before_;       // pixels of the newest pass that is complete: not yet in the film
    uint32_t passes_ = 0;
    AdaptiveCounts counts_ = {};
};

VulkanAdaptiveTile::VulkanAdaptiveTile(Shared& shared, const TileRequest& tile)
    : shared_(shared), host_(shared.host), tile_(tile)
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
    bindBuffers(host_.context, host_.pipelines.path.get(), buffers);
    const Buffer* own[] = {&buffer_};
    bindBuffers(host_.context, host_.pipelines.pass, own);
    if (!looksAtNeighbours(shared_.rule)) return;
    const Buffer* both[] = {&buffer_, &shared_.estimates};
    bindBuffers(host_.context, host_.pipelines.decide, both);
}

/// The queue that the pass under way fills.
uint32_t VulkanAdaptiveTile::queueToFill() const
{
    if (decisionIsDue(shared_.rule, passes_ + 1)) return QUEUE_NONE;
    return (passes_ + (halvesGoApart(shared_.rule, passes_) ? 2 : 1)) % QUEUE_COUNT;
}

AdaptivePass VulkanAdaptiveTile::runPass()
{
    if (activePixels() == 0) return {};
    auto start = std::chrono::steady_clock::now();
    bind();
    if (active_.size > 0) {
        RoundState state = runRound(BLOCK_SIZE, true);
        host_.work.finish({name(), host_.scene.stepsPerSample, host_.stackSize}, state, [&](uint32_t dispatches) {
            if (host_.pipelines.path.resume()) bind();
            return runRound(dispatches, false);
        });
    } else {
        foldAlone();
    }
    before_ = active_;
    Queue filled = {queueToFill(), counts_.activePixels};
    if (filled.number == QUEUE_NONE) {
        // The decision fills the next one. Until then all pixels count as active.
    } else if (halvesGoApart(shared_.rule, passes_)) {
        active_ = std::exchange(activeAfter_, filled);
    } else {
        active_ = filled;
    }
    passes_++;
    std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    host_.statistics.renderSeconds += seconds.count();
    return {activePixels(), counts_.samplesDone,
            uint64_t{counts_.rays.y} << 32 | uint64_t{counts_.rays.x}};
}

/// A pass in which no pixel takes samples, since it is the turn of the half that has enough.
void VulkanAdaptiveTile::foldAlone()
{
    counts_ = {};
    runCommands(host_.context, name(), [&](VkCommandBuffer commands) {
        recordStage(commands, host_.pipelines.pass, before_, STAGE_FOLD);
        recordBarrier(commands, COMPUTE_WRITE, COMPUTE_USE);
    });
}

uint32_t VulkanAdaptiveTile::decide(const AdaptiveFloors& floors)
{
    bind();
    passes_--;  // the newest pass decides
    runCommands(host_.context, name(), [&](VkCommandBuffer commands) {
        recordClearCounts(commands);
        recordStage(commands, host_.pipelines.decide, before_, STAGE_DECIDE, floors);
        recordBarrier(commands, COMPUTE_WRITE, COMPUTE_USE);
        recordReadBack(commands, buffer_, sizeof(AdaptiveCounts));
    });
    passes_++;
    readCounts();
    active_ = {passes_ % QUEUE_COUNT, counts_.activePixels};
    activeAfter_ = {(passes_ + 1) % QUEUE_COUNT, counts_.activeInB};
    return activePixels();
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
            host_.statistics.dispatches += count;
            for (uint32_t i = 0; i < count; i++) {
                recordStage(commands, host_.pipelines.path.get(), active_, 0);
                recordBarrier(commands, COMPUTE_WRITE, COMPUTE_USE);
            }
            if (isLast) recordEndOfRound(commands);
        });
    });
    readCounts();
    return {counts_.samplesMissing, counts_.samplesDone, counts_.faults};
}

void VulkanAdaptiveTile::readCounts()
{
    readBuffer(buffer_, std::as_writable_bytes(std::span(&counts_, 1)));
}

void VulkanAdaptiveTile::recordStage(VkCommandBuffer commands, const ComputePipeline& pipeline,
                                     const Queue& queue, uint32_t stage, const AdaptiveFloors& floors)
{
    if (queue.size == 0) return;
    AdaptiveDispatch job = {};
    job.tileX = tile_.x;
    job.tileY = tile_.y;
    job.tileWidth = tile_.width;
    job.queue = queue.number;
    job.queueSize = queue.size;
    job.nextQueue = stage == STAGE_DECIDE ? (passes_ + 1) % QUEUE_COUNT : queueToFill();
    job.stage = stage;
    job.stepBudget = host_.statistics.stepBudget;
    job.pass = passes_;
    job.windowLeft = shared_.window.left;
    job.windowTop = shared_.window.top;
    job.windowWidth = shared_.window.width;
    job.windowHeight = shared_.window.height;
    job.floors = floors;
    job.rule = shared_.rule;
    uint32_t groupSize = host_.pipelines.groupSize;
    recordDispatch(commands, pipeline, std::as_bytes(std::span(&job, 1)),
                   {(queue.size + groupSize - 1) / groupSize, 1, 1});
}

void VulkanAdaptiveTile::recordClearCounts(VkCommandBuffer commands)
{
    recordBarrier(commands, COMPUTE_WRITE, TRANSFER_WRITE);
    vkCmdFillBuffer(commands, buffer_.handle.get(), 0, sizeof(AdaptiveCounts), 0);
    recordBarrier(commands, TRANSFER_WRITE, COMPUTE_USE);
}

void VulkanAdaptiveTile::recordEndOfRound(VkCommandBuffer commands)
{
    recordClearCounts(commands);
    recordStage(commands, host_.pipelines.pass, active_, STAGE_INSPECT);
    recordBarrier(commands, COMPUTE_WRITE, COMPUTE_USE);
    recordStage(commands, host_.pipelines.pass, active_, STAGE_ADVANCE);
    recordBarrier(commands, COMPUTE_WRITE, COMPUTE_USE);
    if (decisionIsDue(shared_.rule, passes_ + 1)) {
        recordStage(commands, host_.pipelines.decide, active_, STAGE_ESTIMATE);
        recordBarrier(commands, COMPUTE_WRITE, COMPUTE_USE);
    }
    recordReadBack(commands, buffer_, sizeof(AdaptiveCounts));
}

void VulkanAdaptiveTile::read(std::span<AdaptivePixel> pixels)
{
    runCommands(host_.context, "read adaptive pixels", [&](VkCommandBuffer commands) {
        recordReadBack(commands, buffer_, buffer_.bytes);
    });
    readBuffer(buffer_, std::as_writable_bytes(pixels), sizeof(AdaptiveCounts));
}

class VulkanAdaptivePicture final : public AdaptivePicture {
public:
    VulkanAdaptivePicture(const AdaptiveHost& host, const AdaptiveWindow& window,
                          const AdaptiveRule& rule)
        : shared_{host, window, rule, {}}
    {
        if (!looksAtNeighbours(rule)) return;
        uint64_t bytes = uint64_t{window.width} * window.height * sizeof(PixelEstimate);
        shared_.estimates = createBuffer(host.context, {"estimates", bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                                        HostUse::readBack});
    }

    std::unique_ptr<AdaptiveTile> beginTile(const TileRequest& tile) override
    {
        shared_.host.prepareTile(tile);
        return std::make_unique<VulkanAdaptiveTile>(shared_, tile);
    }

    void readEstimates(std::span<PixelEstimate> estimates) override
    {
        runCommands(shared_.host.context, "read estimates", [&](VkCommandBuffer commands) {
            recordReadBack(commands, shared_.estimates, estimates.size_bytes());
        });
        readBuffer(shared_.estimates, std::as_writable_bytes(estimates));
    }

private:
    Shared shared_;
};

}  // namespace

AdaptivePipelines makeAdaptivePipelines(Context& context, ResumablePipeline path,
                                        const std::array<uint32_t, 2>& group, uint32_t math)
{
    PipelineRequest request;
    request.name = "adaptive_pass";
    std::vector<uint32_t> constants(SPEC_COUNT);
    constants[SPEC_GROUP_WIDTH] = group[0];
    constants[SPEC_GROUP_HEIGHT] = group[1];
    constants[SPEC_MATH] = math;
    constants[SPEC_UNIFORMS_HIDDEN] = compilesForUniforms(context.physical.driver) ? 1 : 0;
    request.spirv = foldedKernel(request.name, constants);
    request.bindings = {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};
    request.pushConstantBytes = sizeof(AdaptiveDispatch);
    ComputePipeline pass = createComputePipeline(context, request);
    request.name = "adaptive_decide";
    request.spirv = foldedKernel(request.name, constants);
    request.bindings.push_back(VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
    return {std::move(path), std::move(pass), createComputePipeline(context, request),
            group[0] * group[1]};
}

std::unique_ptr<AdaptivePicture> makeVulkanAdaptivePicture(const AdaptiveHost& host,
                                                           const AdaptiveWindow& window,
                                                           const AdaptiveRule& rule)
{
    return std::make_unique<VulkanAdaptivePicture>(host, window, rule);
}

}  // namespace sahl
