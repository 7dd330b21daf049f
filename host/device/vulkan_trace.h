// Rays given by the host, traced on Vulkan: see Device::traceRays.
#pragma once

#include "device/bounded_work.h"
#include "device/resumable.h"
#include "device/scene_reads.h"
#include "device/vulkan_scene.h"

namespace sahl {

constexpr const char* TRACE_KERNEL = "trace_rays";

/// Rays are read as most arrays of the scene are.
inline VkDescriptorType raysType(SceneReads reads) { return arrayType(reads, BINDING_MATERIALS); }

/// What tracing needs of the device that it runs on.
struct TraceHost {
    Context& context;
    ResumablePipeline& pipeline;  ///< kernels/trace_rays.comp, for the scene and stack in force
    const VulkanScene& scene;
    BoundedWork& work;
    DeviceStatistics& statistics;
    uint32_t stackSize = 0;
    uint32_t groupSize = 0;  ///< invocations of a workgroup
};

/// The seconds that the dispatches took [s].
double traceRaysOnVulkan(const TraceHost& host, std::span<const TraceRay> rays, bool anyHit,
                         std::span<TraceHit> hits);

}  // namespace sahl
