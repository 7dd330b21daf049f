// Adaptive sampling as a scene file and the command line ask for it.
#pragma once

#include "scene/json_fields.h"
#include "scene/scene.h"

namespace sahl {

/// Reads "adaptive" of the integrator.
void readAdaptive(const JsonDocument& document, const JsonNode& node, RenderSettings& settings);

/// Takes over what the command line says. Throws a usage error for options that would have no
/// effect and for a minimum above the maximum.
void applyAdaptiveOptions(RenderSettings& settings, const SceneOptions& options);

/// "none" or "report".
const char* adaptiveRuleName(uint32_t rule);

}  // namespace sahl
