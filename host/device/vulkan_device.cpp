// The Device that runs the path tracing kernels on Vulkan.
#include "device/bounded_work.h"
#include "device/driver_habits.h"
#include "device/exact_math.h"
#include "device/kernels.h"
#include "device/scene_features.h"
#include "device/scene_reads.h"
#include "device/variants.h"
#include "device/resumable.h"
#include "device/vulkan_adaptive.h"
#include "device/vulkan_ahead.h"
#include "device/vulkan_limits.h"
#include "device/vulkan_scene.h"
#include "device/vulkan_trace.h"
#include "device/vulkan_wave.h"
#include "device/walked_tree.h"
#include "shared/bindings.h"
#include "shared/features.h"
#include "util/memory.h"
#include "util/parallel.h"
#include "vulkan/pipeline.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace sahl {

namespace {

double secondsSince(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The variant that the options name, or that was tuned, or that suits the driver; with the shape of a workgroup that
/// the options name.
Variant chooseVariant(const PhysicalDevice& device, const DeviceOptions& options)
{
    Variant variant = standardVariant(device.driver);
    if (!options.variant.empty())
        variant = variantNamed(options.variant);
    else if (std::optional<Variant> tuned = tunedVariant(device.name, device.driver))
        variant = *tuned;
    if (options.groupWidth > 0) variant.groupWidth = options.groupWidth;
    if (options.groupHeight > 0) variant.groupHeight = options.groupHeight;
    return variant;
}

class VulkanDevice final : public Device {
public:
    VulkanDevice(std::unique_ptr<Context> context, const DeviceOptions& options);

    DeviceInfo info() const override;
    void expectScene(const SceneOutline& outline) override;
    void setScene(const DeviceScene& scene) override;
    void expectTile(const TileRequest& tile) override { expected_ = tile; }
    void render(const TileRequest& tile, std::span<PixelBlock> blocks) override;
    void renderFirstHits(const TileRequest& tile, std::span<FirstHits> pixels) override;
    double traceRays(std::span<const TraceRay> rays, bool anyHit, std::span<TraceHit> hits) override;
    std::unique_ptr<AdaptivePicture> beginAdaptive(const AdaptiveWindow& window,
                                                   const AdaptiveRule& rule) override;
    uint32_t samplerKind() const override { return samplerKind_; }
    uint32_t maxTilePixels() const override { return tilePixelLimit(context_->physical, group_); }
    uint64_t maxAdaptivePixels() const override { return adaptivePixelLimit(context_->physical); }
    DeviceStatistics statistics() const override { return statistics_; }

private:
    ComputePipeline makePipeline(const std::string& kernel, uint32_t bindingCount,
                                 uint32_t pushConstantBytes, bool resumes);
    ResumablePipeline makeResumable(const char* kernel, uint32_t bindingCount, uint32_t pushConstantBytes);
    bool watchesWalks(size_t primitives, uint32_t features) const;
    void preparePipeline(bool texel, uint32_t features, const WalkForm& form);
    void prepareTileBuffers(size_t pixels);
    void prepareFirstHits(size_t pixels);
    bool haveStorageBuffers(uint32_t ofKernel) const;
    void requireStorageBuffers(uint32_t ofKernel, const char* purpose) const;
    void makePathPipelines();
    void bindAll(ComputePipeline& pipeline);
    void renderWhole(const TileRequest& tile, std::span<PixelBlock> blocks);
    void renderBlocks(const TileRequest& tile, std::span<PixelBlock> blocks);
    bool mayBeginAhead(const TileRequest& tile) const;
    void requireTile(const TileRequest& tile, size_t blockCount) const;
    RoundState runRound(const TileRequest& tile, uint32_t samples, bool begin,
                        std::span<PixelBlock> blocks);
    void submit(const TileRequest& tile, uint32_t samples, bool begin, bool end);
    void recordSamples(VkCommandBuffer commands, const TileRequest& tile, uint32_t samples, bool begin);

    std::unique_ptr<Context> context_;  // stands first: everything below is made from it
    DeviceOptions options_;
    Variant variant_;
    std::array<uint32_t, 2> group_;
    uint32_t math_ = MATH_NATIVE;  // one of MATH_*
    unsigned threads_;  // of the host
    DeviceStatistics statistics_;
    BoundedWork work_;
    ResumablePipeline pipeline_;
    ComputePipeline firstHitsPipeline_;        // made when first asked for
    ResumablePipeline tracePipeline_;          // likewise
    const ComputePipeline* active_ = nullptr;  // the one of the first two that dispatches use
    bool pipelineTexel_ = false;
    uint32_t pipelineFeatures_ = 0;
    WalkForm pipelineForm_;  // without entries: no pipeline yet
    bool fewSamples_ = false;  // of the scene that is expected
    std::unique_ptr<VulkanScene> scene_;
    uint32_t samplerKind_ = SAMPLER_INDEPENDENT;
    Buffer pixels_, suspended_;   // as large as the largest tile so far
    Buffer firstHits_;
    bool bound_ = false;           // pipeline_'s descriptor set holds the buffers above
    bool firstHitsBound_ = false;  // likewise
    std::unique_ptr<AdaptivePipelines> adaptive_;  // made when first asked for
    std::unique_ptr<VulkanWaves> waves_;           // where paths go in waves: in place of pipeline_
    std::optional<TileRequest> expected_;          // after the one that is rendered next
    TilesAhead ahead_;                             // stands last: uses the above until it is gone
};

VulkanDevice::VulkanDevice(std::unique_ptr<Context> context, const DeviceOptions& options)
    : context_(std::move(context)),
      options_(options),
      variant_(chooseVariant(context_->physical, options)),
      group_(chooseGroupShape(context_->physical, variant_.groupWidth, variant_.groupHeight)),
      threads_(options.threads > 0 ? options.threads : defaultThreadCount()),
      work_(context_->physical, options.stepBudget, statistics_),
      ahead_(*context_)
{
    statistics_.variant = nameOf(variant_);
    math_ = chooseMath(*context_, options.math);
    statistics_.exactMath = math_ != MATH_NATIVE;
}

/// Walks are watched where the driver may cut loops, where one might take long, and where somebody says how many steps it
/// may take.
bool VulkanDevice::watchesWalks(size_t primitives, uint32_t features) const
{
    const bool trusted = options_.trustsLoops || !mayCutLoops(context_->physical.driver);
    return !trusted || options_.stepBudget != 0 || (features & FEATURE_INSTANCES) != 0 ||
           primitives > SHORT_WALK_PRIMITIVES;
}

DeviceInfo VulkanDevice::info() const
{
    const PhysicalDevice& device = context_->physical;
    return {device.name, device.driver, device.kind};
}

void VulkanDevice::expectScene(const SceneOutline& outline)
{
    ahead_.drain();
    SceneBytes bytes = {};
    bytes[BINDING_PRIMITIVES] = outline.primitives * sizeof(Primitive);
    bytes[BINDING_CORNERS] = outline.triangleCorners * sizeof(TriangleCorners);
    const bool texel = chooseTexelBuffers(context_->physical, bytes, {options_.buffers, variant_.texelBuffers});
    fewSamples_ = outline.samples <= FEW_SAMPLES;
    WalkForm form = expectedWalkForm(outline.primitives, options_.nodeWidth, variant_.stackInRegisters, fewSamples_);
    form.stackEntries = chooseStackSize(form.stackEntries);
    form.watched = watchesWalks(outline.primitives, outline.features);
    preparePipeline(texel, outline.features, form);
}

void VulkanDevice::setScene(const DeviceScene& scene)
{
    ahead_.drain();
    scene_.reset();  // first, so that there never need be room for two scenes
    bound_ = false;
    firstHitsBound_ = false;
    WalkForm form = walkFormFor(scene, options_.nodeWidth, variant_.stackInRegisters);
    form.stackEntries = chooseStackSize(form.stackEntries);
    form.watched = watchesWalks(scene.primitives.size(), featuresOf(scene));
    if (serves(pipelineForm_, form, std::exchange(fewSamples_, false))) form = pipelineForm_;
    auto start = std::chrono::steady_clock::now();
    auto uploaded = std::make_unique<VulkanScene>(
        uploadScene(*context_, scene, {options_.buffers, variant_.texelBuffers}, form.nodeWidth));
    statistics_.uploadSeconds += secondsSince(start);
    preparePipeline(uploaded->texel, featuresOf(scene), form);
    scene_ = std::move(uploaded);
    if (waves_) waves_->setScene(*scene_);
    samplerKind_ = scene.frame.samplerKind;
    statistics_.sceneBytes = scene_->bytes;
    statistics_.texelBuffers = scene_->texel;
}

/// A pipeline of the kernel `kernel`, in the form for the stack and buffers in force.
ComputePipeline VulkanDevice::makePipeline(const std::string& kernel, uint32_t bindingCount,
                                           uint32_t pushConstantBytes, bool resumes)
{
    PipelineRequest request;
    const SceneReads reads = sceneReads(context_->physical, pipelineTexel_);
    request.name = kernel + suffixOf(reads);
    for (uint32_t i = 0; i < SCENE_BUFFER_COUNT; i++) request.bindings.push_back(arrayType(reads, i));
    request.bindings.resize(bindingCount, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
    request.bindings[BINDING_FRAME] = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    if (kernel == TRACE_KERNEL) request.bindings[BINDING_RAYS] = raysType(reads);
    request.pushConstantBytes = pushConstantBytes;
    std::vector<uint32_t> constants(SPEC_COUNT);
    constants[SPEC_GROUP_WIDTH] = group_[0];
    constants[SPEC_GROUP_HEIGHT] = group_[1];
    constants[SPEC_STACK_SIZE] = pipelineForm_.stackEntries;
    constants[SPEC_STACK_IN_REGISTERS] = pipelineForm_.stackInRegisters ? 1 : 0;
    constants[SPEC_WATCHED] = pipelineForm_.watched ? 1 : 0;
    constants[SPEC_STEP_BY_STEP] = variant_.stepByStep ? 1 : 0;
    constants[SPEC_NODE_WIDTH] = pipelineForm_.nodeWidth;
    constants[SPEC_ORDER] = options_.traversalOrder;
    constants[SPEC_MATH] = math_;
    constants[SPEC_FEATURES] = pipelineFeatures_;
    constants[SPEC_RESUMES] = resumes ? 1 : 0;
    constants[SPEC_UNIFORMS_HIDDEN] = compilesForUniforms(context_->physical.driver) ? 1 : 0;
    request.spirv = foldedKernel(request.name, constants);
    ComputePipeline pipeline = createComputePipeline(*context_, request);
    statistics_.pipelines++;
    returnFreedMemory();  // the driver's compiler leaves some 60 MB
    return pipeline;
}

ResumablePipeline VulkanDevice::makeResumable(const char* kernel, uint32_t bindingCount, uint32_t pushConstantBytes)
{
    return ResumablePipeline([=, this](bool resumes) {
        return makePipeline(kernel, bindingCount, pushConstantBytes, resumes);
    });
}

void VulkanDevice::preparePipeline(bool texel, uint32_t features, const WalkForm& form)
{
    if (pipelineForm_ == form && pipelineTexel_ == texel && pipelineFeatures_ == features)
        return;
    pipelineForm_ = form;
    pipelineTexel_ = texel;
    pipelineFeatures_ = features;
    statistics_.walksWatched = form.watched;
    firstHitsPipeline_ = {};
    firstHitsBound_ = false;
    tracePipeline_ = {};
    adaptive_ = {};
    try {
        makePathPipelines();
    } catch (...) {
        pipelineForm_ = {};
        throw;
    }
}

/// What takes paths to their ends, in the way of the variant or the nearest that device and scene allow: whole paths
/// where the device binds too few buffers for waves.
void VulkanDevice::makePathPipelines()
{
    pipeline_ = {};
    bound_ = false;
    waves_.reset();
    Variant made = variant_;
    made.texelBuffers = pipelineTexel_;
    made.stackInRegisters = pipelineForm_.stackInRegisters;
    if (!haveStorageBuffers(WAVE_STORAGE_BUFFERS)) made.paths = Variant::Paths::whole;
    if (made.paths == Variant::Paths::waves && !context_->physical.subgroupBallots)
        made.paths = Variant::Paths::sharedWaves;
    statistics_.variant = nameOf(made);
    if (made.paths == Variant::Paths::whole) {
        pipeline_ = makeResumable("path", BINDING_COUNT, sizeof(Dispatch));
        return;
    }
    auto make = [this](const char* kernel, uint32_t bindings, bool resumes) {
        return makePipeline(kernel, bindings, sizeof(WaveDispatch), resumes);
    };
    const bool ballots = made.paths == Variant::Paths::waves;
    const WaveSetup setup = {ballots, group_[0] * group_[1], pipelineForm_.stackEntries, threads_, options_.waveSlots};
    waves_ = std::make_unique<VulkanWaves>(*context_, setup, make, work_, statistics_);
}

void VulkanDevice::prepareTileBuffers(size_t pixels)
{
    uint64_t pixelBytes = pixels * sizeof(PixelBlock);
    uint64_t suspendedBytes = pixels * sizeof(SuspendedPath);
    if (pixels_.bytes >= pixelBytes && suspended_.bytes >= suspendedBytes) return;
    ahead_.drain();
    bound_ = false;
    firstHitsBound_ = false;
    pixels_ = {};
    suspended_ = {};
    VkBufferUsageFlags usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    pixels_ = createBuffer(*context_, {"pixels", pixelBytes, usage, HostUse::readBack});
    suspended_ = createBuffer(*context_, {"suspended", suspendedBytes, usage, HostUse::none});
}

/// Whether a kernel can bind so many storage buffers besides those of the scene.
bool VulkanDevice::haveStorageBuffers(uint32_t ofKernel) const
{
    uint32_t storageBuffers = (pipelineTexel_ ? 0 : SCENE_BUFFER_COUNT - 1) + ofKernel;
    return storageBuffers <= context_->physical.properties.limits.maxPerStageDescriptorStorageBuffers;
}

/// Throws noDevice where it cannot.
void VulkanDevice::requireStorageBuffers(uint32_t ofKernel, const char* purpose) const
{
    uint32_t storageBuffers = (pipelineTexel_ ? 0 : SCENE_BUFFER_COUNT - 1) + ofKernel;
    uint32_t allowed = context_->physical.properties.limits.maxPerStageDescriptorStorageBuffers;
    if (!haveStorageBuffers(ofKernel))
        throw Error(ErrorKind::noDevice,
                    fmt::format("'{}' binds {} storage buffers at once; {} {}; try --device cpu",
                                context_->physical.name, allowed, purpose, storageBuffers));
}

void VulkanDevice::prepareFirstHits(size_t pixels)
{
    requireStorageBuffers(3, "albedo, normals and the like need");
    if (firstHitsPipeline_.name.empty())
        firstHitsPipeline_ = makePipeline("first_hits", BINDING_FIRST_HITS + 1, sizeof(Dispatch), true);
    if (firstHits_.bytes >= pixels * sizeof(FirstHits)) return;
    firstHitsBound_ = false;
    firstHits_ = {};
    firstHits_ = createBuffer(*context_, {"first hits", pixels * sizeof(FirstHits),
                                          VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, HostUse::readBack});
}

void VulkanDevice::bindAll(ComputePipeline& pipeline)
{
    std::array<const Buffer*, BINDING_FIRST_HITS + 1> buffers = {};
    for (uint32_t i = 0; i < SCENE_BUFFER_COUNT; i++) buffers[i] = &scene_->arrays[i];
    buffers[BINDING_FRAME] = &scene_->frame;
    buffers[BINDING_PIXELS] = &pixels_;
    buffers[BINDING_SUSPENDED] = &suspended_;
    buffers[BINDING_FIRST_HITS] = &firstHits_;
    bindBuffers(*context_, pipeline, std::span(buffers).first(pipeline.bindings.size()));
}

void VulkanDevice::requireTile(const TileRequest& tile, size_t blockCount) const
{
    uint64_t pixels = uint64_t{tile.width} * tile.height;
    auto allowed = context_->physical.properties.limits.maxComputeWorkGroupCount;
    bool groupsFit = (tile.width + group_[0] - 1) / group_[0] <= allowed[0] &&
                     (tile.height + group_[1] - 1) / group_[1] <= allowed[1];
    bool samplesFit = tile.sampleCount >= 1 && tile.sampleCount <= BLOCK_SIZE &&
                      tile.firstSample % BLOCK_SIZE == 0;
    if (!scene_ || pixels == 0 || pixels != blockCount || pixels > maxTilePixels() || !groupsFit ||
        !samplesFit)
        throw usageError("{}: not a tile that '{}' can render (scene set: {}, blocks: {}, most "
                         "pixels: {}, workgroups of {}x{})",
                         nameOf(tile), context_->physical.name, scene_ != nullptr, blockCount,
                         maxTilePixels(), group_[0], group_[1]);
}

void VulkanDevice::render(const TileRequest& tile, std::span<PixelBlock> blocks)
{
    auto start = std::chrono::steady_clock::now();
    requireTile(tile, blocks.size());
    if (waves_) {
        waves_->render(nameOf(tile), tile, blocks);
    } else {
        renderWhole(tile, blocks);
    }
    expected_.reset();
    statistics_.renderSeconds += secondsSince(start);
}

/// Tiles are begun ahead where the device computes elsewhere than the host, and one submission is enough.
bool VulkanDevice::mayBeginAhead(const TileRequest& tile) const
{
    const uint64_t pixels = uint64_t{tile.width} * tile.height;
    if (pixels * sizeof(PixelBlock) > pixels_.bytes) return false;
    const bool gains = context_->physical.kind != "software" && work_.fitOneSubmission(pixels, tile.sampleCount);
    return gains || options_.beginsAhead;
}

void VulkanDevice::renderWhole(const TileRequest& tile, std::span<PixelBlock> blocks)
{
    prepareTileBuffers(blocks.size());
    if (!bound_) {
        ahead_.drain();
        bindAll(pipeline_.get());
    }
    bound_ = true;
    active_ = &pipeline_.get();
    if (!mayBeginAhead(tile)) return renderBlocks(tile, blocks);
    if (expected_ && !mayBeginAhead(*expected_)) expected_.reset();
    const auto record = [this](VkCommandBuffer commands, const TileRequest& begun) {
        recordSamples(commands, begun, begun.sampleCount, true);
    };
    const double seconds = ahead_.render(tile, expected_, pixels_, record, blocks);
    statistics_.tilesBegunAhead = ahead_.taken();
    work_.noteSubmission(blocks.size(), tile.sampleCount, seconds);
    // What the tile was to go on with, the next one has overwritten
    if (stateOf(blocks, tile.sampleCount, threads_).samplesMissing > 0) renderBlocks(tile, blocks);
}

void VulkanDevice::renderFirstHits(const TileRequest& tile, std::span<FirstHits> pixels)
{
    requireTile(tile, pixels.size());
    prepareTileBuffers(pixels.size());
    prepareFirstHits(pixels.size());
    if (!firstHitsBound_) bindAll(firstHitsPipeline_);
    firstHitsBound_ = true;
    active_ = &firstHitsPipeline_;
    std::vector<PixelBlock> blocks(pixels.size());  // who has how many samples
    renderBlocks(tile, blocks);
    runCommands(*context_, "read first hits", [&](VkCommandBuffer commands) {
        recordReadBack(commands, firstHits_, pixels.size_bytes());
    });
    readBuffer(firstHits_, std::as_writable_bytes(pixels));
}

double VulkanDevice::traceRays(std::span<const TraceRay> rays, bool anyHit, std::span<TraceHit> hits)
{
    ahead_.drain();
    if (!scene_ || hits.size() != rays.size())
        throw usageError("trace rays on '{}': {} rays, room for {} hits (scene set: {})",
                         context_->physical.name, rays.size(), hits.size(), scene_ != nullptr);
    requireStorageBuffers(3, "rays of the host need");
    if (tracePipeline_.get().name.empty())
        tracePipeline_ = makeResumable(TRACE_KERNEL, BINDING_RAY_WALKS + 1, sizeof(TraceDispatch));
    return traceRaysOnVulkan({*context_, tracePipeline_, *scene_, work_, statistics_, pipelineForm_.stackEntries,
                              group_[0] * group_[1]},
                             rays, anyHit, hits);
}

std::unique_ptr<AdaptivePicture> VulkanDevice::beginAdaptive(const AdaptiveWindow& window,
                                                             const AdaptiveRule& rule)
{
    ahead_.drain();
    if (!scene_) throw usageError("adaptive sampling on '{}' without a scene", context_->physical.name);
    if (!adaptive_) {
        ResumablePipeline path = makeResumable("adaptive_path", BINDING_COUNT, sizeof(AdaptiveDispatch));
        adaptive_ = std::make_unique<AdaptivePipelines>(
            makeAdaptivePipelines(*context_, std::move(path), group_, math_));
    }
    auto prepareTile = [this](TileRequest tile) {
        ahead_.drain();
        tile.firstSample = 0;
        tile.sampleCount = 1;
        size_t pixels = size_t{tile.width} * tile.height;
        requireTile(tile, pixels);
        prepareTileBuffers(pixels);
    };
    AdaptiveHost host = {*context_, *adaptive_,  *scene_,        suspended_,
                         work_,     statistics_, pipelineForm_.stackEntries, prepareTile};
    return makeVulkanAdaptivePicture(host, window, rule);
}

void VulkanDevice::renderBlocks(const TileRequest& tile, std::span<PixelBlock> blocks)
{
    ahead_.drain();
    RoundState state = runRound(tile, tile.sampleCount, true, blocks);
    work_.finish({nameOf(tile), scene_->stepsPerSample, pipelineForm_.stackEntries}, state, [&](uint32_t samples) {
        if (active_ == &pipeline_.get() && pipeline_.resume()) bindAll(pipeline_.get());
        return runRound(tile, samples, false, blocks);
    });
}

/// Gives every pixel up to so many samples and reads the blocks back. `begin`: the tile's blocks are cleared before.
RoundState VulkanDevice::runRound(const TileRequest& tile, uint32_t samples, bool begin,
                                  std::span<PixelBlock> blocks)
{
    work_.runInParts(blocks.size(), samples, [&](uint32_t count, bool isFirst, bool isLast) {
        submit(tile, count, begin && isFirst, isLast);
    });
    readBuffer(pixels_, std::as_writable_bytes(blocks));
    return stateOf(blocks, tile.sampleCount, threads_);
}

/// Records dispatches that give every pixel up to so many samples. `begin`: the tile's blocks are cleared before.
void VulkanDevice::recordSamples(VkCommandBuffer commands, const TileRequest& tile, uint32_t samples, bool begin)
{
    Dispatch job = {};
    job.tileX = tile.x;
    job.tileY = tile.y;
    job.tileWidth = tile.width;
    job.tileHeight = tile.height;
    job.firstSample = tile.firstSample;
    job.sampleCount = tile.sampleCount;
    job.stepBudget = statistics_.stepBudget;
    job.samplesAtOnce = std::min(samples, variant_.samplesAtOnce);
    const uint32_t dispatches = (samples + job.samplesAtOnce - 1) / job.samplesAtOnce;
    statistics_.dispatches += dispatches;
    std::array<uint32_t, 3> groups = {(tile.width + group_[0] - 1) / group_[0],
                                      (tile.height + group_[1] - 1) / group_[1], 1};
    if (begin) {
        uint64_t bytes = uint64_t{tile.width} * tile.height * sizeof(PixelBlock);
        vkCmdFillBuffer(commands, pixels_.handle.get(), 0, bytes, 0);
        recordBarrier(commands, TRANSFER_WRITE, COMPUTE_USE);
    }
    for (uint32_t i = 0; i < dispatches; i++) {
        if (i > 0) recordBarrier(commands, COMPUTE_WRITE, COMPUTE_USE);
        recordDispatch(commands, *active_, std::as_bytes(std::span(&job, 1)), groups);
    }
}

void VulkanDevice::submit(const TileRequest& tile, uint32_t samples, bool begin, bool end)
{
    runCommands(*context_, nameOf(tile), [&](VkCommandBuffer commands) {
        recordSamples(commands, tile, samples, begin);
        // Commands submitted later see only what a barrier made visible.
        if (end)
            recordReadBack(commands, pixels_, uint64_t{tile.width} * tile.height * sizeof(PixelBlock));
        else
            recordBarrier(commands, COMPUTE_WRITE, COMPUTE_USE);
    });
}

}  // namespace

std::unique_ptr<Device> makeVulkanDevice(uint32_t index, const DeviceOptions& options)
{
    std::shared_ptr<Instance> instance = openInstance(options.validation);
    std::vector<PhysicalDevice> devices = physicalDevices(*instance);
    if (index >= devices.size())
        throw Error(ErrorKind::noDevice,
                    fmt::format("there is no Vulkan device {}: {} found", index, devices.size()));
    std::string why = whyUnusable(devices[index]);
    if (!why.empty())
        throw Error(ErrorKind::noDevice, fmt::format("device {}, '{}', cannot be used: {}", index,
                                                     devices[index].name, why));
    return std::make_unique<VulkanDevice>(openContext(instance, devices[index]), options);
}

uint64_t validationMessageCount()
{
    return vulkanMessageCount();
}

}  // namespace sahl
