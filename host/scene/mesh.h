// Primitive meshes before they become part of a scene: shared corners, in the shape's own space.
#pragma once

#include "scene/scene.h"
#include "scene/transform.h"

#include <array>
#include <span>
#include <vector>

namespace sahl {

constexpr uint32_t NO_UV = 0xffffffffu;

/// Indices into the mesh's arrays. Counter-clockwise seen from the front.
struct MeshTriangle {
    std::array<uint32_t, 3> position;
    std::array<uint32_t, 3> normal = {SHAPE_FLAT, SHAPE_FLAT, SHAPE_FLAT};  ///< per corner
    uint32_t material = 0;  ///< index in the mesh's own list of materials
    std::array<uint32_t, 3> uv = {NO_UV, NO_UV, NO_UV};  ///< per corner; without: (0, 0)
};

struct Mesh {
    std::vector<vec3> positions;
    std::vector<vec3> normals;  ///< any length; of zero length or not finite: as if absent
    std::vector<vec2> uvs;      ///< texture coordinates, v up
    std::vector<MeshTriangle> triangles;
};

/// Gives normals to all corners without one: the mean of the facets that meet at the position,
/// weighted by area. Corners at equal positions count as one, so seams of texture coordinates do
/// not show.
void makeSmoothNormals(Mesh& mesh);

/// Appends the transformed mesh to the scene. A mirroring transform flips the winding, so that
/// fronts stay fronts. Triangles of zero area are left out, counted in scene.droppedTriangles.
/// Texture coordinates are kept if the scene has textures by now: see usesTextures.
///   materials  for each material of the mesh its index in scene.materials
///   returns    number of triangles left out
/// Throws badInput naming `name` when a coordinate overflows or MAX_PRIMITIVES is exceeded.
uint64_t appendMesh(Scene& scene, const Mesh& mesh, const Transform& transform,
                    std::span<const uint32_t> materials, const std::string& name);

/// appendMesh with one material for everything, then a warning when triangles were left out.
void appendShape(Scene& scene, const Mesh& mesh, const Transform& transform, uint32_t material,
                 const std::string& name);

/// Appends an exact sphere. Throws badInput naming `name` when the radius is not positive as a
/// float, its box overflows or MAX_PRIMITIVES is exceeded.
void appendSphere(Scene& scene, const glm::dvec3& center, double radius, uint32_t material,
                  const std::string& name);

/// Adds a material and returns its index.
uint32_t addMaterial(Scene& scene, const std::string& name, const Material& material);

/// Adds a lambert material and returns its index.
uint32_t addMaterial(Scene& scene, const std::string& name, const vec3& baseColor,
                     const vec3& emission = vec3(0.0f));

}  // namespace sahl
