// Materials, textures and lights as JSON objects with a key for every field.
#pragma once

#include "scene/json_fields.h"
#include "shared/scene_types.h"

#include <nlohmann/json.hpp>

namespace sahl {

nlohmann::ordered_json materialJson(const Material& material, const std::string& name);
nlohmann::ordered_json lightJson(const Light& light);
nlohmann::ordered_json textureJson(const Texture& texture);

/// Throw badInput with line and column for unknown and missing keys and values that do not fit.
Material readMaterialJson(const JsonDocument& document, const JsonNode& node, std::string& name);
Light readLightJson(const JsonDocument& document, const JsonNode& node);
Texture readTextureJson(const JsonDocument& document, const JsonNode& node);

}  // namespace sahl
