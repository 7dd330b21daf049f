// The pictures that MTL files name: statements such as "map_Kd -s 2 2 -clamp on wood.png".
#pragma once

#include "scene/path_policy.h"
#include "scene/statements.h"
#include "scene/texture.h"

#include <optional>
#include <set>
#include <string>

namespace sahl {

/// A picture with the options in front of it, as far as Sahl uses them.
struct MtlMap {
    fs::path file;
    std::string where;                 ///< of the statement, for messages
    glm::dvec2 scale = {1, 1};         ///< -s: times the texture coordinates ...
    glm::dvec2 offset = {0, 0};        ///< -o: ... plus this
    bool clamps = false;               ///< -clamp on
    double strength = 1;               ///< -bm, of normal maps
    std::optional<char> channel = {};  ///< -imfchan, of maps that are a number: r, g, b, m or l
};

/// Reads the statement. Options of the format that change nothing here (-blendu, -boost, -mm, -t,
/// ...) go into `unused`. Throws badInput naming file and line for options that are not known,
/// values that do not fit, and a file that is not named or lies outside of what the policy permits.
MtlMap readMtlMap(const Statement& statement, const PathPolicy& policy,
                  std::set<std::string>& unused);

/// The pictures of a material; those that belong together become one texture.
struct MtlMaps {
    std::optional<MtlMap> color;      ///< map_Kd
    std::optional<MtlMap> alpha;      ///< map_d
    std::optional<MtlMap> emission;   ///< map_Ke
    std::optional<MtlMap> normal;     ///< norm
    std::optional<MtlMap> roughness;  ///< map_Pr
    std::optional<MtlMap> metallic;   ///< map_Pm
};

/// Gives the material the textures of the maps; their files are read. `opacity` (d) counts with
/// map_d: where their product is below one half there is no surface. Throws badInput when a file is
/// missing or damaged, and when two maps that have to share a texture differ in size or options.
void applyMtlMaps(Scene& scene, const MtlMaps& maps, double opacity, Material& material);

}  // namespace sahl
