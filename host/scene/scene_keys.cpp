#include "scene/scene_keys.h"

#include "util/error.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace sahl {

namespace {

/// Words that people coming from other programs may try, and ours for them.
const std::vector<std::pair<std::string, std::string>> SYNONYMS = {
    {"color", "baseColor"},
    {"colour", "baseColor"},
    {"albedo", "baseColor"},
    {"diffuse", "baseColor"},
    {"reflectance", "baseColor"},
    {"kd", "baseColor"},
    {"emit", "emission"},
    {"radiance", "emission"},
    {"ke", "emission"},
    {"position", "eye"},
    {"origin", "eye"},
    {"from", "eye"},
    {"location", "eye"},
    {"target", "lookAt"},
    {"to", "lookAt"},
    {"at", "lookAt"},
    {"look_at", "lookAt"},
    {"fov", "fovDeg"},
    {"spp", "samplesPerPixel"},
    {"samples", "samplesPerPixel"},
    {"maxDepth", "maxBounces"},
    {"max_depth", "maxBounces"},
    {"depth", "maxBounces"},
    {"background", "environment"},
    {"probe", "environment"},
    {"env", "environment"},
    {"sky", "environment"},
    {"objects", "shapes"},
    {"meshes", "shapes"},
    {"geometry", "shapes"},
    {"filename", "file"},
    {"path", "file"},
    {"vertices", "positions"},
    {"faces", "indices"},
    {"translation", "translate"},
    {"rotation", "rotateDeg"},
    {"rotate", "rotateDeg"},
    {"image", "film"},
    {"resolution", "film"},
    {"power", "intensity"},
    {"bsdf", "material"},
};

}  // namespace

const std::vector<KeySet>& sceneKeys()
{
    static const std::vector<KeySet> keys = {
        {"scene",
         {"$schema", "description", "camera", "film", "integrator", "materials", "shapes", "lights",
          "environment"},
         {}},
        {"camera", {"eye", "lookAt", "up", "fovDeg", "fovAxis"}, {"eye", "lookAt"}},
        {"film", {"width", "height"}, {}},
        {"integrator", {"type", "maxBounces", "samplesPerPixel", "seed"}, {}},
        {"material", {"type", "baseColor", "emission"}, {"type"}},
        {"pointLight", {"type", "position", "intensity"}, {"type", "position", "intensity"}},
        {"environment", {"file", "mapping", "filter", "radiance", "builtin"}, {}},
        {"transform", {"matrix", "scale", "rotateDeg", "translate"}, {}},
        {"rotation", {"axis", "angle"}, {"axis", "angle"}},
        {"mesh", {"type", "file", "material", "smoothNormals", "transform"}, {"type", "file"}},
        {"triangles",
         {"type", "positions", "indices", "normals", "smoothNormals", "material", "transform"},
         {"type", "positions", "indices"}},
        {"teapot", {"type", "subdivisions", "smooth", "material", "transform"}, {"type"}},
        {"sphereMesh",
         {"type", "center", "radius", "level", "smooth", "material", "transform"},
         {"type"}},
        {"rectangle",
         {"type", "corner", "edgeU", "edgeV", "material", "transform"},
         {"type", "corner", "edgeU", "edgeV"}},
        {"disk",
         {"type", "center", "normal", "radius", "segments", "material", "transform"},
         {"type", "radius"}},
    };
    return keys;
}

const KeySet& keysOf(std::string_view object)
{
    const auto& all = sceneKeys();
    auto found = std::find_if(all.begin(), all.end(),
                              [&](const KeySet& set) { return set.object == object; });
    assert(found != all.end());
    return *found;
}

std::string suggestKey(const std::string& unknown, const KeySet& known)
{
    for (const auto& [word, ours] : SYNONYMS) {
        bool fits = std::find(known.keys.begin(), known.keys.end(), ours) != known.keys.end();
        if (word == unknown && fits) return ours;
    }
    return suggestion(unknown, known.keys);
}

}  // namespace sahl
