#include "scene/mesh_file.h"

#include "scene/ply_reader.h"
#include "util/error.h"
#include "util/gzip.h"

namespace sahl {

std::string meshExtension(const fs::path& file)
{
    std::string extension = withoutGz(file).extension().string();
    for (char& c : extension) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return extension;
}

bool isMeshFile(const fs::path& file)
{
    const std::string extension = meshExtension(file);
    return extension == ".obj" || extension == ".ply";
}

ObjFile readMeshFile(const fs::path& file, const PathPolicy& policy)
{
    const std::string extension = meshExtension(file);
    if (extension == ".obj") return readObj(file, policy);
    if (extension == ".ply") return {readPly(file), {{"default"}}};
    requireRegularFile(file);
    throw badInput("{}: \"{}\" is no kind of mesh that is read; use .obj, .ply, .gltf or "
                   ".glb, also as .gz",
                   file.string(), extension);
}

}  // namespace sahl
