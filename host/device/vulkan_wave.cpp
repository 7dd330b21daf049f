#include "device/vulkan_wave.h"

#include "device/driver_habits.h"
#include "device/kernels.h"
#include "shared/bindings.h"
#include "shared/wave_types.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sahl {

namespace {

constexpr uint32_t SOFTWARE_SLOTS = 1u << 15;
constexpr uint32_t HARDWARE_SLOTS = 1u << 19;
constexpr uint64_t ROW_BYTES = sizeof(uvec4);

/// Slots that the device's buffers and dispatches allow.
uint32_t chooseSlots(const PhysicalDevice& device, const WaveSetup& setup)
{
    const uint64_t fitting = device.kind == "software" ? SOFTWARE_SLOTS : HARDWARE_SLOTS;
    const uint64_t wanted = setup.slots > 0 ? setup.slots : fitting;
    const VkPhysicalDeviceLimits& limits = device.properties.limits;
    const uint64_t range =
        std::min<uint64_t>(limits.maxStorageBufferRange, device.maxAllocationBytes);
    const uint64_t largest =
        std::max<uint64_t>(WAVE_PATH_ROWS * ROW_BYTES, setup.stackSize * sizeof(uint32_t));
    const uint64_t invocations = uint64_t{limits.maxComputeWorkGroupCount[0]} * setup.groupSize;
    return static_cast<uint32_t>(
        std::min({wanted, range / largest, invocations, uint64_t{MAX_WAVE_SLOTS}}));
}

uint64_t saturatingSum(uint64_t a, uint64_t b)
{
    return a > std::numeric_limits<uint64_t>::max() - b ? std::numeric_limits<uint64_t>::max()
                                                        : a + b;
}

}  // namespace

VulkanWaves::VulkanWaves(Context& context, const WaveSetup& setup, const MakeWavePipeline& make,
                         BoundedWork& work, DeviceStatistics& statistics)
    : context_(context),
      setup_(setup),
      work_(work),
      statistics_(statistics),
      slotLimit_(chooseSlots(context.physical, setup))
{
    PipelineRequest plan;
    plan.name = "wave_plan";
    std::vector<uint32_t> constants(SPEC_COUNT);
    constants[SPEC_GROUP_WIDTH] = setup.groupSize;
    constants[SPEC_GROUP_HEIGHT] = 1;
    constants[SPEC_UNIFORMS_HIDDEN] = compilesForUniforms(context.physical.driver) ? 1 : 0;
    plan.spirv = foldedKernel(plan.name, constants);
    plan.bindings = {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};
    plan.pushConstantBytes = sizeof(WaveDispatch);
    plan_ = createComputePipeline(context, plan);
    begin_ = make("wave_begin", BINDING_WAVE_RAYS + 1, false);
    trace_ = ResumablePipeline([make](bool resumes) { return make("wave_trace", BINDING_WAVE_STACKS + 1, resumes); });
    shade_ = make(setup.ballots ? "wave_shade" : "wave_shade_shared", BINDING_WAVE_HITS + 1, false);
    film_ = make("wave_film", BINDING_WAVE_PIXELS + 1, false);
}

void VulkanWaves::setScene(const VulkanScene& scene)
{
    scene_ = &scene;
    bound_ = false;
}

void VulkanWaves::prepareBuffers(size_t pixels)
{
    const uint64_t sampleCount = uint64_t{pixels} * BLOCK_SIZE;
    const auto slots = static_cast<uint32_t>(std::min<uint64_t>(slotLimit_, sampleCount));
    if (buffers_.slots >= slots && buffers_.pixelCount >= pixels) return;
    buffers_ = {};
    bound_ = false;
    auto make = [&](const char* name, uint64_t bytes, HostUse use = HostUse::none,
                    VkBufferUsageFlags more = 0) {
        return createBuffer(context_,
                            {name, bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | more, use});
    };
    buffers_.queues = make("queues", sizeof(WaveCounts) + 3 * uint64_t{slots} * sizeof(uint32_t),
                           HostUse::readBack, VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT);
    buffers_.samples = make("samples", sampleCount * WAVE_SAMPLE_ROWS * ROW_BYTES);
    buffers_.paths = make("paths", uint64_t{slots} * WAVE_PATH_ROWS * ROW_BYTES);
    buffers_.rays = make("rays", uint64_t{slots} * WAVE_RAY_ROWS * ROW_BYTES);
    buffers_.hits = make("hits", uint64_t{slots} * WAVE_HIT_ROWS * ROW_BYTES);
    buffers_.walks = make("walks", uint64_t{slots} * sizeof(WaveWalk));
    buffers_.stacks = make("stacks", uint64_t{slots} * setup_.stackSize * sizeof(uint32_t));
    buffers_.pixels = make("pixels", pixels * sizeof(PixelBlock), HostUse::readBack);
    buffers_.slots = slots;
    buffers_.pixelCount = pixels;
}

void VulkanWaves::bindAll()
{
    std::array<const Buffer*, BINDING_WAVE_STACKS + 1> all = {};
    for (uint32_t i = 0; i < SCENE_BUFFER_COUNT; i++) all[i] = &scene_->arrays[i];
    all[BINDING_FRAME] = &scene_->frame;
    all[BINDING_WAVE_QUEUES] = &buffers_.queues;
    all[BINDING_WAVE_SAMPLES] = &buffers_.samples;
    all[BINDING_WAVE_PATHS] = &buffers_.paths;
    all[BINDING_WAVE_RAYS] = &buffers_.rays;
    all[BINDING_WAVE_HITS] = &buffers_.hits;
    all[BINDING_WAVE_WALKS] = &buffers_.walks;
    all[BINDING_WAVE_STACKS] = &buffers_.stacks;
    auto bind = [&](ComputePipeline& pipeline) {
        bindBuffers(context_, pipeline, std::span(all).first(pipeline.bindings.size()));
    };
    bind(begin_);
    bind(trace_.get());
    bind(shade_);
    all[BINDING_WAVE_PIXELS] = &buffers_.pixels;
    bind(film_);
    const Buffer* own[] = {&buffers_.queues};
    bindBuffers(context_, plan_, own);
}

WaveDispatch VulkanWaves::jobOf(const TileRequest& tile) const
{
    WaveDispatch job = {};
    job.tileX = tile.x;
    job.tileY = tile.y;
    job.tileWidth = tile.width;
    job.pixelCount = tile.width * tile.height;
    job.firstSample = tile.firstSample;
    job.sampleCount = tile.sampleCount;
    job.stepBudget = statistics_.stepBudget;
    job.slotCount = buffers_.slots;
    return job;
}

/// Records and runs some waves; before them clears some of what was counted. `end`: the counts are
/// read next.
void VulkanWaves::submitWaves(const WaveDispatch& job, uint32_t count, Clear clear, bool end)
{
    const std::span<const std::byte> constants = std::as_bytes(std::span(&job, 1));
    const Buffer& queues = buffers_.queues;
    constexpr uint64_t GROUPS = offsetof(WaveCounts, groups),
                       BEGIN_GROUPS = offsetof(WaveCounts, beginGroups);
    runCommands(context_, name_, [&](VkCommandBuffer commands) {
        if (clear == Clear::all)
            vkCmdFillBuffer(commands, queues.handle.get(), 0, sizeof(WaveCounts), 0);
        if (clear == Clear::faults)
            vkCmdFillBuffer(commands, queues.handle.get(), offsetof(WaveCounts, faults),
                            sizeof(uint32_t), 0);
        if (clear != Clear::nothing) recordBarrier(commands, TRANSFER_WRITE, COMPUTE_USE);
        for (uint32_t i = 0; i < count; i++) {
            recordDispatch(commands, plan_, constants, {1, 1, 1});
            recordBarrier(commands, COMPUTE_WRITE, COMPUTE_USE_AND_COUNT);
            recordIndirectDispatch(commands, begin_, constants, queues, BEGIN_GROUPS);
            recordBarrier(commands, COMPUTE_WRITE, COMPUTE_USE_AND_COUNT);
            recordIndirectDispatch(commands, trace_.get(), constants, queues, GROUPS);
            recordBarrier(commands, COMPUTE_WRITE, COMPUTE_USE_AND_COUNT);
            recordIndirectDispatch(commands, shade_, constants, queues, GROUPS);
            recordBarrier(commands, COMPUTE_WRITE, COMPUTE_USE);
        }
        if (end) recordReadBack(commands, queues, sizeof(WaveCounts));
    });
    statistics_.dispatches += uint64_t{count} * 4;
}

/// Runs so many waves and reads what they counted.
RoundState VulkanWaves::runWaves(const WaveDispatch& job, uint32_t count, bool begin)
{
    work_.runInParts(job.slotCount, count, [&](uint32_t part, bool isFirst, bool isLast) {
        const Clear clear = begin ? Clear::all : Clear::faults;
        submitWaves(job, part, isFirst ? clear : Clear::nothing, isLast);
    });
    readBuffer(buffers_.queues, std::as_writable_bytes(std::span(&counts_, 1)));
    RoundState state;
    state.samplesDone = counts_.begunCount - counts_.nextCount;
    state.samplesMissing =
        static_cast<uint32_t>(uint64_t{job.pixelCount} * job.sampleCount - state.samplesDone);
    state.faults = counts_.faults;
    return state;
}

void VulkanWaves::finishWaves(const BoundedTask& task, const WaveDispatch& ofTile)
{
    WaveDispatch job = ofTile;
    const double fillings = std::ceil(double(job.pixelCount) * job.sampleCount / job.slotCount);
    auto waves = static_cast<uint32_t>(std::clamp(fillings * wavesPerFilling_, 1.0, 1000.0)) + 2;
    uint64_t done = 0;
    work_.beginRounds();
    for (bool begin = true;; begin = false) {
        const RoundState state = runWaves(job, waves, begin);
        work_.noteRound(task, done, state, uint64_t{waves} * job.stepBudget);
        if (state.samplesMissing == 0) break;
        if (counts_.resumedWaves > 0 && trace_.resume()) bindAll();
        done = state.samplesDone;
        job.stepBudget = statistics_.stepBudget;
        waves = std::clamp(counts_.waves / 4, 4u, 100u);
    }
    statistics_.resumptions += counts_.resumedWaves;
    wavesPerFilling_ = counts_.waves / fillings;
}

/// Adds the samples of every pixel to its block.
RoundState VulkanWaves::addToBlocks(const WaveDispatch& job, std::span<PixelBlock> blocks)
{
    const uint32_t groups = (job.pixelCount + setup_.groupSize - 1) / setup_.groupSize;
    runCommands(context_, name_, [&](VkCommandBuffer commands) {
        vkCmdFillBuffer(commands, buffers_.pixels.handle.get(), 0, blocks.size_bytes(), 0);
        recordBarrier(commands, TRANSFER_WRITE, COMPUTE_USE);
        recordDispatch(commands, film_, std::as_bytes(std::span(&job, 1)), {groups, 1, 1});
        recordReadBack(commands, buffers_.pixels, blocks.size_bytes());
    });
    statistics_.dispatches++;
    readBuffer(buffers_.pixels, std::as_writable_bytes(blocks));
    return stateOf(blocks, job.sampleCount, setup_.threads);
}

void VulkanWaves::render(const std::string& name, const TileRequest& tile,
                         std::span<PixelBlock> blocks)
{
    name_ = name;
    prepareBuffers(blocks.size());
    if (!bound_) bindAll();
    bound_ = true;
    const WaveDispatch job = jobOf(tile);
    // A wave takes a path one ray further at most, however few steps that takes.
    const uint64_t oneEach = scene_->turnsPerSample * job.stepBudget;
    finishWaves({name, saturatingSum(scene_->stepsPerSample, oneEach), setup_.stackSize}, job);
    work_.finish({name, 1, setup_.stackSize}, addToBlocks(job, blocks),
                 [&](uint32_t) { return addToBlocks(job, blocks); });
}

}  // namespace sahl
