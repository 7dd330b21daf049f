// What the readers of a scene file share while they fill a Scene.
#pragma once

#include "bvh/box.h"
#include "scene/json_fields.h"
#include "scene/obj_reader.h"
#include "scene/scene.h"
#include "scene/transform.h"

#include <map>
#include <memory>
#include <string>

namespace sahl {

/// An entry of "groups": the objects that one instance of it places, its own and nested ones.
struct SharedGroup {
    std::vector<Placement> inside;
};

struct GltfModel;

struct SceneReading {
    const JsonDocument& document;
    const SceneOptions& options;
    PathPolicy policy;
    fs::path folder;  ///< of the scene file
    Scene& scene;
    std::map<std::string, uint32_t> materials;                    ///< of the scene file, by name
    std::map<fs::path, std::shared_ptr<const ObjFile>> objFiles;  ///< each file is read once
    std::map<std::string, Box> namedShapes;
    std::map<fs::path, std::shared_ptr<const GltfModel>> gltfFiles = {};  ///< read once, too
    Transform outer = {};  ///< of the groups that the shapes being read are in
    std::map<std::string, const JsonNode*> groupNodes = {};  ///< the entries of "groups"
    std::map<std::string, SharedGroup> groups = {};          ///< those that are read
    std::vector<std::string> openGroups = {};                ///< those being read, outermost first
    uint64_t placements = 0;  ///< made so far, in groups and in the world
};

/// Adds the entries of "materials" to the scene.
void readMaterials(SceneReading& reading, const JsonNode& node);

/// Adds one entry of "shapes" to the scene.
void readShape(SceneReading& reading, const JsonNode& node);

/// Reads "groups", before the shapes that refer to them.
void readGroups(SceneReading& reading, const JsonNode& node);

/// Adds a shape of type "group" or "instance" to the scene.
void readGroupShape(SceneReading& reading, const JsonObject& shape);
void readInstance(SceneReading& reading, const JsonObject& shape);

/// The map from a shape's own space to that which is being read: the world, or a shared group.
Transform readTransform(const SceneReading& reading, const JsonObject& shape);

/// Index of the material that a shape names, or of the default one.
uint32_t readMaterialName(SceneReading& reading, const JsonObject& shape);

/// Adds one entry of "lights" to the scene.
void readLight(SceneReading& reading, const JsonNode& node);

/// Makes "environment" the scene's probe, and "background" what the camera sees behind the scene.
/// The environment comes first; the command line's options count for it alone.
void readEnvironment(SceneReading& reading, const JsonNode& node);
void readBackground(SceneReading& reading, const JsonNode& node);

/// Places the scene's "camera", once all shapes are read: it may focus on one of them.
void readCamera(SceneReading& reading, const JsonNode& node);

/// An object of axis and angle.
///   what  names it in messages: "\"rotateDeg\" of the environment"
Transform readRotation(const JsonDocument& document, const JsonNode& node, const std::string& what);

/// Terms, shadows, normals and ambient light of "integrator".
void readShading(const JsonObject& integrator, RenderSettings& settings);

/// The textures of a material and its alphaCutoff.
void readMaterialTextures(SceneReading& reading, const JsonObject& object, Material& material);

/// What the phong integrator uses of a material, once the rest of it is read.
void readPhongMaterial(const JsonObject& object, Material& material);

/// Adds an OBJ file with its own materials.
///   smooth  make normals where the file has none
void appendObj(Scene& scene, const ObjFile& obj, const Transform& transform, bool smooth,
               const std::string& name);

/// Sets width, height, samples, bounces and seed where the command line gave them.
void applyOptions(RenderSettings& settings, const SceneOptions& options);

/// Reads the environment named by the command line.
void applyProbeOption(Scene& scene, const SceneOptions& options);

/// Lights a scene that has no light of its own.
void useStudioProbe(Scene& scene, const SceneOptions& options);

/// Calls options.onceThreadsMayStart, if there is one.
void sayThreadsMayStart(const SceneOptions& options);

/// Throws badInput unless width * height is a bearable number of pixels.
void checkPictureSize(const RenderSettings& settings, const std::string& name);

constexpr uint32_t MAX_PICTURE_SIDE = 32768;
constexpr uint64_t MAX_PICTURE_PIXELS = uint64_t{1} << 28;
constexpr uint32_t MAX_SAMPLES = 1u << 24;
constexpr uint32_t MAX_BOUNCES = 65535;
constexpr Range ANGLE_RANGE = {-1e6, 1e6};  ///< of rotations [degrees]
constexpr Range LIGHT_RANGE = {0, 1e18};    ///< of radiance, intensity and irradiance

/// Reads a scene file of the format in scenes/schema.json.
Scene loadJsonScene(const fs::path& path, const SceneOptions& options);

}  // namespace sahl
