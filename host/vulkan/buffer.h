// Buffers with their memory, and the two ways between host and device: directly where the memory
// is visible to the host, through a staging buffer where it is not.
#pragma once

#include "vulkan/context.h"

#include <cstddef>
#include <span>

namespace sahl {

/// What the host does with a buffer after it is made.
enum class HostUse {
    none,      ///< only the device reads and writes it
    upload,    ///< the host writes it, seldom
    readBack,  ///< the host writes and reads it, often
};

struct BufferRequest {
    std::string name;              ///< for messages
    uint64_t bytes = 0;            ///< 0 makes a buffer of 16 bytes, since Vulkan has no empty ones
    VkBufferUsageFlags usage = 0;  ///< transfer bits are added as needed
    HostUse hostUse = HostUse::none;
};

/// Keeps account of what a context has allocated from one of its heaps.
class HeapShare {
public:
    HeapShare() = default;
    HeapShare(uint64_t& inUse, uint64_t bytes) : inUse_(&inUse), bytes_(bytes) { inUse += bytes; }
    HeapShare(HeapShare&& other) noexcept { swap(other); }
    HeapShare& operator=(HeapShare&& other) noexcept
    {
        HeapShare moved(std::move(other));
        swap(moved);
        return *this;
    }
    ~HeapShare()
    {
        if (inUse_) *inUse_ -= bytes_;
    }

private:
    void swap(HeapShare& other)
    {
        std::swap(inUse_, other.inUse_);
        std::swap(bytes_, other.bytes_);
    }
    uint64_t* inUse_ = nullptr;
    uint64_t bytes_ = 0;
};

struct Buffer {
    std::string name;
    uint64_t bytes = 0;
    VkBufferUsageFlags usage = 0;
    HeapShare share;
    Owned<VkDeviceMemory> memory;
    Owned<VkBuffer> handle;
    Owned<VkBufferView> texels;       ///< of texel buffers: RGBA32UI over the whole buffer
    std::byte* mapped = nullptr;      ///< the memory itself, where the host may use it well
    std::unique_ptr<Buffer> staging;  ///< of readBack buffers that are not mapped
};

/// Makes a buffer. Sizes are compared with the device's limits first: throws noDevice when a limit
/// of one buffer is too small and deviceLost when memory is short, both with the numbers.
Buffer createBuffer(Context& context, const BufferRequest& request);

/// Throws what createBuffer would throw because of a limit of the device for one buffer.
void requireBufferLimits(const PhysicalDevice& device, const BufferRequest& request);

/// Writes `data` to the start of a buffer (upload or readBack) and waits until it is there.
void writeBuffer(Context& context, Buffer& buffer, std::span<const std::byte> data);

/// At the end of a command buffer: makes what compute shaders wrote to the first `bytes` of a
/// readBack buffer readable by readBuffer() after the commands have run.
void recordReadBack(VkCommandBuffer commands, const Buffer& buffer, uint64_t bytes);
void readBuffer(const Buffer& buffer, std::span<std::byte> data, uint64_t offset = 0);

}  // namespace sahl
