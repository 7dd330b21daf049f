#include "vulkan/buffer.h"

#include "util/parallel.h"

#include <algorithm>
#include <cstring>
#include <optional>

namespace sahl {

namespace {

constexpr uint64_t EMPTY_BUFFER_BYTES = 16;  // one texel
constexpr uint64_t TEXEL_BYTES = 16;         // RGBA32UI
constexpr VkBufferUsageFlags TEXEL_USES =
    VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT;
constexpr uint64_t STAGING_BYTES = uint64_t{64} << 20;

// One core copies slower than memory allows, and a device waits meanwhile.
constexpr size_t COPY_BYTES = size_t{4} << 20;
constexpr unsigned COPY_THREADS = 4;

constexpr VkMemoryPropertyFlags LOCAL = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
constexpr VkMemoryPropertyFlags VISIBLE =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
constexpr VkMemoryPropertyFlags CACHED = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;

bool isStaging(const BufferRequest& request)
{
    return (request.usage &
            ~(VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT)) == 0;
}

// The first type with all `wanted` flags among those a buffer allows. With `heap`, in that heap
// only: many GPUs have a small window of device memory that the host sees and that should stay
// free.
std::optional<uint32_t> findMemoryType(const PhysicalDevice& device, uint32_t allowed,
                                       VkMemoryPropertyFlags wanted,
                                       std::optional<uint32_t> heap = {})
{
    for (uint32_t i = 0; i < device.memory.memoryTypeCount; i++) {
        const VkMemoryType& type = device.memory.memoryTypes[i];
        if ((allowed >> i & 1u) && (type.propertyFlags & wanted) == wanted &&
            (!heap || type.heapIndex == *heap))
            return i;
    }
    return {};
}

uint32_t chooseMemoryType(const PhysicalDevice& device, const BufferRequest& request,
                          uint32_t allowed)
{
    std::optional<uint32_t> type;
    if (isStaging(request)) {
        // Reading uncached memory is slow enough to matter; writing it is not.
        type = findMemoryType(device, allowed, VISIBLE | CACHED);
        if (!type) type = findMemoryType(device, allowed, VISIBLE);
    } else {
        uint32_t heap = mainHeap(device);
        if (request.hostUse != HostUse::none)
            type = findMemoryType(device, allowed, LOCAL | VISIBLE | CACHED, heap);
        if (!type && request.hostUse == HostUse::upload)
            type = findMemoryType(device, allowed, LOCAL | VISIBLE, heap);
        if (!type) type = findMemoryType(device, allowed, LOCAL, heap);
        if (!type) type = findMemoryType(device, allowed, 0);
    }
    if (!type)
        throw Error(ErrorKind::noDevice,
                    fmt::format("buffer '{}': '{}' offers no memory for it; try "
                                "--device cpu",
                                request.name, device.name));
    return *type;
}

void requireHeapSpace(const Context& context, const BufferRequest& request, uint64_t bytes,
                      uint32_t heap)
{
    uint64_t heapBytes = context.physical.memory.memoryHeaps[heap].size;
    uint64_t inUse = context.heapBytesInUse[heap];
    if (bytes <= heapBytes && inUse <= heapBytes - bytes) return;
    throw Error(ErrorKind::deviceLost,
                fmt::format("buffer '{}': needs {} on '{}', which has {} of device memory with {} "
                            "of it in use here; try a smaller scene or --device cpu",
                            request.name, bytesText(bytes), context.physical.name,
                            bytesText(heapBytes), bytesText(inUse)));
}

VkBufferUsageFlags fullUsage(const BufferRequest& request)
{
    VkBufferUsageFlags usage = request.usage;
    if (request.hostUse != HostUse::none) usage |= VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    if (request.hostUse == HostUse::readBack) usage |= VK_BUFFER_USAGE_TRANSFER_SRC_BIT;
    return usage;
}

void createHandle(Context& context, const BufferRequest& request, Buffer& buffer)
{
    auto info = vulkanStruct<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
    info.size = buffer.bytes;
    info.usage = buffer.usage;
    info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
    VkBuffer handle = VK_NULL_HANDLE;
    check(vkCreateBuffer(context.device, &info, nullptr, &handle),
          "create buffer '{}' of {} on '{}'", request.name, bytesText(buffer.bytes),
          context.physical.name);
    buffer.handle = {context, handle, vkDestroyBuffer};
}

void allocateMemory(Context& context, const BufferRequest& request, Buffer& buffer)
{
    const PhysicalDevice& device = context.physical;
    VkMemoryRequirements needs = {};
    vkGetBufferMemoryRequirements(context.device, buffer.handle.get(), &needs);
    uint32_t type = chooseMemoryType(device, request, needs.memoryTypeBits);
    uint32_t heap = device.memory.memoryTypes[type].heapIndex;
    requireHeapSpace(context, request, needs.size, heap);

    auto info = vulkanStruct<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
    info.allocationSize = needs.size;
    info.memoryTypeIndex = type;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    check(vkAllocateMemory(context.device, &info, nullptr, &memory),
          "allocate {} for buffer '{}' on '{}', which has {} with {} in use here",
          bytesText(needs.size), request.name, device.name,
          bytesText(device.memory.memoryHeaps[heap].size), bytesText(context.heapBytesInUse[heap]));
    buffer.memory = {context, memory, vkFreeMemory};
    buffer.share = {context.heapBytesInUse[heap], needs.size};
    check(vkBindBufferMemory(context.device, buffer.handle.get(), memory, 0),
          "bind memory of buffer '{}' on '{}'", request.name, device.name);

    VkMemoryPropertyFlags flags = device.memory.memoryTypes[type].propertyFlags;
    VkMemoryPropertyFlags direct =
        request.hostUse == HostUse::readBack ? VISIBLE | CACHED : VISIBLE;
    bool wantsHost = request.hostUse != HostUse::none || isStaging(request);
    if (!wantsHost || (!isStaging(request) && (flags & direct) != direct)) return;
    void* address = nullptr;
    check(vkMapMemory(context.device, memory, 0, VK_WHOLE_SIZE, 0, &address),
          "map {} of buffer '{}' on '{}'", bytesText(needs.size), request.name, device.name);
    buffer.mapped = static_cast<std::byte*>(address);
}

void createTexelView(Context& context, const BufferRequest& request, Buffer& buffer)
{
    auto info = vulkanStruct<VkBufferViewCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO);
    info.buffer = buffer.handle.get();
    info.format = VK_FORMAT_R32G32B32A32_UINT;
    info.range = VK_WHOLE_SIZE;
    VkBufferView view = VK_NULL_HANDLE;
    check(vkCreateBufferView(context.device, &info, nullptr, &view),
          "create texel view of buffer '{}' on '{}'", request.name, context.physical.name);
    buffer.texels = {context, view, vkDestroyBufferView};
}

BufferRequest stagingRequest(const Buffer& buffer, uint64_t bytes)
{
    BufferRequest request;
    request.name = buffer.name + " (staging)";
    request.bytes = bytes;
    request.usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    return request;
}

void copyThroughStaging(Context& context, Buffer& buffer, Buffer& staging,
                        std::span<const std::byte> data)
{
    for (uint64_t done = 0; done < data.size();) {
        uint64_t part = std::min<uint64_t>(staging.bytes, data.size() - done);
        std::memcpy(staging.mapped, data.data() + done, part);
        runCommands(
            context, fmt::format("upload buffer '{}'", buffer.name), [&](VkCommandBuffer c) {
                VkBufferCopy region = {0, done, part};
                vkCmdCopyBuffer(c, staging.handle.get(), buffer.handle.get(), 1, &region);
                recordBarrier(c, TRANSFER_WRITE,
                              {VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_ACCESS_MEMORY_READ_BIT});
            });
        done += part;
    }
}

}  // namespace

void requireBufferLimits(const PhysicalDevice& device, const BufferRequest& request)
{
    auto require = [&](uint64_t needed, uint64_t limit, const char* limitName) {
        if (needed > limit)
            throw Error(ErrorKind::noDevice,
                        fmt::format("buffer '{}': needs {}, '{}' allows {} ({}); try a smaller "
                                    "scene, another device or --device cpu",
                                    request.name, needed, device.name, limit, limitName));
    };
    const VkPhysicalDeviceLimits& limits = device.properties.limits;
    if (request.usage & VK_BUFFER_USAGE_STORAGE_BUFFER_BIT)
        require(request.bytes, limits.maxStorageBufferRange, "maxStorageBufferRange, bytes");
    if (request.usage & VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT)
        require(request.bytes, limits.maxUniformBufferRange, "maxUniformBufferRange, bytes");
    if (request.usage & TEXEL_USES)
        require(request.bytes / TEXEL_BYTES, limits.maxTexelBufferElements,
                "maxTexelBufferElements");
    require(request.bytes, device.maxAllocationBytes, "maxMemoryAllocationSize, bytes");
}

Buffer createBuffer(Context& context, const BufferRequest& request)
{
    requireBufferLimits(context.physical, request);
    Buffer buffer;
    buffer.name = request.name;
    buffer.bytes = std::max(request.bytes, EMPTY_BUFFER_BYTES);
    buffer.usage = fullUsage(request);
    if (!isStaging(request))
        requireHeapSpace(context, request, buffer.bytes, mainHeap(context.physical));
    createHandle(context, request, buffer);
    allocateMemory(context, request, buffer);
    if (request.usage & TEXEL_USES)
        createTexelView(context, request, buffer);
    if (request.hostUse == HostUse::readBack && !buffer.mapped)
        buffer.staging =
            std::make_unique<Buffer>(createBuffer(context, stagingRequest(buffer, buffer.bytes)));
    return buffer;
}

void writeBuffer(Context& context, Buffer& buffer, std::span<const std::byte> data)
{
    if (data.empty()) return;
    if (buffer.mapped) {
        std::memcpy(buffer.mapped, data.data(), data.size());
    } else if (buffer.staging) {
        copyThroughStaging(context, buffer, *buffer.staging, data);
    } else {
        Buffer staging = createBuffer(
            context, stagingRequest(buffer, std::min<uint64_t>(STAGING_BYTES, data.size())));
        copyThroughStaging(context, buffer, staging, data);
    }
}

void recordReadBack(VkCommandBuffer commands, const Buffer& buffer, uint64_t bytes)
{
    if (buffer.mapped) {
        recordBarrier(commands, COMPUTE_WRITE, HOST_READ);
        return;
    }
    recordBarrier(commands, COMPUTE_WRITE, TRANSFER_READ);
    VkBufferCopy region = {0, 0, bytes};
    vkCmdCopyBuffer(commands, buffer.handle.get(), buffer.staging->handle.get(), 1, &region);
    recordBarrier(commands, TRANSFER_WRITE, HOST_READ);
}

void readBuffer(const Buffer& buffer, std::span<std::byte> data, uint64_t offset)
{
    if (data.empty()) return;
    const std::byte* from = (buffer.mapped ? buffer.mapped : buffer.staging->mapped) + offset;
    const size_t parts = (data.size() + COPY_BYTES - 1) / COPY_BYTES;
    parallelFor(parts, std::min(COPY_THREADS, defaultThreadCount()), [&](size_t i) {
        const size_t first = i * COPY_BYTES;
        std::memcpy(data.data() + first, from + first, std::min(COPY_BYTES, data.size() - first));
    });
}

}  // namespace sahl
