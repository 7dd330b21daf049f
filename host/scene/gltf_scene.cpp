#include "scene/gltf_scene.h"

#include "scene/camera.h"
#include "scene/mesh_file.h"
#include "scene/numbers.h"
#include "scene/phong.h"
#include "scene/scene_reading.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sahl {

namespace {

/// Adds the materials that the meshes use; NO_MATERIAL stands for the others.
std::vector<uint32_t> addMaterials(Scene& scene, const GltfModel& model, const GltfPlacing& placing)
{
    std::vector<uint32_t> indices(model.materials.size(), NO_MATERIAL);
    for (const GltfMesh& mesh : model.meshes) {
        for (const MeshTriangle& triangle : mesh.mesh.triangles) {
            uint32_t& index = indices[triangle.material];
            if (index != NO_MATERIAL) continue;
            index = placing.material
                        ? *placing.material
                        : addGltfMaterial(scene, model, model.materials[triangle.material]);
        }
    }
    return indices;
}

/// Moves what `fill` adds to scene.primitives into an object of its own; false when that is
/// nothing.
template <class Fill>
bool makeObject(Scene& scene, const Fill& fill)
{
    std::vector<Primitive> primitives = std::exchange(scene.primitives, {});
    std::vector<uint32_t> starts = std::exchange(scene.objectStarts, {});
    fill();
    std::swap(scene.primitives, primitives);
    std::swap(scene.objectStarts, starts);
    if (primitives.empty()) return false;
    scene.objects.push_back(std::move(primitives));
    return true;
}

void addInstances(Scene& scene, const GltfMesh& mesh, const GltfPlacing& placing,
                  const std::string& name, uint64_t& instances)
{
    for (const Transform& place : mesh.places) {
        const Transform whole = compose(placing.transform, place);
        Placement placement;
        placement.linear = whole.linear;
        placement.translation = whole.translation;
        placement.object = static_cast<uint>(scene.objects.size() - 1);
        if (!isPlaceable(placement)) {
            warn(fmt::format(
                "{}: a place where it is stretched or shrunk by more than {:g} was left out", name,
                LARGEST_STRETCH));
            continue;
        }
        if (++instances > placing.instancesLeft)
            throw badInput("{}: more than {} instances", name, MAX_INSTANCES);
        scene.instances.push_back(placement);
    }
}

/// Width and height of pictures through a camera that has its own proportions, as far as the
/// command line leaves them open: the longer side of the default size stays.
void setPictureSize(RenderSettings& settings, const SceneOptions& options, double aspect)
{
    if (options.width && options.height) return;
    auto side = [](double pixels) {
        return static_cast<uint32_t>(std::clamp(std::round(pixels), 1.0, double{MAX_PICTURE_SIDE}));
    };
    if (options.width || (!options.height && aspect >= 1))
        settings.height = side(settings.width / aspect);
    else
        settings.width = side(settings.height * aspect);
}

}  // namespace

bool isGltfFile(const fs::path& file)
{
    const std::string extension = meshExtension(file);
    return extension == ".gltf" || extension == ".glb";
}

uint64_t appendGltf(Scene& scene, const GltfModel& model, const GltfPlacing& placing)
{
    const std::string& file = model.file.document.file;
    const size_t primitivesBefore = scene.primitives.size();
    const uint64_t droppedBefore = scene.droppedTriangles;
    const std::vector<uint32_t> materials = addMaterials(scene, model, placing);
    uint64_t instances = 0;
    for (const GltfMesh& mesh : model.meshes) {
        const std::string name = fmt::format("{}: {}", file, mesh.what);
        Mesh smooth;
        if (placing.smoothNormals) {
            smooth = mesh.mesh;
            makeSmoothNormals(smooth);
        }
        const Mesh& shape = placing.smoothNormals ? smooth : mesh.mesh;
        auto append = [&](const Transform& transform) {
            appendMesh(scene, shape, transform, materials, name);
        };
        if (mesh.places.size() == 1)
            append(compose(placing.transform, mesh.places.front()));
        else if (makeObject(scene, [&] { append({}); }))
            addInstances(scene, mesh, placing, name, instances);
    }
    const uint64_t dropped = scene.droppedTriangles - droppedBefore;
    if (dropped > 0) warn(fmt::format("{}: left out {} triangles of zero area", file, dropped));
    if (scene.primitives.size() == primitivesBefore && instances == 0)
        throw badInput("{}: the scene of this file has no triangles", file);
    return instances;
}

Scene loadGltfScene(const fs::path& path, const SceneOptions& options)
{
    Scene scene;
    scene.name = path.string();
    if (options.probe) applyProbeOption(scene, options);
    sayThreadsMayStart(options);
    GltfModel model;
    readGltf(model, path, {folderOf(path), options.allowedPaths});
    applyOptions(scene.settings, options);
    if (!model.cameras.empty() && model.cameras.front().aspect)
        setPictureSize(scene.settings, options, *model.cameras.front().aspect);
    checkPictureSize(scene.settings, scene.name);
    appendGltf(scene, model, {.transform = {}, .smoothNormals = options.smoothNormals});
    scene.lights = model.lights;
    if (!options.probe && scene.lights.empty()) useStudioProbe(scene, options);
    if (model.cameras.size() > 1)
        warn(fmt::format("{}: {} cameras; the first is used", scene.name, model.cameras.size()));
    placeCamera(scene,
                model.cameras.empty() ? framePrimitives(scene) : model.cameras.front().description);
    if (scene.settings.integrator == INTEGRATOR_PHONG && scene.lights.empty()) addHeadLight(scene);
    return scene;
}

}  // namespace sahl
