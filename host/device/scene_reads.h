// How kernels read the arrays of a scene.
#pragma once

#include "device/driver_habits.h"
#include "shared/bindings.h"
#include "vulkan/physical_device.h"

namespace sahl {

/// Through texel buffers; the same, but nodes and primitives through images; through storage buffers.
enum class SceneReads { texels, images, storage };

/// Images where texel buffers are chosen and the driver is faster with images, and has them.
inline SceneReads sceneReads(const PhysicalDevice& device, bool texelBuffers)
{
    constexpr uint32_t IMAGES = 2;
    if (!texelBuffers) return SceneReads::storage;
    const bool haveImages = device.rgba32uiImageBuffers &&
                            device.properties.limits.maxPerStageDescriptorStorageImages >= IMAGES;
    return haveImages && callsForTexels(device.driver) ? SceneReads::images : SceneReads::texels;
}

/// What the names of kernels that read so end in.
inline const char* suffixOf(SceneReads reads)
{
    if (reads == SceneReads::texels) return "_texel";
    return reads == SceneReads::images ? "_image" : "_storage";
}

/// Of the array at a binding below SCENE_BUFFER_COUNT.
inline VkDescriptorType arrayType(SceneReads reads, uint32_t binding)
{
    if (binding == BINDING_INSTANCES) return VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
    if (reads == SceneReads::storage) return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    const bool ofTree = binding == BINDING_NODES || binding == BINDING_PRIMITIVES;
    return ofTree && reads == SceneReads::images ? VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER
                                                 : VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
}

/// What a buffer bound so must be made for.
inline VkBufferUsageFlags usageFor(VkDescriptorType type)
{
    if (type == VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER) return VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
    if (type == VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER) return VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT;
    return VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
}

}  // namespace sahl
