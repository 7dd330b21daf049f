#include "device/vulkan_scene.h"

#include "device/scene_reads.h"
#include "device/vulkan_limits.h"
#include "device/walked_tree.h"
#include "shared/bindings.h"

#include <limits>

namespace sahl {

namespace {

using SceneArrays = std::array<std::span<const std::byte>, SCENE_BUFFER_COUNT>;

/// Appends the array, filled up to whole elements of the table, and returns where it begins [16 bytes].
template <class T>
uint32_t appendTable(std::vector<std::byte>& tables, std::span<const T> array)
{
    constexpr size_t ELEMENT = 16;
    const size_t begin = tables.size() / ELEMENT;
    const auto bytes = std::as_bytes(array);
    tables.insert(tables.end(), bytes.begin(), bytes.end());
    tables.resize((tables.size() + ELEMENT - 1) / ELEMENT * ELEMENT);
    return static_cast<uint32_t>(begin);
}

/// The arrays that share a buffer, one behind the other; `frame` says where each begins.
std::vector<std::byte> joinTables(const DeviceScene& scene, Frame& frame)
{
    std::vector<std::byte> tables;
    frame.lightsAt = appendTable(tables, scene.lights);
    frame.aliasAt = appendTable(tables, scene.aliasEntries);
    frame.texturesAt = appendTable(tables, scene.textures);
    frame.textureTexelsAt = appendTable(tables, scene.textureTexels);
    return tables;
}

SceneArrays sceneArrays(const DeviceScene& scene, std::span<const std::byte> tables, uint32_t nodeWidth)
{
    SceneArrays arrays;
    arrays[BINDING_NODES] = nodeWidth == 4 ? std::as_bytes(scene.wide.nodes) : std::as_bytes(scene.nodes);
    arrays[BINDING_PRIMITIVES] = std::as_bytes(scene.primitives);
    arrays[BINDING_CORNERS] = std::as_bytes(scene.triangleCorners);
    arrays[BINDING_MATERIALS] = std::as_bytes(scene.materials);
    arrays[BINDING_TABLES] = tables;
    arrays[BINDING_PROBE] = std::as_bytes(scene.probeTexels);
    arrays[BINDING_INSTANCES] = std::as_bytes(scene.instances);
    return arrays;
}

// A path has two rays a bounce, or under phong one for each light.
uint64_t mostRaysPerSample(const DeviceScene& scene)
{
    if (scene.frame.integrator == INTEGRATOR_PHONG) return 1 + uint64_t{scene.frame.lightCount};
    return 2 * (uint64_t{scene.frame.maxBounces} + 2);
}

// A ray visits each node and each triangle at most once, or once for each instance.
uint64_t mostStepsPerSample(const DeviceScene& scene)
{
    uint64_t rays = mostRaysPerSample(scene);
    // The binary nodes may be gone where the wide ones are walked; of these, any reference is met once.
    const uint64_t nodes = std::max<uint64_t>(2 * scene.nodes.size(), 4 * scene.wide.nodes.size());
    uint64_t once = nodes + scene.primitives.size() + 16;
    uint64_t visits = scene.instances.size() + 1;
    constexpr uint64_t MOST = std::numeric_limits<uint64_t>::max();
    return once > MOST / rays / visits ? MOST : rays * once * visits;
}

void requireMemory(const PhysicalDevice& device, uint64_t bytes)
{
    uint64_t heap = mainHeapBytes(device);
    if (bytes > heap)
        throw Error(ErrorKind::deviceLost,
                    fmt::format("the scene needs {} on '{}', which has {} of memory; try a smaller "
                                "scene or --device cpu",
                                bytesText(bytes), device.name, bytesText(heap)));
}

Buffer uploadArray(Context& context, const std::string& name, VkBufferUsageFlags usage,
                   std::span<const std::byte> data)
{
    Buffer buffer = createBuffer(context, {name, data.size(), usage, HostUse::upload});
    writeBuffer(context, buffer, data);
    return buffer;
}

}  // namespace

VulkanScene uploadScene(Context& context, const DeviceScene& given, const BufferChoice& buffers,
                        uint32_t nodeWidth)
{
    const DeviceScene scene = walkedScene(given, nodeWidth);
    Frame frame = scene.frame;
    const std::vector<std::byte> tables = joinTables(scene, frame);
    SceneArrays arrays = sceneArrays(scene, tables, nodeWidth);
    SceneBytes bytes = {};
    VulkanScene result;
    result.bytes = sizeof(Frame);
    for (uint32_t i = 0; i < SCENE_BUFFER_COUNT; i++) {
        bytes[i] = arrays[i].size();
        result.bytes += bytes[i];
    }
    result.texel = chooseTexelBuffers(context.physical, bytes, buffers);
    result.stepsPerSample = mostStepsPerSample(scene);
    result.turnsPerSample = mostRaysPerSample(scene) + scene.frame.lightCount;
    requireMemory(context.physical, result.bytes);

    const SceneReads reads = sceneReads(context.physical, result.texel);
    for (uint32_t i = 0; i < SCENE_BUFFER_COUNT; i++)
        result.arrays.push_back(uploadArray(context, sceneArrayName(i), usageFor(arrayType(reads, i)), arrays[i]));
    result.frame = uploadArray(context, "frame", VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
                               std::as_bytes(std::span(&frame, 1)));
    return result;
}

}  // namespace sahl
