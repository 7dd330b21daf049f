// What a saved scene says beside its arrays: settings, camera, probes, tree; a JSON object, in both
// forms of the file.
#pragma once

#include "render/prepare.h"
#include "scene/json_document.h"

#include <nlohmann/json.hpp>

namespace sahl {

/// Throws badInput when the scene has no description of its camera.
nlohmann::ordered_json describe(const PreparedScene& prepared);

/// Fills in settings, camera, probes and tree from an object made by describe(), and then what the
/// options change but for the probe. `more` are keys that the caller reads itself. Returns the
/// camera as it was saved. Throws badInput with line and column, usage for options that need the
/// original scene.
Camera readDescription(const JsonDocument& document, const std::vector<std::string>& more,
                       const SceneOptions& options, PreparedScene& prepared);

/// Boxes of instances hold for rays from no farther away than the saved camera; a picture of
/// another shape can move the camera. To be called once the instances are there. Throws usage.
void requireReach(const PreparedScene& prepared, const Camera& saved);

/// Puts the environment that the options name, if any, in place of the saved one; a background
/// stays. To be called once the scene is complete and checked.
void replaceProbe(const SceneOptions& options, PreparedScene& prepared);

}  // namespace sahl
