// Wavefront OBJ and MTL files.
#pragma once

#include "scene/mesh.h"
#include "scene/mtl_map.h"
#include "scene/path_policy.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sahl {

/// What Sahl uses of an MTL material.
struct ObjMaterial {
    std::string name;
    vec3 baseColor = vec3(0.7f);  ///< Kd, clamped to [0,1]; grey where the file gives none, 1
                                  ///< where it gives a map_Kd alone
    vec3 emission = vec3(0.0f);   ///< Ke [W m^-2 sr^-1]; 1 where there is a map_Ke alone
    std::optional<float> roughness = std::nullopt;  ///< Pr, clamped to [0,1]
    std::optional<float> metallic = std::nullopt;   ///< Pm, clamped to [0,1]
    double opacity = 1;                             ///< d, clamped to [0,1]; counts with map_d alone
    MtlMaps maps = {};

    // For the phong integrator alone
    std::optional<vec3> ambientColor = std::nullopt;  ///< Ka, clamped to [0,1]
    vec3 specularColor = vec3(0.0f);                  ///< Ks, clamped to [0,1]
    std::optional<float> shininess = std::nullopt;    ///< Ns, clamped to [0, MAX_SHININESS]
};

struct ObjFile {
    Mesh mesh;                           ///< triangles[i].material is an index in `materials`
    std::vector<ObjMaterial> materials;  ///< those in use; "default" for faces without one
};

/// Reads an OBJ file and the MTL files it names. Polygons are cut into triangles.
/// Throws badInput naming file and line: a number that is not finite, an index out of range, a
/// malformed statement, no faces at all. Warns once per kind about what it leaves out or replaces:
/// faces with fewer than 3 corners, lines and points, unknown statements, missing materials.
ObjFile readObj(const fs::path& file, const PathPolicy& policy);

/// Reads the materials of an MTL file into `materials`; a name that is there already stays. Pictures are
/// named but not read.
void readMtl(const fs::path& file, const PathPolicy& policy, std::map<std::string, ObjMaterial>& materials);

}  // namespace sahl
