// How the path tracing kernels fit a Vulkan device: which kind of buffer holds the scene, the shape
// of a workgroup, the size of the stack, and what the device lacks.
#pragma once

#include "device/device.h"
#include "shared/bindings.h"
#include "vulkan/physical_device.h"

#include <array>

namespace sahl {

/// Bytes of each of a scene's arrays, by binding.
using SceneBytes = std::array<uint64_t, SCENE_BUFFER_COUNT>;

/// Name of the array at a binding, for messages.
const char* sceneArrayName(uint32_t binding);

/// Empty, or why no kernel of ours can run on the device, whatever the scene.
std::string whyUnusable(const PhysicalDevice& device);

/// How a scene is to be read.
struct BufferChoice {
    DeviceOptions::Buffers wanted = DeviceOptions::Buffers::automatic;
    bool preferTexels = true;  ///< where `automatic` leaves the choice
};

/// True to read the scene through texel buffers, false for storage buffers: as wanted, else what is preferred when
/// every array fits, else the other.
/// Throws noDevice with the numbers when the forced kind, or both, cannot hold the scene.
bool chooseTexelBuffers(const PhysicalDevice& device, const SceneBytes& bytes,
                        const BufferChoice& choice);

/// Width and height of a workgroup: as wanted, halved until the device allows it.
std::array<uint32_t, 2> chooseGroupShape(const PhysicalDevice& device, uint32_t width,
                                         uint32_t height);

/// Smallest compiled stack that holds `treeDepth` entries. Throws badInput above MAX_STACK_SIZE.
uint32_t chooseStackSize(uint32_t treeDepth);

/// Steps one invocation takes a dispatch when the user named none.
uint32_t defaultStepBudget(const PhysicalDevice& device);

/// How many of buffers' elements of so many bytes fit a small share of the device's memory: 2^16 to `most`.
uint64_t bufferShare(const PhysicalDevice& device, uint64_t bytesEach, uint64_t most);

/// Largest tile [pixels]: bounded by the suspended paths, which must fit one storage buffer, and by the
/// workgroups of shape `group` that one dispatch may have in a row.
uint32_t tilePixelLimit(const PhysicalDevice& device, const std::array<uint32_t, 2>& group);

/// Largest number of pixels under adaptive sampling at a time: half of the device's memory, and estimates
/// of all of them in one buffer.
uint64_t adaptivePixelLimit(const PhysicalDevice& device);

}  // namespace sahl
