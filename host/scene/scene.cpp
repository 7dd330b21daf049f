#include "scene/scene.h"

#include "bvh/box.h"
#include "scene/adaptive.h"
#include "scene/camera.h"
#include "scene/gltf_scene.h"
#include "scene/mesh_file.h"
#include "scene/primitives.h"
#include "scene/phong.h"
#include "scene/probe.h"
#include "scene/sampling.h"
#include "scene/scene_reading.h"

#include <algorithm>
#include <cmath>

namespace sahl {

namespace {

Scene loadMeshScene(const fs::path& path, const SceneOptions& options)
{
    Scene scene;
    scene.name = path.string();
    applyOptions(scene.settings, options);
    checkPictureSize(scene.settings, scene.name);
    if (options.probe)
        applyProbeOption(scene, options);
    else
        useStudioProbe(scene, options);
    sayThreadsMayStart(options);
    ObjFile obj = readMeshFile(path, {folderOf(path), options.allowedPaths});
    appendObj(scene, obj, {}, options.smoothNormals, scene.name);
    placeCamera(scene, framePrimitives(scene));
    if (scene.settings.integrator == INTEGRATOR_PHONG) addHeadLight(scene);
    return scene;
}

/// Tells about scenes that are legal and yet hardly what somebody wanted.
void warnAboutOddScene(const Scene& scene)
{
    float largest = 0;
    const Box box = extentOf(scene);
    for (const vec3& p : {box.lo, box.hi}) {
        if (box.lo.x <= box.hi.x)
            largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    if (largest > 1e9f) {
        warn(fmt::format(
            "{}: coordinates reach {:.3g} m; beyond 1e9 the squares of lengths leave the "
            "range of float32; scale the scene down",
            scene.name, largest));
    }
    bool hasEmitter =
        std::any_of(scene.materials.begin(), scene.materials.end(), [](const Material& m) {
            return m.emission.x > 0 || m.emission.y > 0 || m.emission.z > 0;
        });
    if (scene.settings.integrator == INTEGRATOR_PHONG) {
        warnAboutDarkPhong(scene);
    } else if (!hasEmitter && scene.lights.empty() && scene.probe.height == 0) {
        warn(fmt::format("{}: no light, no emission and no environment: the picture will be black",
                         scene.name));
    }
}

}  // namespace

void applyOptions(RenderSettings& settings, const SceneOptions& options)
{
    settings.width = options.width.value_or(settings.width);
    settings.height = options.height.value_or(settings.height);
    settings.spp = options.spp.value_or(settings.spp);
    settings.maxBounces = options.maxBounces.value_or(settings.maxBounces);
    settings.seed = options.seed.value_or(settings.seed);
    applyShadingOptions(settings, options);
    applySamplingOptions(settings, options);
    applyAdaptiveOptions(settings, options);
}

void applyProbeOption(Scene& scene, const SceneOptions& options)
{
    setProbe(scene, readImage(*options.probe),
             probeMapping(options.probeMapping.value_or("latlong")),
             probeFilter(options.probeFilter.value_or("bilinear")), options.probe->string());
}

void sayThreadsMayStart(const SceneOptions& options)
{
    if (options.onceThreadsMayStart) options.onceThreadsMayStart();
}

void useStudioProbe(Scene& scene, const SceneOptions& options)
{
    uint filter = probeFilter(options.probeFilter.value_or("bilinear"));
    setProbe(scene, makeStudioProbe(STUDIO_WIDTH, STUDIO_HEIGHT), PROBE_LATLONG, filter, "studio");
}

void checkPictureSize(const RenderSettings& settings, const std::string& name)
{
    uint64_t pixels = uint64_t{settings.width} * settings.height;
    bool fits = settings.width <= MAX_PICTURE_SIDE && settings.height <= MAX_PICTURE_SIDE &&
                pixels >= 1 && pixels <= MAX_PICTURE_PIXELS;
    if (!fits) {
        throw badInput(
            "{}: a picture of {} x {} pixels; each side must be 1 to {}, the product at most {}",
            name, settings.width, settings.height, MAX_PICTURE_SIDE, MAX_PICTURE_PIXELS);
    }
}

Box extentOf(const std::vector<Primitive>& primitives)
{
    Box box;
    for (const Primitive& primitive : primitives) grow(box, extentOf(primitive));
    return box;
}

Box extentOf(const Scene& scene)
{
    Box box = extentOf(scene.primitives);
    std::vector<Box> objects;
    for (const std::vector<Primitive>& object : scene.objects) objects.push_back(extentOf(object));
    for (const Placement& placement : scene.instances)
        grow(box, placedBox(placement, objects[placement.object]));
    return box;
}

Scene loadScene(const fs::path& path, const SceneOptions& options)
{
    std::string extension = meshExtension(path);
    if (extension != ".json" && !isMeshFile(path) && !isGltfFile(path)) {
        requireRegularFile(path);
        throw badInput("{}: \"{}\" files are not read; use .json (see scenes/README.md), .gltf, .glb, "
                       ".obj or .ply",
                       path.string(), extension);
    }
    Scene scene = isGltfFile(path)   ? loadGltfScene(path, options)
                  : isMeshFile(path) ? loadMeshScene(path, options)
                                     : loadJsonScene(path, options);
    warnAboutOddScene(scene);
    return scene;
}

Scene builtInScene(const SceneOptions& options)
{
    Scene scene;
    scene.name = "built-in scene";
    scene.settings.width = 320;
    scene.settings.height = 240;
    applyOptions(scene.settings, options);
    checkPictureSize(scene.settings, scene.name);
    uint32_t ground = addMaterial(scene, "ground", vec3(0.55f, 0.53f, 0.50f));
    uint32_t clay = addMaterial(scene, "clay", vec3(0.72f, 0.33f, 0.20f));
    uint32_t glaze = addMaterial(scene, "glaze", vec3(0.20f, 0.42f, 0.66f));
    uint32_t lamp = addMaterial(scene, "lamp", vec3(0.0f), vec3(9.0f, 8.2f, 7.0f));
    appendShape(scene, makeRectangle({-8, 0, 8}, {16, 0, 0}, {0, 0, -16}), {}, ground, "ground");
    appendShape(scene, makeSphere({-0.95, 1, 0}, 1, 3, true), {}, clay, "left sphere");
    appendShape(scene, makeSphere({1.1, 0.7, 0.6}, 0.7, 3, true), {}, glaze, "right sphere");
    appendShape(scene, makeRectangle({-1.2, 4, -1.2}, {1.6, 0, 0}, {0, 0, 1.6}), {}, lamp, "lamp");
    Light light = {};
    light.type = LIGHT_POINT;
    light.position = {3.5f, 3.0f, 3.0f};
    light.intensity = {6.0f, 6.5f, 7.5f};
    scene.lights.push_back(light);
    if (options.probe)
        applyProbeOption(scene, options);
    else
        useStudioProbe(scene, options);
    sayThreadsMayStart(options);
    CameraDescription camera;
    camera.eye = {0.6, 2.4, 6.5};
    camera.lookAt = {0, 0.9, 0};
    camera.fovDeg = 36;
    placeCamera(scene, camera);
    return scene;
}

}  // namespace sahl
