// What Sahl uses of a glTF file, as plain data: meshes, where the scene places them, and the
// scene's cameras and lights.
#pragma once

#include "scene/gltf_file.h"
#include "scene/mesh.h"

namespace sahl {

/// A reference to a texture, with the map from the coordinates of the mesh to its own.
struct GltfTextureUse {
    uint32_t texture = 0;   ///< index in GltfModel::textures
    uint32_t texCoord = 0;  ///< which of the mesh's sets of coordinates
    glm::dmat2 linear = glm::dmat2(1.0);
    glm::dvec2 offset = glm::dvec2(0.0);
};

struct GltfMaterial {
    std::string name;
    glm::dvec3 baseColor = glm::dvec3(1.0);
    double metallic = 1;
    double roughness = 1;
    glm::dvec3 emission = glm::dvec3(0.0);  ///< factor times strength [W m^-2 sr^-1]
    double eta = 1.5;
    double transmission = 0;
    double alpha = 1;        ///< multiplied with that of the texture
    double alphaCutoff = 0;  ///< below: not there; 0: all is there
    std::optional<GltfTextureUse> baseColorTexture;
    std::optional<GltfTextureUse> roughnessTexture;  ///< green: roughness, blue: metallic
    std::optional<GltfTextureUse> normalTexture;
    std::optional<GltfTextureUse> emissionTexture;
    double normalStrength = 1;  ///< red and green of the normal texture count so many times

    std::array<const std::optional<GltfTextureUse>*, 4> textures() const
    {
        return {&baseColorTexture, &roughnessTexture, &normalTexture, &emissionTexture};
    }
};

/// A picture: a file, or bytes of a buffer.
struct GltfImage {
    std::string what;  ///< "model.glb: image 2", for messages
    fs::path file;
    std::span<const uint8_t> bytes;
};

struct GltfTexture {
    std::optional<uint32_t> image;  ///< none: of a kind that is not read
    bool clampS = false, clampT = false, nearest = false;
};

/// A mesh that is placed, at one place of the scene or several.
struct GltfMesh {
    std::string what;               ///< "mesh 3", for messages
    Mesh mesh;                      ///< its materials are indices in GltfModel::materials
    std::vector<Transform> places;  ///< to the space of the file
};

struct GltfCamera {
    CameraDescription description;
    std::optional<double> aspect;  ///< width over height
};

struct GltfModel {
    GltfFile file;  ///< holds the bytes of images
    std::vector<GltfMesh> meshes;
    std::vector<GltfMaterial> materials;  ///< the last is that of what names none
    std::vector<GltfTexture> textures;
    std::vector<GltfImage> images;
    std::vector<GltfCamera> cameras;  ///< of the scene, in the order of its tree
    std::vector<Light> lights;
};

/// Reads a .gltf or .glb file: its default scene, or the first. Throws badInput with file, line and
/// column; warns of what it leaves out.
void readGltf(GltfModel& model, const fs::path& path, const PathPolicy& policy);

// The parts of readGltf, in this order.

/// Fills model.images and model.textures.
void readGltfTextures(GltfModel& model);

/// Fills model.materials.
void readGltfMaterials(GltfModel& model);

/// A node's place in the world, and what is there.
struct GltfPlacedNode {
    Transform toWorld;
    std::optional<uint32_t> mesh, camera, light;
};

/// The nodes of the scene that have something, in the order of the tree.
std::vector<GltfPlacedNode> readGltfNodes(GltfFile& file);

/// Reads all "cameras" and fills model.cameras with those that are placed.
void readGltfCameras(GltfModel& model, std::span<const GltfPlacedNode> nodes);

/// The same of KHR_lights_punctual.
void readGltfLights(GltfModel& model, std::span<const GltfPlacedNode> nodes);

/// Checks all "meshes" and reads those that are placed.
void readGltfMeshes(GltfModel& model, std::span<const GltfPlacedNode> nodes);

/// Items of "cameras", "meshes", "lights" ... : how many there may be references to.
size_t countOf(const GltfFile& file, const std::string& key);
size_t lightCountOf(const GltfFile& file);

}  // namespace sahl
