// Procedural meshes. All use + - * / sqrt alone, so they are the same everywhere.
#pragma once

#include "scene/mesh.h"

namespace sahl {

/// The Utah teapot: 64 n^2 - 8 n triangles for n = subdivisions >= 2 of a patch's edge. It stands
/// on y = 0, axis +Y, spout towards +X: 6.5 wide, 3.15 high, 4 deep.
///   smooth  corner normals of the curved surface itself
Mesh makeTeapot(uint32_t subdivisions, bool smooth);

/// A sphere of 20 * 4^level triangles, from an icosahedron.
Mesh makeSphere(const glm::dvec3& center, double radius, uint32_t level, bool smooth);

/// The parallelogram corner + [0,1] edgeU + [0,1] edgeV; its front is where edgeU x edgeV points.
/// Texture coordinates are the shares of the edges.
Mesh makeRectangle(const glm::dvec3& corner, const glm::dvec3& edgeU, const glm::dvec3& edgeV);

/// A disk of `segments` triangles around its centre, inscribed in the circle. Texture coordinates: the
/// circle is inscribed in the picture.
Mesh makeDisk(const glm::dvec3& center, const glm::dvec3& normal, double radius, uint32_t segments);

constexpr uint32_t MAX_TEAPOT_SUBDIVISIONS = 128;
constexpr uint32_t MAX_SPHERE_LEVEL = 9;
constexpr uint32_t MAX_DISK_SEGMENTS = 65536;

}  // namespace sahl
