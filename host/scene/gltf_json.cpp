#include "scene/gltf_json.h"

namespace sahl {

const JsonNode& required(const JsonObject& object, const std::string& key)
{
    if (const JsonNode* value = object.find(key)) return *value;
    throw errorAt(object.document(), object.node(),
                  fmt::format("{} lacks the key \"{}\"", object.what(), key));
}

double requiredNumber(const JsonObject& object, const std::string& key, Range range)
{
    required(object, key);
    return object.number(key, 0, range);
}

uint32_t requiredUint(const JsonObject& object, const std::string& key, uint32_t lo, uint32_t hi)
{
    required(object, key);
    return object.uint(key, lo, lo, hi);
}

const std::vector<JsonNode>& itemsOf(const JsonObject& object, const std::string& key)
{
    static const std::vector<JsonNode> none;
    const JsonNode* list = object.find(key);
    if (!list) return none;
    return readArray(object.document(), *list, fmt::format("\"{}\" of {}", key, object.what()));
}

std::vector<double> numbersOf(const JsonObject& object, const std::string& key,
                              std::vector<double> fallback, Range range)
{
    const JsonNode* list = object.find(key);
    if (!list) return fallback;
    const std::vector<JsonNode>& items = itemsOf(object, key);
    const std::string what = fmt::format("\"{}\" of {}", key, object.what());
    if (items.size() != fallback.size()) {
        throw errorAt(
            object.document(), *list,
            fmt::format("{} needs {} numbers, found {}", what, fallback.size(), items.size()));
    }
    for (size_t i = 0; i < items.size(); i++)
        fallback[i] = readNumber(object.document(), items[i], what, range);
    return fallback;
}

uint32_t readIndex(const JsonDocument& document, const JsonNode& node, const std::string& what,
                   size_t count, const std::string& things)
{
    const uint32_t index = readUint(document, node, what, 0, 0xffffffffu);
    if (index < count) return index;
    throw errorAt(document, node,
                  fmt::format("{} is {}; the file has {} {}", what, index, count, things));
}

std::optional<uint32_t> indexOf(const JsonObject& object, const std::string& key, size_t count,
                                const std::string& things)
{
    const JsonNode* value = object.find(key);
    if (!value) return std::nullopt;
    return readIndex(object.document(), *value, fmt::format("\"{}\" of {}", key, object.what()),
                     count, things);
}

uint32_t requiredIndex(const JsonObject& object, const std::string& key, size_t count,
                       const std::string& things)
{
    required(object, key);
    return *indexOf(object, key, count, things);
}

std::optional<JsonObject> childOf(const JsonObject& object, const std::string& key)
{
    const JsonNode* value = object.find(key);
    if (!value) return std::nullopt;
    return JsonObject(object.document(), *value, fmt::format("{}: {}", object.what(), key));
}

std::optional<JsonObject> extensionOf(const JsonObject& object, const std::string& name)
{
    const std::optional<JsonObject> extensions = childOf(object, "extensions");
    return extensions ? childOf(*extensions, name) : std::nullopt;
}

}  // namespace sahl
