#include "render/prepare.h"

#include "device/scene_features.h"
#include "device/walked_tree.h"
#include "scene/probe_weights.h"

#include <algorithm>
#include <utility>

namespace sahl {

namespace {

/// With its memory, which `array = {}` would keep.
template <class T>
void letGo(std::vector<T>& array)
{
    array = std::vector<T>();
}

DeviceScene ownArrays(const Scene& scene, const Bvh& bvh)
{
    DeviceScene view;
    view.nodes = bvh.nodes;
    view.primitives = bvh.primitives;
    view.triangleCorners = scene.triangleCorners;
    view.materials = scene.materials;
    view.textures = scene.textures;
    view.textureTexels = scene.textureTexels;
    view.instances = bvh.instances;
    return view;
}

}  // namespace

DeviceScene PreparedScene::deviceScene() const
{
    DeviceScene view = borrowed ? *borrowed : ownArrays(scene, bvh);
    if (!borrowed || !scene.probeTexels.empty()) view.probeTexels = scene.probeTexels;
    view.lights = sceneLights();
    view.frame.lightCount = static_cast<uint>(view.lights.size());
    if (!lightTable.lights.empty()) view.lights = lightTable.lights;
    view.aliasEntries = lightTable.entries;
    view.frame.choiceCount = lightTable.choiceCount;
    view.frame.lightPerPower = lightTable.lightPerPower;
    view.frame.singleCount = lightTable.singleCount;
    view.frame.clusterCount = lightTable.clusterCount;
    view.frame.probeSlope = lightTable.probeSlope;
    view.frame.probeMean = lightTable.probeMean;
    view.treeDepth = bvh.statistics.depth;
    view.wide = {wide.nodes,  wide.instances, wide.rootRef,
                 wide.gridAt, wide.gridScale, wide.worstPending, wide.worstGroups};
    view.frame.camera = scene.camera;
    view.frame.probe = scene.probe;
    view.frame.background = scene.background.value_or(scene.probe);
    view.frame.width = scene.settings.width;
    view.frame.height = scene.settings.height;
    view.frame.seed = scene.settings.seed;
    view.frame.maxBounces = scene.settings.maxBounces;
    view.frame.rootRef = bvh.rootRef;
    view.frame.integrator = scene.settings.integrator;
    view.frame.jitter = scene.settings.jitter ? 1 : 0;
    view.frame.ambient = scene.settings.ambient;
    view.frame.shading = scene.settings.shading | (std::ranges::none_of(view.materials, shines) ? SHADING_DARK : 0);
    view.frame.samplerKind = scene.settings.samplerKind;
    view.frame.rouletteDepth = scene.settings.rouletteDepth;
    view.frame.clampIndirect = scene.settings.clampIndirect;
    view.frame.lightSampling = scene.settings.lightSampling;
    return view;
}

double reachOf(const Camera& camera)
{
    const glm::dvec3 lens = glm::abs(glm::dvec3(camera.lensRight)) + glm::abs(glm::dvec3(camera.lensDown));
    const glm::dvec3 across = glm::abs(glm::dvec3(camera.right)) + glm::abs(glm::dvec3(camera.down));
    const bool parallel = camera.type == CAMERA_ORTHOGRAPHIC;
    const glm::dvec3 p = glm::abs(glm::dvec3(camera.position)) + lens + (parallel ? across : glm::dvec3(0.0));
    return std::max({p.x, p.y, p.z});
}

void prepareWideTrees(PreparedScene& prepared)
{
    const DeviceScene scene = prepared.deviceScene();
    prepared.wide = widen(scene.nodes, scene.instances, scene.frame.rootRef, reachOf(scene.frame.camera));
}

void prepareLights(PreparedScene& prepared)
{
    prepared.lightTable = {};
    const DeviceScene scene = prepared.deviceScene();
    prepared.lightTable = makeLightTable(scene);
    const auto masses = std::exchange(prepared.lightTable.texelMasses, {});
    if (masses.empty() || hasTexelWeights(scene.frame.probe, masses, scene.probeTexels)) return;
    std::vector<vec4>& texels = prepared.scene.probeTexels;
    // Those of a mapped file cannot be written to
    if (texels.empty()) texels.assign(scene.probeTexels.begin(), scene.probeTexels.end());
    writeTexelWeights(scene.frame.probe, masses, texels);
}

void dropUnwalkedTree(PreparedScene& prepared, uint32_t nodeWidth)
{
    if (walkFormFor(prepared.deviceScene(), nodeWidth, false).nodeWidth == 4)
        letGo(prepared.bvh.nodes);
}

PreparedScene prepareScene(Scene scene, BvhBuild build, unsigned threads)
{
    PreparedScene prepared;
    if (scene.instances.empty()) {
        prepared.bvh = buildBvh(std::move(scene.primitives), build, threads);
    } else {
        prepared.bvh = buildTwoLevels(scene.primitives, scene.objects, scene.instances,
                                      reachOf(scene.camera), build, threads);
    }
    prepared.scene = std::move(scene);
    letGo(prepared.scene.primitives);
    letGo(prepared.scene.objects);
    letGo(prepared.scene.instances);
    for (const ObjectInstance& instance : prepared.bvh.instances)
        prepared.scene.objectStarts.push_back(instance.firstNumber);
    prepareWideTrees(prepared);
    prepareLights(prepared);
    return prepared;
}

}  // namespace sahl
