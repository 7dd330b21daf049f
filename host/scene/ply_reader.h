// PLY files (Stanford triangle format): text and binary, of either byte order.
#pragma once

#include "scene/mesh.h"
#include "util/files.h"

namespace sahl {

/// Reads positions and, where there are nx, ny and nz, normals and, where there are u and v (or s and t, or
/// texture_u and texture_v), texture coordinates from the element "vertex", polygons
/// from "face" (cut into triangles) and strips of triangles from "tristrips". All triangles have
/// material 0. Throws badInput naming file and line or byte: see readPlyHeader and PlyBody; a
/// coordinate that is not finite, an index out of range, no faces at all. Warns once per kind about
/// what it leaves out: faces with fewer than 3 corners, other elements and properties.
Mesh readPly(const fs::path& file);

}  // namespace sahl
