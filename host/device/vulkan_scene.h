// A scene's arrays as buffers on a Vulkan device.
#pragma once

#include "device/vulkan_limits.h"
#include "vulkan/buffer.h"

namespace sahl {

struct VulkanScene {
    std::vector<Buffer> arrays;  ///< SCENE_BUFFER_COUNT of them, by binding
    Buffer frame;
    bool texel = false;           ///< texel buffers rather than storage buffers
    uint64_t bytes = 0;           ///< of all arrays and the frame
    uint64_t stepsPerSample = 0;  ///< traversal steps that no sample can need more of
    uint64_t turnsPerSample = 0;  ///< rays and lights that no sample can have more of
};

/// Copies the scene to the device. Throws noDevice when one of its arrays exceeds a limit of the
/// device, deviceLost when all together exceed its memory; nothing is allocated before both checks.
///   nodeWidth  of the trees that rays will walk; the others are left out
VulkanScene uploadScene(Context& context, const DeviceScene& scene, const BufferChoice& buffers,
                        uint32_t nodeWidth);

}  // namespace sahl
