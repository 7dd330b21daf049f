// The primitives of a glTF file's meshes: triangles of one material, and where their numbers are.
#pragma once

#include "scene/gltf_model.h"

namespace sahl {

// primitive.mode; those below are points and lines
constexpr uint32_t GLTF_TRIANGLES = 4;
constexpr uint32_t GLTF_TRIANGLE_STRIP = 5;
constexpr uint32_t GLTF_TRIANGLE_FAN = 6;

/// A part of a mesh with one material.
struct GltfPart {
    std::string what;  ///< "primitive 2 of mesh 3", for messages
    uint32_t mode = GLTF_TRIANGLES;
    uint32_t material = 0;  ///< index in model.materials
    const GltfAccessor* indices = nullptr;
    const GltfAccessor* positions = nullptr;  ///< null: nothing is shown
    const GltfAccessor* normals = nullptr;
    const GltfAccessor* texCoords = nullptr;  ///< of the set that the material uses
};

/// The parts of one of "meshes": all accessors are of a kind that their use allows, and those of
/// the vertices have equally many elements.
std::vector<GltfPart> readGltfParts(GltfModel& model, const JsonNode& node, size_t index);

/// Adds a part with positions and triangles to the mesh: the vertices that it uses, each once.
/// Throws badInput for indices without a vertex and vertices that are not finite.
void addGltfPart(GltfFile& file, const GltfPart& part, Mesh& mesh);

/// Triangles of a part; 0 for points, lines and those without positions.
uint64_t trianglesOf(const GltfPart& part);

}  // namespace sahl
