// Adaptive sampling as a scene file and the command line ask for it.
#pragma once

#include "scene/json_fields.h"
#include "scene/scene.h"

namespace sahl {

/// Reads "adaptive" of the integrator.
void readAdaptive(const JsonDocument& document, const JsonNode& node, RenderSettings& settings);

/// Takes over what the command line says. Throws a usage error for options that would have no
/// effect and for bounds that the rule cannot keep.
void applyAdaptiveOptions(RenderSettings& settings, const SceneOptions& options);

/// "none", "report", "crossed" or "joint".
const char* adaptiveRuleName(uint32_t rule);

/// All of them, in the order of ADAPTIVE_*.
constexpr std::initializer_list<const char*> ADAPTIVE_RULES = {"none", "report", "crossed", "joint"};

/// Whether pictures by the rule are expected to differ from the right one.
bool isBiased(uint32_t rule);

}  // namespace sahl
