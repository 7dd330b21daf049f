// JSON text as a tree in which every value knows where it stands, for messages with line and
// column.
#pragma once

#include "util/error.h"
#include "util/files.h"

#include <string>
#include <vector>

namespace sahl {

struct JsonKey {
    std::string name;
    uint32_t offset = 0;  ///< of the opening quote [bytes]
};

struct JsonNode {
    enum class Kind : uint8_t { null, boolean, number, string, array, object };

    Kind kind = Kind::null;
    bool truth = false;
    uint32_t offset = 0;  ///< of the first character in the text [bytes]
    double number = 0;
    std::string text;             ///< of a string
    std::vector<JsonNode> items;  ///< of an array; values of an object
    std::vector<JsonKey> keys;    ///< of an object, one for each of `items`
};

struct JsonDocument {
    std::string file;  ///< for messages
    std::string text;
    JsonNode root;

    /// "file:line:column", both counted from 1, columns in characters.
    std::string where(size_t offset) const;
};

constexpr uint64_t MAX_JSON_BYTES = uint64_t{16} << 20;
constexpr size_t MAX_JSON_DEPTH = 64;

/// Throws badInput with line and column: syntax errors, anything behind the value, invalid UTF-8,
/// duplicate keys, numbers beyond double, nesting deeper than MAX_JSON_DEPTH. `text` has at most
/// MAX_JSON_BYTES.
JsonDocument parseJson(const std::string& file, const std::string& text);

/// "a number", "an object" ... for messages.
const char* kindName(JsonNode::Kind kind);

}  // namespace sahl
