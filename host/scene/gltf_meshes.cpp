// The meshes of a glTF file. All of them are checked; those that the scene places are read.
#include "scene/gltf_parts.h"
#include "util/memory.h"

namespace sahl {

namespace {

/// About what a triangle takes while it is read and once it is in the scene.
constexpr uint64_t BYTES_PER_TRIANGLE = 512;

/// Refuses what would not fit before any of it is made.
void requireRoom(const GltfFile& file, uint64_t triangles)
{
    const std::string name = file.document.file;
    if (triangles > MAX_PRIMITIVES)
        throw badInput("{}: {} triangles; at most {} can be rendered", name, triangles,
                       MAX_PRIMITIVES);
    requireMemory(triangles * BYTES_PER_TRIANGLE, fmt::format("{}: {} triangles", name, triangles),
                  "use a smaller model");
}

/// Whether alphaMode MASK cuts away all of what has the material.
bool isCutAway(const GltfMaterial& material)
{
    return !material.baseColorTexture && material.alpha < material.alphaCutoff;
}

void addParts(GltfModel& model, const std::vector<GltfPart>& parts, Mesh& mesh)
{
    GltfFile& file = model.file;
    for (const GltfPart& part : parts) {
        if (!part.positions)
            leaveOut(file, "a primitive without positions is left out");
        else if (part.mode < GLTF_TRIANGLES)
            leaveOut(file, "points and lines are left out");
        else if (!isCutAway(model.materials[part.material]))
            addGltfPart(file, part, mesh);
    }
}

}  // namespace

void readGltfMeshes(GltfModel& model, std::span<const GltfPlacedNode> nodes)
{
    GltfFile& file = model.file;
    const auto& items = itemsOf(file.root(), "meshes");
    std::vector<std::vector<GltfPart>> meshes;
    for (size_t i = 0; i < items.size(); i++) meshes.push_back(readGltfParts(model, items[i], i));

    std::vector<std::vector<Transform>> places(meshes.size());
    for (const GltfPlacedNode& node : nodes) {
        if (!node.mesh) continue;
        if (determinant(node.toWorld) != 0)
            places[*node.mesh].push_back(node.toWorld);
        else
            leaveOut(file, "a mesh at a node that flattens space is left out");
    }
    uint64_t triangles = 0;
    for (size_t i = 0; i < meshes.size(); i++) {
        for (const GltfPart& part : meshes[i])
            triangles += places[i].empty() ? 0 : trianglesOf(part);
    }
    requireRoom(file, triangles);
    for (size_t i = 0; i < meshes.size(); i++) {
        if (places[i].empty()) continue;
        GltfMesh mesh{fmt::format("mesh {}", i), {}, std::move(places[i])};
        addParts(model, meshes[i], mesh.mesh);
        if (!mesh.mesh.triangles.empty()) model.meshes.push_back(std::move(mesh));
    }
}

void readGltf(GltfModel& model, const fs::path& path, const PathPolicy& policy)
{
    readGltfFile(model.file, path, policy);
    readGltfTextures(model);
    readGltfMaterials(model);
    const std::vector<GltfPlacedNode> nodes = readGltfNodes(model.file);
    readGltfCameras(model, nodes);
    readGltfLights(model, nodes);
    readGltfMeshes(model, nodes);
    tellOmissions(model.file);
}

}  // namespace sahl
