// Typed access to the values of a scene file; whatever does not fit is refused with its place.
#pragma once

#include "scene/json_document.h"
#include "scene/scene_keys.h"

#include <glm/glm.hpp>

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sahl {

/// Allowed numbers, both ends included.
struct Range {
    double lo = -std::numeric_limits<float>::max();
    double hi = std::numeric_limits<float>::max();
};

/// badInput at the place of a value: "scene.json:3:14: `text`"
Error errorAt(const JsonDocument& document, const JsonNode& node, const std::string& text);

/// `what` names the value in messages: "fovDeg of the camera".
double readNumber(const JsonDocument& document, const JsonNode& node, const std::string& what,
                  Range range);
uint32_t readUint(const JsonDocument& document, const JsonNode& node, const std::string& what,
                  uint32_t lo, uint32_t hi);
glm::dvec3 readVec3(const JsonDocument& document, const JsonNode& node, const std::string& what,
                    Range range);
const std::vector<JsonNode>& readArray(const JsonDocument& document, const JsonNode& node,
                                       const std::string& what);

/// Whether the node is an object with such a key.
bool hasKey(const JsonNode& node, const std::string& key);

/// An object of the scene file whose keys were checked on construction against keysOf(`keys`):
/// unknown ones and missing ones throw. `what` names it in messages: "the camera". The document
/// must outlive it.
class JsonObject {
public:
    JsonObject(const JsonDocument& document, const JsonNode& node, const std::string& what,
               const std::string& keys);
    /// The same with keys of another format than that of scene files.
    JsonObject(const JsonDocument& document, const JsonNode& node, const std::string& what,
               const KeySet& keys);
    /// The same for a format that permits any further keys.
    JsonObject(const JsonDocument& document, const JsonNode& node, const std::string& what);

    const JsonNode* find(const std::string& key) const;  ///< nullptr when absent
    const JsonNode& at(const std::string& key) const;    ///< of a required key
    bool has(const std::string& key) const { return find(key) != nullptr; }

    // The value of `key`, or `fallback` when absent.
    double number(const std::string& key, double fallback, Range range) const;
    uint32_t uint(const std::string& key, uint32_t fallback, uint32_t lo, uint32_t hi) const;
    bool boolean(const std::string& key, bool fallback) const;
    glm::dvec3 vector(const std::string& key, const glm::dvec3& fallback, Range range = {}) const;
    std::string string(const std::string& key, const std::string& fallback) const;
    /// The vector of a required key, scaled to length 1; zero is refused.
    glm::dvec3 direction(const std::string& key) const;
    /// One of `choices`; the first when absent.
    std::string choice(const std::string& key, std::initializer_list<const char*> choices) const;
    /// The places in `choices` of the words of an array, at least one and each once; all when
    /// absent.
    std::vector<size_t> someOf(const std::string& key,
                               std::initializer_list<const char*> choices) const;

    const JsonDocument& document() const { return document_; }
    const JsonNode& node() const { return node_; }
    const std::string& what() const { return what_; }

private:
    std::string nameOf(const std::string& key) const;

    const JsonDocument& document_;
    const JsonNode& node_;
    std::string what_;
};

/// The text of the "type" key, before the keys are known: which keys an object may have depends on
/// it. Throws when it is missing or none of `choices`.
std::string readType(const JsonDocument& document, const JsonNode& node, const std::string& what,
                     std::initializer_list<const char*> choices);

}  // namespace sahl
