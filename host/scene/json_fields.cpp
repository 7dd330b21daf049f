#include "scene/json_fields.h"

#include "scene/numbers.h"

#include <algorithm>
#include <cmath>

namespace sahl {

namespace {

void requireKind(const JsonDocument& document, const JsonNode& node, const std::string& what,
                 JsonNode::Kind kind)
{
    if (node.kind == kind) return;
    throw errorAt(
        document, node,
        fmt::format("{} must be {}, found {}", what, kindName(kind), kindName(node.kind)));
}

const JsonNode* findKey(const JsonNode& node, const std::string& key)
{
    for (size_t i = 0; i < node.keys.size(); i++) {
        if (node.keys[i].name == key) return &node.items[i];
    }
    return nullptr;
}

std::string listOf(std::initializer_list<const char*> choices)
{
    std::string list;
    for (const char* choice : choices) {
        list += fmt::format("{}\"{}\"", list.empty() ? "" : ", ", choice);
    }
    return list;
}

void requireChoice(const JsonDocument& document, const JsonNode& node, const std::string& what,
                   std::initializer_list<const char*> choices)
{
    requireKind(document, node, what, JsonNode::Kind::string);
    if (std::find(choices.begin(), choices.end(), node.text) != choices.end()) return;
    std::string near = suggestion(node.text, choices);
    throw errorAt(document, node,
                  fmt::format("{} is \"{}\"; {}", what, node.text,
                              near.empty() ? "known: " + listOf(choices)
                                           : fmt::format("did you mean \"{}\"?", near)));
}

}  // namespace

Error errorAt(const JsonDocument& document, const JsonNode& node, const std::string& text)
{
    return badInput("{}: {}", document.where(node.offset), text);
}

double readNumber(const JsonDocument& document, const JsonNode& node, const std::string& what,
                  Range range)
{
    requireKind(document, node, what, JsonNode::Kind::number);
    if (!(node.number >= range.lo && node.number <= range.hi)) {
        throw errorAt(document, node,
                      fmt::format("{} is {}; it must lie in [{}, {}]", what, node.number, range.lo,
                                  range.hi));
    }
    return node.number;
}

uint32_t readUint(const JsonDocument& document, const JsonNode& node, const std::string& what,
                  uint32_t lo, uint32_t hi)
{
    double value = readNumber(document, node, what, {double(lo), double(hi)});
    if (value != std::floor(value)) {
        throw errorAt(document, node,
                      fmt::format("{} is {}; it must be a whole number", what, value));
    }
    return static_cast<uint32_t>(value);
}

glm::dvec3 readVec3(const JsonDocument& document, const JsonNode& node, const std::string& what,
                    Range range)
{
    const std::vector<JsonNode>& items = readArray(document, node, what);
    if (items.size() != 3) {
        throw errorAt(document, node,
                      fmt::format("{} needs 3 numbers, found {}", what, items.size()));
    }
    glm::dvec3 v;
    for (int i = 0; i < 3; i++)
        v[i] = readNumber(document, items[static_cast<size_t>(i)], what, range);
    return v;
}

const std::vector<JsonNode>& readArray(const JsonDocument& document, const JsonNode& node,
                                       const std::string& what)
{
    requireKind(document, node, what, JsonNode::Kind::array);
    return node.items;
}

bool hasKey(const JsonNode& node, const std::string& key)
{
    return findKey(node, key) != nullptr;
}

JsonObject::JsonObject(const JsonDocument& document, const JsonNode& node, const std::string& what,
                       const std::string& keys)
    : JsonObject(document, node, what, keysOf(keys))
{
}

JsonObject::JsonObject(const JsonDocument& document, const JsonNode& node, const std::string& what,
                       const KeySet& known)
    : document_(document), node_(node), what_(what)
{
    requireKind(document, node, what, JsonNode::Kind::object);
    for (const JsonKey& key : node.keys) {
        if (std::find(known.keys.begin(), known.keys.end(), key.name) != known.keys.end()) continue;
        std::string near = suggestKey(key.name, known);
        throw badInput("{}: unknown key \"{}\" in {}{}", document.where(key.offset), key.name, what,
                       near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near));
    }
    for (const std::string& key : known.required) {
        if (!has(key)) {
            throw errorAt(document, node, fmt::format("{} lacks the key \"{}\"", what, key));
        }
    }
}

JsonObject::JsonObject(const JsonDocument& document, const JsonNode& node, const std::string& what)
    : document_(document), node_(node), what_(what)
{
    requireKind(document, node, what, JsonNode::Kind::object);
}

const JsonNode* JsonObject::find(const std::string& key) const
{
    return findKey(node_, key);
}

const JsonNode& JsonObject::at(const std::string& key) const
{
    return *find(key);
}

std::string JsonObject::nameOf(const std::string& key) const
{
    return fmt::format("\"{}\" of {}", key, what_);
}

double JsonObject::number(const std::string& key, double fallback, Range range) const
{
    const JsonNode* value = find(key);
    return value ? readNumber(document_, *value, nameOf(key), range) : fallback;
}

uint32_t JsonObject::uint(const std::string& key, uint32_t fallback, uint32_t lo, uint32_t hi) const
{
    const JsonNode* value = find(key);
    return value ? readUint(document_, *value, nameOf(key), lo, hi) : fallback;
}

bool JsonObject::boolean(const std::string& key, bool fallback) const
{
    const JsonNode* value = find(key);
    if (!value) return fallback;
    requireKind(document_, *value, nameOf(key), JsonNode::Kind::boolean);
    return value->truth;
}

glm::dvec3 JsonObject::vector(const std::string& key, const glm::dvec3& fallback, Range range) const
{
    const JsonNode* value = find(key);
    return value ? readVec3(document_, *value, nameOf(key), range) : fallback;
}

std::string JsonObject::string(const std::string& key, const std::string& fallback) const
{
    const JsonNode* value = find(key);
    if (!value) return fallback;
    requireKind(document_, *value, nameOf(key), JsonNode::Kind::string);
    return value->text;
}

glm::dvec3 JsonObject::direction(const std::string& key) const
{
    const glm::dvec3 v = readVec3(document_, at(key), nameOf(key), {});
    const double length = std::sqrt(glm::dot(v, v));
    if (!(length > SMALLEST_MAGNITUDE)) {
        throw errorAt(document_, at(key), fmt::format("{} is zero", nameOf(key)));
    }
    return v / length;
}

std::string JsonObject::choice(const std::string& key,
                               std::initializer_list<const char*> choices) const
{
    const JsonNode* value = find(key);
    if (!value) return *choices.begin();
    requireChoice(document_, *value, nameOf(key), choices);
    return value->text;
}

std::vector<size_t> JsonObject::someOf(const std::string& key,
                                       std::initializer_list<const char*> choices) const
{
    std::vector<size_t> places;
    const JsonNode* value = find(key);
    if (!value) {
        for (size_t place = 0; place < choices.size(); place++) places.push_back(place);
        return places;
    }
    for (const JsonNode& word : readArray(document_, *value, nameOf(key))) {
        requireChoice(document_, word, "an entry of " + nameOf(key), choices);
        const auto found = std::find(choices.begin(), choices.end(), word.text);
        const size_t place = static_cast<size_t>(found - choices.begin());
        if (std::find(places.begin(), places.end(), place) != places.end()) {
            throw errorAt(document_, word,
                          fmt::format("{} has \"{}\" twice", nameOf(key), word.text));
        }
        places.push_back(place);
    }
    if (places.empty()) {
        throw errorAt(document_, *value,
                      fmt::format("{} is empty; known: {}", nameOf(key), listOf(choices)));
    }
    return places;
}

std::string readType(const JsonDocument& document, const JsonNode& node, const std::string& what,
                     std::initializer_list<const char*> choices)
{
    requireKind(document, node, what, JsonNode::Kind::object);
    const JsonNode* type = findKey(node, "type");
    if (!type) {
        throw errorAt(document, node,
                      fmt::format("{} lacks the key \"type\", one of {}", what, listOf(choices)));
    }
    requireChoice(document, *type, fmt::format("\"type\" of {}", what), choices);
    return type->text;
}

}  // namespace sahl
