// Adaptive sampling on Vulkan: a tile's pixels, its queues and its film live on the device.
#pragma once

#include "device/bounded_work.h"
#include "device/resumable.h"
#include "device/vulkan_scene.h"

namespace sahl {

struct AdaptivePipelines {
    ResumablePipeline path;  ///< kernels/adaptive_path.comp
    ComputePipeline pass;    ///< kernels/adaptive_pass.comp
    ComputePipeline decide;  ///< kernels/adaptive_decide.comp
    uint32_t groupSize = 0;  ///< invocations of a workgroup
};

/// `path`: the pipeline of adaptive_path for the scene and stack in force.
AdaptivePipelines makeAdaptivePipelines(Context& context, ResumablePipeline path,
                                        const std::array<uint32_t, 2>& group, uint32_t math);

/// What all tiles share of the device that makes them; must outlive them. beginTile() calls
/// `prepareTile` first: it throws when the device cannot render such a tile, and makes room in
/// `suspended`.
struct AdaptiveHost {
    Context& context;
    AdaptivePipelines& pipelines;
    const VulkanScene& scene;
    const Buffer& suspended;  ///< room for a path of each pixel of a tile; free between two passes
    BoundedWork& work;
    DeviceStatistics& statistics;
    uint32_t stackSize = 0;
    std::function<void(const TileRequest&)> prepareTile;
};

std::unique_ptr<AdaptivePicture> makeVulkanAdaptivePicture(const AdaptiveHost& host,
                                                           const AdaptiveWindow& window,
                                                           const AdaptiveRule& rule);

}  // namespace sahl
