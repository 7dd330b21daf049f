// Paths in waves on Vulkan: short kernels that take all paths under way one ray further, in place of one kernel that takes
// each path to its end (shared/wave_types.h). The host sends off many waves at a time and looks at one count after them.
#pragma once

#include "device/bounded_work.h"
#include "device/vulkan_scene.h"
#include "shared/wave_types.h"
#include "vulkan/pipeline.h"

namespace sahl {

struct WavePipelines {
    ComputePipeline plan;    ///< kernels/wave_plan.comp
    ComputePipeline trace;   ///< kernels/wave_trace.comp, for the scene and stack in force, like the next two
    ComputePipeline shade;   ///< kernels/wave_shade.comp
    ComputePipeline film;    ///< kernels/wave_film.comp
    uint32_t groupSize = 0;  ///< invocations of a workgroup
    uint32_t stackSize = 0;
};

/// `make`: the pipeline of a kernel for the scene and stack in force, with so many bindings.
WavePipelines makeWavePipelines(Context& context, const std::function<ComputePipeline(const char*, uint32_t)>& make,
                                bool ballots, const std::array<uint32_t, 2>& group, uint32_t stackSize);

/// Storage buffers that a kernel of waves binds, besides those of the scene.
constexpr uint32_t WAVE_STORAGE_BUFFERS = 7;

/// Renders tiles of a scene.
class VulkanWaves {
public:
    /// `slots`: paths under way at a time, 0 for as many as suit the device. The rest must outlive this.
    VulkanWaves(Context& context, WavePipelines pipelines, uint32_t slots, BoundedWork& work,
                DeviceStatistics& statistics);

    /// One that the pipelines are made for; must stay until the next or the end.
    void setScene(const VulkanScene& scene);

    /// See Device::render. `name` is the tile's, for messages.
    void render(const std::string& name, const TileRequest& tile, std::span<PixelBlock> blocks);

private:
    struct Buffers {
        Buffer queues, samples, paths, rays, hits, walks, stacks, pixels;
        uint32_t slots = 0;
        size_t pixelCount = 0;
    };

    void prepareBuffers(size_t pixels);
    void bindAll();
    WaveDispatch jobOf(const TileRequest& tile) const;
    void submitWaves(const WaveDispatch& job, uint32_t count, bool begin, bool clearFaults, bool end);
    RoundState runWaves(const WaveDispatch& job, uint32_t count, bool begin);
    void finishWaves(const BoundedTask& task, const WaveDispatch& job);
    RoundState addToBlocks(const WaveDispatch& job, std::span<PixelBlock> blocks);

    Context& context_;
    WavePipelines pipelines_;
    const VulkanScene* scene_ = nullptr;
    uint32_t slotLimit_;
    BoundedWork& work_;
    DeviceStatistics& statistics_;
    Buffers buffers_;
    bool bound_ = false;           // the pipelines' descriptor sets hold them and the scene
    WaveCounts counts_ = {};       // as last read
    std::string name_;             // of the tile under way
    double wavesPerFilling_ = 2;   // that samples as many as the slots need, as last seen
};

}  // namespace sahl
