// Reading the JSON of glTF files: keys may be missing or unknown, and most numbers are places in
// lists of the same file.
#pragma once

#include "scene/json_fields.h"

namespace sahl {

/// The value of a key that the format demands. Throws when it is missing.
const JsonNode& required(const JsonObject& object, const std::string& key);

double requiredNumber(const JsonObject& object, const std::string& key, Range range);
uint32_t requiredUint(const JsonObject& object, const std::string& key, uint32_t lo, uint32_t hi);

/// The items of a list; none when it is missing.
const std::vector<JsonNode>& itemsOf(const JsonObject& object, const std::string& key);

/// `count` numbers in range; `fallback` when the key is missing.
std::vector<double> numbersOf(const JsonObject& object, const std::string& key,
                              std::vector<double> fallback, Range range = {});

/// A place in a list of `count` things ("buffer views"); nullopt when the key is missing.
std::optional<uint32_t> indexOf(const JsonObject& object, const std::string& key, size_t count,
                                const std::string& things);
uint32_t requiredIndex(const JsonObject& object, const std::string& key, size_t count,
                       const std::string& things);

/// A place in a list, written as an item of another list.
uint32_t readIndex(const JsonDocument& document, const JsonNode& node, const std::string& what,
                   size_t count, const std::string& things);

/// The object under a key, named "camera 2: perspective" in messages; nullopt when it is missing.
std::optional<JsonObject> childOf(const JsonObject& object, const std::string& key);

/// The object under "extensions" of such a name.
std::optional<JsonObject> extensionOf(const JsonObject& object, const std::string& name);

}  // namespace sahl
