// A scene as the rest of the program sees it: plain arrays of the structs that the device reads.
#pragma once

#include "bvh/instances.h"
#include "shared/adaptive_types.h"
#include "shared/scene_types.h"
#include "util/files.h"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sahl {

/// A probe whose texels begin the buffer, looked up without rotation.
inline Probe plainProbe(uint32_t width, uint32_t height, uint mapping, uint filterMode)
{
    Probe probe = {};
    probe.width = width;
    probe.height = height;
    probe.mapping = mapping;
    probe.filterMode = filterMode;
    probe.axisX = {1, 0, 0};
    probe.axisY = {0, 1, 0};
    probe.axisZ = {0, 0, 1};
    return probe;
}

/// Numbers of the picture that a scene file may set and the command line may override.
struct RenderSettings {
    uint32_t width = 512;  ///< [pixels]
    uint32_t height = 512;
    uint32_t spp = 64;  ///< samples per pixel
    uint32_t maxBounces = 8;
    uint32_t seed = 0;
    uint32_t integrator = INTEGRATOR_PATH;
    uint32_t samplerKind = SAMPLER_INDEPENDENT;
    uint32_t rouletteDepth = NO_ROULETTE;  ///< scatterings after which paths end by chance
    float clampIndirect = 0;               ///< see Frame; 0: nothing is clamped
    uint32_t lightSampling = LIGHTS_MIS;
    bool jitter = true;  ///< samples spread over the pixel rather than all through its centre
    uint32_t shading = SHADING_TERMS;  ///< SHADING_* bits: terms, shadows and normals
    vec3 ambient = vec3(0.1f);         ///< for phong: radiance from everywhere [W m^-2 sr^-1]
    /// With a rule, `spp` has no meaning.
    AdaptiveRule adaptive = {ADAPTIVE_NONE, 1e-4f, 20, 1000, 0.05f, 0, 0, 0};
};

/// What points right and up in the picture, of any length, at a right angle to each other. The
/// camera looks along up x right, or along right x up in a left-handed space.
struct CameraAxes {
    glm::dvec3 right = {1, 0, 0};
    glm::dvec3 up = {0, 1, 0};
    bool leftHanded = false;
};

/// A box that the picture is to show all of.
struct FramedBox {
    glm::dvec3 lo, hi;
};

/// Camera as people describe it. Field of view in degrees of the named axis.
struct CameraDescription {
    glm::dvec3 eye = {0, 0, 5};
    glm::dvec3 lookAt = {0, 0, 0};
    glm::dvec3 up = {0, 1, 0};
    std::optional<CameraAxes> axes;  ///< instead of lookAt and up
    double fovDeg = 40;
    bool fovHorizontal = false;
    std::optional<double> orthographicHeight;  ///< of what is seen [m], instead of a field of view
    double lensRadius = 0;                     ///< of a thin lens [m]; 0: all is sharp
    std::optional<double> focusDistance;       ///< along the view [m]; without it: to lookAt
    std::optional<FramedBox> framed;           ///< moves eye so that all of it is in the picture
};

/// Where the texels of a picture are that textures look up.
struct StoredPicture {
    uint32_t firstTexel = 0, width = 0, height = 0;
};

/// Everything a picture is made of, before the tree is built. Primitives are in the order in which
/// the files gave them; primitives[i].number == i.
struct Scene {
    std::string name;  ///< for messages: the file, or "built-in ..."
    RenderSettings settings;
    std::vector<Primitive> primitives;
    std::vector<uint32_t> objectStarts;           ///< number of the first primitive of each shape
    std::vector<std::vector<Primitive>> objects;  ///< that instances share; in spaces of their own,
                                                  ///< objects[k][i].number == i
    std::vector<Placement> instances;
    std::vector<TriangleCorners> triangleCorners;
    std::vector<Material> materials;
    std::vector<std::string> materialNames;  ///< of materials, for messages
    std::vector<Light> lights;
    std::vector<Texture> textures;
    std::vector<uint32_t> textureTexels;  ///< the sRGB curve, then those of all pictures: see Texture
    std::map<std::string, StoredPicture> pictures;  ///< stored so far, by files or other names
    Probe probe = plainProbe(0, 0, PROBE_LATLONG, FILTER_BILINEAR);  ///< lights the scene
    std::optional<Probe> background;  ///< what the camera sees behind the scene, if not the probe
    std::vector<vec4> probeTexels;    ///< of both
    Camera camera = {};  ///< `right` set for settings.width x settings.height, see makeCamera
    std::optional<CameraDescription> cameraDescription;  ///< what `camera` was made from
    uint64_t droppedTriangles = 0;  ///< of zero area, left out while reading
};

/// The device's camera for a picture of the given size. Throws badInput when eye and lookAt
/// coincide, up is parallel to the view, fovDeg is outside (0, 180), axes are zero or not at a
/// right angle (to 1e-4), or a lens has nothing to focus on.
Camera makeCamera(const CameraDescription& description, uint32_t width, uint32_t height);

/// Gives the scene the described camera, for its picture's size. Throws as makeCamera does.
void placeCamera(Scene& scene, const CameraDescription& description);

/// Box of everything in the scene, instances included; empty where there is nothing.
Box extentOf(const Scene& scene);

/// Box of an object in its own space.
Box extentOf(const std::vector<Primitive>& primitives);

/// What the command line adds to or changes in a scene.
struct SceneOptions {
    std::optional<uint32_t> width, height, spp, maxBounces, seed;
    std::optional<uint32_t> integrator;  ///< one of INTEGRATOR_*
    std::optional<uint32_t> samplerKind, rouletteDepth;  ///< one of SAMPLER_*; NO_ROULETTE: off
    std::optional<float> clampIndirect;                  ///< 0: off
    std::optional<uint32_t> lightSampling;               ///< one of LIGHTS_*
    std::optional<uint32_t> terms;       ///< of phong: bits of SHADING_TERMS
    std::optional<bool> shadows;         ///< of phong
    std::optional<bool> flatNormals;     ///< geometric normals in place of interpolated ones
    std::optional<uint32_t> adaptive, minSpp, maxSpp;  ///< rule (one of ADAPTIVE_*) and bounds
    std::optional<float> epsilon;                      ///< of ADAPTIVE_REPORT
    std::optional<float> targetError;                  ///< of ADAPTIVE_CROSSED and _JOINT
    std::optional<fs::path> probe;            ///< replaces the environment
    std::optional<std::string> probeMapping;  ///< "latlong" or "angular"
    std::optional<std::string> probeFilter;   ///< "nearest" or "bilinear"
    bool smoothNormals = false;               ///< make normals for meshes that have none
    std::vector<fs::path> allowedPaths;       ///< folders outside the scene's own to read from
    /// Called once nothing is left to be decoded in a process that is split off (image/isolated.h), which is safe only
    /// while there is one thread: before meshes are read. May be empty.
    std::function<void()> onceThreadsMayStart;
};

/// Reads a scene: .json (scenes/schema.json), .gltf or .glb, or a mesh, .obj or .ply (framing camera,
/// default studio probe when no probe is named; glTF files may have cameras and lights of their own). Throws badInput with file, line and column or object, and what would help.
Scene loadScene(const fs::path& path, const SceneOptions& options);

/// A small scene that needs no file: 2 spheres of triangles with smooth normals, a lamp, a point
/// light, a ground and a probe. For `sahl verify` without a scene, and for tests.
Scene builtInScene(const SceneOptions& options);

}  // namespace sahl
