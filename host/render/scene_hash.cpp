#include "render/scene_hash.h"

#include "util/hash.h"

namespace sahl {

namespace {

template <class T>
uint64_t hashOfOne(const T& value)
{
    return hashOfBytes(std::as_bytes(std::span(&value, 1)));
}

/// The length goes first, so that no element can pass for one of the next array.
template <class T>
void addArray(Hash& hash, std::span<const T> array)
{
    const uint64_t count = array.size();
    hash.add(std::as_bytes(std::span(&count, 1)));
    hash.add(std::as_bytes(array));
}

/// Does not depend on their order, which is the tree's.
uint64_t hashOfAll(std::span<const Primitive> primitives)
{
    uint64_t sum = primitives.size();
    for (const Primitive& primitive : primitives) sum += hashOfOne(primitive);
    return sum;
}

Frame withoutSettings(Frame frame)
{
    frame.width = frame.height = 0;
    frame.seed = frame.maxBounces = 0;
    frame.integrator = frame.shading = 0;
    frame.samplerKind = frame.rouletteDepth = frame.lightSampling = 0;
    frame.clampIndirect = 0;
    // What follows from the rest, by how lights are sampled
    frame.singleCount = frame.choiceCount = frame.clusterCount = 0;
    frame.lightPerPower = frame.probeMean = 0;
    frame.probeSlope = vec3(0);
    frame.rootRef = 0;
    return frame;
}

/// Those that follow them are shapes, which the primitives tell.
std::vector<Light> lightsOfFile(const DeviceScene& scene)
{
    const auto first = scene.lights.first(scene.frame.lightCount);
    std::vector<Light> lights(first.begin(), first.end());
    for (Light& light : lights) light.chance = 0;
    return lights;
}

uint64_t sceneHash(const DeviceScene& scene)
{
    Hash hash;
    const Frame frame = withoutSettings(scene.frame);
    const uint64_t primitives = hashOfAll(scene.primitives);
    hash.add(std::as_bytes(std::span(&frame, 1)));
    hash.add(std::as_bytes(std::span(&primitives, 1)));
    addArray(hash, scene.triangleCorners);
    addArray(hash, scene.materials);
    addArray(hash, std::span<const Light>(lightsOfFile(scene)));
    addArray(hash, scene.textures);
    addArray(hash, scene.textureTexels);
    addArray(hash, scene.probeTexels);
    std::vector<ObjectInstance> instances(scene.instances.begin(), scene.instances.end());
    for (ObjectInstance& instance : instances) instance.rootRef = 0;
    addArray(hash, std::span<const ObjectInstance>(instances));
    return hash.value();
}

uint64_t treeHash(const DeviceScene& scene)
{
    Hash hash;
    hash.add(std::as_bytes(std::span(&scene.frame.rootRef, 1)));
    addArray(hash, scene.nodes);
    addArray(hash, scene.primitives);
    addArray(hash, scene.instances);
    return hash.value();
}

}  // namespace

SceneHashes hashesOf(const DeviceScene& scene)
{
    return {sceneHash(scene), treeHash(scene)};
}

}  // namespace sahl
