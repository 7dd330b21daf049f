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
    {"threshold", "epsilon"},
    {"minSpp", "minSamples"},
    {"maxSpp", "maxSamples"},
    {"spp", "samplesPerPixel"},
    {"samples", "samplesPerPixel"},
    {"maxDepth", "maxBounces"},
    {"max_depth", "maxBounces"},
    {"depth", "maxBounces"},
    {"rrDepth", "rouletteDepth"},
    {"roulette", "rouletteDepth"},
    {"clamp", "clampIndirect"},
    {"mis", "lightSampling"},
    {"strategy", "lightSampling"},
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
    {"power", "irradiance"},
    {"ior", "eta"},
    {"index", "eta"},
    {"tint", "baseColor"},
    {"k", "conductorK"},
    {"eta", "conductorEta"},
    {"aperture", "lensRadius"},
    {"focalDistance", "focusDistance"},
    {"focus", "focusOn"},
    {"cutoff", "outerDeg"},
    {"strength", "scale"},
    {"bsdf", "material"},
    {"children", "shapes"},
    {"object", "of"},
    {"group", "of"},
    {"ks", "specularColor"},
    {"specular", "specularColor"},
    {"ka", "ambientColor"},
    {"ns", "shininess"},
    {"exponent", "shininess"},
    {"alpha", "roughness"},
    {"metalness", "metallic"},
    {"roughnessFactor", "roughness"},
    {"metallicFactor", "metallic"},
    {"transmissionFactor", "transmission"},
    {"baseColorFactor", "baseColor"},
    {"texture", "baseColorTexture"},
    {"map", "baseColorTexture"},
    {"map_Kd", "baseColorTexture"},
    {"colorTexture", "baseColorTexture"},
    {"emissiveTexture", "emissionTexture"},
    {"metallicRoughnessTexture", "roughnessTexture"},
    {"normalMap", "normalTexture"},
    {"repeat", "scale"},
    {"texcoords", "uvs"},
    {"uv", "uvs"},
};

}  // namespace

const std::vector<KeySet>& sceneKeys()
{
    static const std::vector<KeySet> keys = {
        {"scene",
         {"$schema", "description", "camera", "film", "integrator", "materials", "groups", "shapes",
          "lights", "environment", "background"},
         {}},
        {"camera",
         {"type", "eye", "lookAt", "up", "fovDeg", "fovAxis", "lensRadius", "focusDistance",
          "focusOn"},
         {"eye", "lookAt"}},
        {"directionCamera",
         {"type", "position", "right", "up", "leftHanded", "fovRad", "lensRadius", "focusDistance",
          "focusOn"},
         {"position", "right", "up", "fovRad"}},
        {"orthographicCamera",
         {"type", "eye", "lookAt", "up", "height"},
         {"type", "eye", "lookAt", "height"}},
        {"film", {"width", "height", "jitter"}, {}},
        {"integrator",
         {"type", "maxBounces", "samplesPerPixel", "seed", "terms", "shadows", "normals",
          "ambient", "sampler", "rouletteDepth", "clampIndirect", "lightSampling", "adaptive"},
         {}},
        {"adaptive", {"rule", "epsilon", "targetError", "minSamples", "maxSamples"}, {"rule"}},
        {"lambertMaterial",
         {"type", "baseColor", "emission", "baseColorTexture", "alphaCutoff", "emissionTexture", "normalTexture", "specularColor", "shininess", "ambientColor"},
         {"type"}},
        {"mirrorMaterial",
         {"type", "baseColor", "emission", "baseColorTexture", "alphaCutoff", "emissionTexture", "normalTexture", "specularColor", "shininess", "ambientColor"},
         {"type"}},
        {"dielectricMaterial",
         {"type", "eta", "roughness", "baseColor", "emission", "roughnessTexture", "baseColorTexture", "alphaCutoff", "emissionTexture", "normalTexture", "specularColor", "shininess", "ambientColor"},
         {"type"}},
        {"thinDielectricMaterial",
         {"type", "eta", "baseColor", "emission", "baseColorTexture", "alphaCutoff", "emissionTexture", "normalTexture", "specularColor", "shininess", "ambientColor"},
         {"type"}},
        {"plasticMaterial",
         {"type", "baseColor", "eta", "roughness", "emission", "roughnessTexture", "baseColorTexture", "alphaCutoff", "emissionTexture", "normalTexture", "specularColor", "shininess",
          "ambientColor"},
         {"type"}},
        {"metallicRoughnessMaterial",
         {"type", "baseColor", "metallic", "roughness", "transmission", "eta", "emission", "roughnessTexture", "baseColorTexture", "alphaCutoff", "emissionTexture", "normalTexture",
          "specularColor", "shininess", "ambientColor"},
         {"type"}},
        {"conductorMaterial",
         {"type", "metal", "conductorEta", "conductorK", "roughness", "emission", "roughnessTexture", "emissionTexture", "normalTexture",
          "specularColor", "shininess", "ambientColor"},
         {"type"}},
        {"reportMaterial",
         {"type", "baseColor", "diffuseWeight", "specularWeight", "eta", "emission", "baseColorTexture", "alphaCutoff", "emissionTexture", "normalTexture",
          "specularColor", "shininess", "ambientColor"},
         {"type"}},
        {"colorTexture",
         {"file", "wrap", "wrapU", "wrapV", "filter", "scale", "offset", "colorSpace"},
         {"file"}},
        {"numberTexture", {"file", "wrap", "wrapU", "wrapV", "filter", "scale", "offset"}, {"file"}},
        {"normalTexture",
         {"file", "wrap", "wrapU", "wrapV", "filter", "scale", "offset", "strength"},
         {"file"}},
        {"pointLight", {"type", "position", "intensity"}, {"type", "position", "intensity"}},
        {"spotLight",
         {"type", "position", "direction", "lookAt", "intensity", "innerDeg", "outerDeg"},
         {"type", "position", "intensity"}},
        {"directionalLight",
         {"type", "direction", "irradiance"},
         {"type", "direction", "irradiance"}},
        {"environment",
         {"file", "mapping", "filter", "radiance", "builtin", "scale", "rotateDeg"},
         {}},
        {"transform", {"matrix", "scale", "rotateDeg", "translate"}, {}},
        {"rotation", {"axis", "angle"}, {"axis", "angle"}},
        {"mesh",
         {"type", "name", "file", "material", "smoothNormals", "transform"},
         {"type", "file"}},
        {"triangles",
         {"type", "name", "positions", "indices", "normals", "uvs", "smoothNormals", "material",
          "transform"},
         {"type", "positions", "indices"}},
        {"teapot", {"type", "name", "subdivisions", "smooth", "material", "transform"}, {"type"}},
        {"sphere", {"type", "name", "center", "radius", "material", "transform"}, {"type"}},
        {"sphereMesh",
         {"type", "name", "center", "radius", "level", "smooth", "material", "transform"},
         {"type"}},
        {"rectangle",
         {"type", "name", "corner", "edgeU", "edgeV", "material", "transform"},
         {"type", "corner", "edgeU", "edgeV"}},
        {"disk",
         {"type", "name", "center", "normal", "radius", "segments", "material", "transform"},
         {"type", "radius"}},
        {"group", {"type", "name", "shapes", "transform"}, {"type", "shapes"}},
        {"instance", {"type", "name", "of", "material", "transform"}, {"type", "of"}},
        {"sharedGroup", {"description", "shapes"}, {"shapes"}},
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
