// What the readers of a scene file share while they fill a Scene.
#pragma once

#include "scene/json_fields.h"
#include "scene/obj_reader.h"
#include "scene/scene.h"

#include <map>
#include <memory>
#include <string>

namespace sahl {

struct SceneReading {
    const JsonDocument& document;
    const SceneOptions& options;
    PathPolicy policy;
    fs::path folder;  ///< of the scene file
    Scene& scene;
    std::map<std::string, uint32_t> materials;                    ///< of the scene file, by name
    std::map<fs::path, std::shared_ptr<const ObjFile>> objFiles;  ///< each file is read once
};

/// Adds one entry of "shapes" to the scene.
void readShape(SceneReading& reading, const JsonNode& node);

/// Adds an OBJ file with its own materials.
///   smooth  make normals where the file has none
void appendObj(Scene& scene, const ObjFile& obj, const Transform& transform, bool smooth,
               const std::string& name);

/// Sets width, height, samples, bounces and seed where the command line gave them.
void applyOptions(RenderSettings& settings, const SceneOptions& options);

/// Reads the environment named by the command line.
void applyProbeOption(Scene& scene, const SceneOptions& options);

/// Throws badInput unless width * height is a bearable number of pixels.
void checkPictureSize(const RenderSettings& settings, const std::string& name);

constexpr uint32_t MAX_PICTURE_SIDE = 32768;
constexpr uint64_t MAX_PICTURE_PIXELS = uint64_t{1} << 28;
constexpr uint32_t MAX_SAMPLES = 1u << 24;
constexpr uint32_t MAX_BOUNCES = 65535;

/// Reads a scene file of the format in scenes/schema.json.
Scene loadJsonScene(const fs::path& path, const SceneOptions& options);

}  // namespace sahl
