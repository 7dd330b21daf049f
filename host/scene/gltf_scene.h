// glTF files as parts of scenes, or as scenes of their own.
#pragma once

#include "scene/gltf_model.h"

namespace sahl {

bool isGltfFile(const fs::path& file);

/// How a model becomes part of a scene.
struct GltfPlacing {
    Transform transform = {};
    bool smoothNormals = false;                       ///< make normals for meshes that have none
    std::optional<uint32_t> material = std::nullopt;  ///< index in scene.materials, of everything
    uint64_t instancesLeft = MAX_INSTANCES;
};

/// Adds the meshes of a model: to scene.primitives what is placed once, as objects with instances
/// what is placed several times. Returns the number of instances. Throws badInput when nothing is
/// left or there are too many of them.
uint64_t appendGltf(Scene& scene, const GltfModel& model, const GltfPlacing& placing);

/// Adds a material of the model and the textures that it uses; returns its index in
/// scene.materials.
uint32_t addGltfMaterial(Scene& scene, const GltfModel& model, const GltfMaterial& material);

/// A glTF file by itself: its first camera, or one that frames everything; its lights, or the
/// studio probe.
Scene loadGltfScene(const fs::path& path, const SceneOptions& options);

}  // namespace sahl
