// The keys of scene files in one table: the reader refuses all others, and a test holds
// scenes/schema.json to it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace sahl {

/// Keys of one kind of object. `object` is its name under "$defs" in scenes/schema.json; "scene" is
/// the file itself.
struct KeySet {
    std::string object;
    std::vector<std::string> keys;
    std::vector<std::string> required;
};

const std::vector<KeySet>& sceneKeys();

/// The entry of sceneKeys() named `object`, which must exist.
const KeySet& keysOf(std::string_view object);

/// What to write instead of an unknown key: a known one with another name in other programs, else
/// the nearest in spelling, else "".
std::string suggestKey(const std::string& unknown, const KeySet& known);

}  // namespace sahl
