// Mesh files of any kind that is read, chosen by the end of their name.
#pragma once

#include "scene/obj_reader.h"

namespace sahl {

/// ".obj", ".ply" or another extension, in lower case; of a gzip file the one before ".gz".
std::string meshExtension(const fs::path& file);

bool isMeshFile(const fs::path& file);

/// Reads an OBJ or PLY file; the latter has one grey material. Throws as readObj and readPly do,
/// and badInput for files of another kind.
ObjFile readMeshFile(const fs::path& file, const PathPolicy& policy);

}  // namespace sahl
