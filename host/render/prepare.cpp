#include "render/prepare.h"

namespace sahl {

namespace {

DeviceScene ownArrays(const Scene& scene, const Bvh& bvh)
{
    DeviceScene view;
    view.nodes = bvh.nodes;
    view.primitives = bvh.primitives;
    view.triangleNormals = scene.triangleNormals;
    view.materials = scene.materials;
    view.lights = scene.lights;
    return view;
}

}  // namespace

DeviceScene PreparedScene::deviceScene() const
{
    DeviceScene view = borrowed ? *borrowed : ownArrays(scene, bvh);
    if (!borrowed || !scene.probeTexels.empty()) view.probeTexels = scene.probeTexels;
    view.treeDepth = bvh.statistics.depth;
    view.frame.camera = scene.camera;
    view.frame.probe = scene.probe;
    view.frame.background = scene.background.value_or(scene.probe);
    view.frame.width = scene.settings.width;
    view.frame.height = scene.settings.height;
    view.frame.seed = scene.settings.seed;
    view.frame.maxBounces = scene.settings.maxBounces;
    view.frame.rootRef = bvh.rootRef;
    view.frame.lightCount = static_cast<uint>(view.lights.size());
    view.frame.integrator = scene.settings.integrator;
    view.frame.jitter = scene.settings.jitter ? 1 : 0;
    view.frame.ambient = scene.settings.ambient;
    view.frame.shading = scene.settings.shading;
    return view;
}

PreparedScene prepareScene(Scene scene, BvhBuild build, unsigned threads)
{
    PreparedScene prepared;
    prepared.bvh = buildBvh(scene.primitives, build, threads);
    prepared.scene = std::move(scene);
    prepared.scene.primitives = {};
    return prepared;
}

}  // namespace sahl
