// Paths in waves on Vulkan: short kernels that take all paths under way one ray further, in place
// of one kernel that takes each path to its end (shared/wave_types.h). The host sends off many
// waves at a time and looks at one count after them.
#pragma once

#include "device/bounded_work.h"
#include "device/resumable.h"
#include "device/vulkan_scene.h"
#include "shared/wave_types.h"

namespace sahl {

/// Storage buffers that a kernel of waves binds, besides those of the scene.
constexpr uint32_t WAVE_STORAGE_BUFFERS = 7;

struct WaveSetup {
    bool ballots = false;    ///< queues are filled by them, else by shared memory
    uint32_t groupSize = 0;  ///< invocations of a workgroup
    uint32_t stackSize = 0;
    unsigned threads = 1;  ///< of the host
    uint32_t slots = 0;  ///< paths under way at a time; 0: as many as suit the device
};

/// Makes the pipeline of a kernel for the scene and stack in force, with so many bindings and
/// SPEC_RESUMES.
using MakeWavePipeline =
    std::function<ComputePipeline(const char* kernel, uint32_t bindings, bool resumes)>;

/// Renders tiles of a scene.
class VulkanWaves {
public:
    /// `work` and `statistics` must outlive this, and what `make` refers to.
    VulkanWaves(Context& context, const WaveSetup& setup, const MakeWavePipeline& make,
                BoundedWork& work, DeviceStatistics& statistics);

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

    enum class Clear { nothing, faults, all };

    void prepareBuffers(size_t pixels);
    void bindAll();
    WaveDispatch jobOf(const TileRequest& tile) const;
    void submitWaves(const WaveDispatch& job, uint32_t count, Clear clear, bool end);
    RoundState runWaves(const WaveDispatch& job, uint32_t count, bool begin);
    void finishWaves(const BoundedTask& task, const WaveDispatch& job);
    RoundState addToBlocks(const WaveDispatch& job, std::span<PixelBlock> blocks);

    Context& context_;
    WaveSetup setup_;
    BoundedWork& work_;
    DeviceStatistics& statistics_;
    ComputePipeline plan_, begin_, shade_, film_;  // kernels/wave_*.comp
    ResumablePipeline trace_;                      // likewise
    uint32_t slotLimit_;
    const VulkanScene* scene_ = nullptr;
    Buffers buffers_;
    bool bound_ = false;          // the pipelines' descriptor sets hold the buffers and the scene
    WaveCounts counts_ = {};      // as last read
    std::string name_;            // of the tile under way
    double wavesPerFilling_ = 2;  // that samples as many as the slots need, as last seen
};

}  // namespace sahl
