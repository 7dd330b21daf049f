// Options that choose the integrator and what it shows.
#pragma once

#include "image/image.h"
#include "scene/scene.h"

#include <CLI/CLI.hpp>

#include <string>

namespace sahl {

/// --integrator, --terms, --shadows, --normals, in the group "Picture".
void addShadingOptions(CLI::App& command, SceneOptions& scene);

/// "path" or "phong"
std::string integratorName(const RenderSettings& settings);

/// What the metadata of a picture say about normals, terms and shadows.
ImageMetadata describeShading(const RenderSettings& settings);

}  // namespace sahl
