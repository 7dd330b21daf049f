#include "scene/mtl_map.h"

#include "scene/numbers.h"
#include "util/error.h"

#include <algorithm>
#include <cmath>

namespace sahl {

namespace {

constexpr double LARGEST_SCALE = 1e6;

/// The words of a statement, from the left.
struct Words {
    const Statement& statement;
    std::string_view rest;

    std::string_view peek() const
    {
        std::string_view copy = rest;
        return takeWord(copy);
    }
};

Error wrong(const Words& words, std::string_view option, const char* needs)
{
    return badInput("{}: \"{}\" of {} needs {}, found \"{}\"", at(words.statement), option,
                    words.statement.keyword, needs, words.peek().substr(0, 40));
}

/// Up to 3 numbers, at least one; those that are left out stay as they are.
size_t takeNumbers(Words& words, std::string_view option, std::array<double, 3>& values)
{
    size_t n = 0;
    double value = 0;
    while (n < 3 && parseNumber(words.peek(), value) == NumberText::fine &&
           std::abs(value) <= LARGEST_SCALE) {
        values[n++] = value;
        takeWord(words.rest);
    }
    if (n == 0) throw wrong(words, option, "a number");
    return n;
}

bool takeSwitch(Words& words, std::string_view option)
{
    const std::string_view word = words.peek();
    if (word != "on" && word != "off") throw wrong(words, option, "\"on\" or \"off\"");
    takeWord(words.rest);
    return word == "on";
}

void takeChannel(Words& words, std::string_view option, MtlMap& map)
{
    static const std::set<std::string_view> channels = {"r", "g", "b", "m", "l"};
    const std::string_view word = words.peek();
    if (channels.count(word) == 0) throw wrong(words, option, "r, g, b, m or l");
    map.channel = word[0];
    takeWord(words.rest);
}

/// Takes one option with its values.
void takeOption(Words& words, MtlMap& map, std::set<std::string>& unused)
{
    static const std::set<std::string_view> switches = {"-blendu", "-blendv", "-cc"};
    static const std::set<std::string_view> numbers = {"-boost", "-mm", "-t", "-texres"};
    const std::string_view option = takeWord(words.rest);
    std::array<double, 3> values = {1, 1, 1};
    if (option == "-s") {
        takeNumbers(words, option, values);
        map.scale = {values[0], values[1]};
    } else if (option == "-o") {
        values = {};
        takeNumbers(words, option, values);
        map.offset = {values[0], values[1]};
    } else if (option == "-clamp") {
        map.clamps = takeSwitch(words, option);
    } else if (option == "-bm") {
        takeNumbers(words, option, values);
        map.strength = values[0];
    } else if (option == "-imfchan") {
        takeChannel(words, option, map);
    } else if (switches.count(option) > 0) {
        takeSwitch(words, option);
        unused.insert(std::string(option));
    } else if (numbers.count(option) > 0) {
        takeNumbers(words, option, values);
        unused.insert(std::string(option));
    } else if (option == "-type") {
        takeWord(words.rest);
        unused.insert(std::string(option));
    } else {
        throw badInput("{}: \"{}\" is no option of {}; known are -s, -o, -clamp, -bm, -imfchan "
                       "and, without effect "
                       "here, -blendu, -blendv, -boost, -cc, -mm, -t, -texres, -type",
                       at(words.statement), option.substr(0, 40), words.statement.keyword);
    }
}

/// A texel's number in [0,255]: one channel, or what the eye makes of all (by default).
uint32_t numberOf(uint32_t texel, const MtlMap& map)
{
    const uint32_t r = texel & 255, g = texel >> 8 & 255, b = texel >> 16 & 255;
    switch (map.channel.value_or('l')) {
    case 'r':
        return r;
    case 'g':
        return g;
    case 'b':
        return b;
    case 'm':
        return texel >> 24;
    default:
        return static_cast<uint32_t>(std::lround(0.2126 * r + 0.7152 * g + 0.0722 * b));
    }
}

TexelImage readMap(const MtlMap& map)
{
    std::error_code error;
    if (!fs::exists(map.file, error)) {
        throw badInput("{}: the texture \"{}\" is missing; put it there or remove the statement",
                       map.where, map.file.string());
    }
    return readTexels(map.file);
}

TextureLook lookOf(const MtlMap& map, bool srgb)
{
    TextureLook look;
    look.srgb = srgb;
    look.clampS = look.clampT = map.clamps;
    look.rowS = {map.scale.x, 0, map.offset.x};
    look.rowT = {0, map.scale.y, map.offset.y};
    look.strength = map.strength;
    return look;
}

uint32_t textureOf(Scene& scene, const MtlMap& map, bool srgb)
{
    return addTexture(scene, pictureOnce(scene, map.file.string(), [&] { return readMap(map); }),
                      lookOf(map, srgb));
}

/// Refuses two maps that cannot share a texture.
void requireAlike(const MtlMap& a, const MtlMap& b)
{
    if (a.scale == b.scale && a.offset == b.offset && a.clamps == b.clamps) return;
    throw badInput(
        "{}: this map and that of {} share a texture and must have the same -s, -o and -clamp",
        b.where, a.where);
}

void requireSameSize(const TexelImage& image, const MtlMap& map, const TexelImage& other,
                     const MtlMap& otherMap)
{
    if (image.width == other.width && image.height == other.height) return;
    throw badInput(
        "{}: this map has {} x {} texels and that of {}, which shares a texture with it, {} x {}; "
        "scale one of them to the size of the other",
        otherMap.where, other.width, other.height, map.where, image.width, image.height);
}

/// One texture of two optional maps: `combine` writes both texels into one.
template <class Combine>
uint32_t textureOfBoth(Scene& scene, const std::optional<MtlMap>& a, const std::optional<MtlMap>& b,
                       bool srgb, const char* name, Combine combine)
{
    if (a && b) requireAlike(*a, *b);
    auto keyOf = [](const std::optional<MtlMap>& map) {
        return map ? fmt::format("{}:{}", map->file.string(), map->channel.value_or('l'))
                   : std::string();
    };
    auto make = [&] {
        TexelImage first = readMap(a ? *a : *b);
        if (a && b) {
            const TexelImage second = readMap(*b);
            requireSameSize(first, *a, second, *b);
            for (size_t i = 0; i < first.rgba.size(); i++)
                first.rgba[i] = combine(first.rgba[i], second.rgba[i]);
        } else {
            for (uint32_t& texel : first.rgba)
                texel = a ? combine(texel, 0xffffffffu) : combine(0xffffffffu, texel);
        }
        return first;
    };
    const StoredPicture picture =
        pictureOnce(scene, fmt::format("{} of {} and {}", name, keyOf(a), keyOf(b)), make);
    return addTexture(scene, picture, lookOf(a ? *a : *b, srgb));
}

}  // namespace

MtlMap readMtlMap(const Statement& statement, const PathPolicy& policy,
                  std::set<std::string>& unused)
{
    MtlMap map;
    map.where = at(statement);
    Words words = {statement, statement.rest};
    while (words.peek().substr(0, 1) == "-" && words.peek().size() > 1)
        takeOption(words, map, unused);
    std::string name(trimmed(words.rest));
    if (name.empty()) throw badInput("{}: {} names no file", map.where, statement.keyword);
    std::replace(name.begin(), name.end(), '\\', '/');
    map.file = resolvePath(policy, folderOf(std::string(statement.file)), name, map.where);
    return map;
}

void applyMtlMaps(Scene& scene, const MtlMaps& maps, double opacity, Material& material)
{
    if (maps.alpha) {
        MtlMap alphaMap = *maps.alpha;
        if (maps.color && maps.color->file == alphaMap.file && !alphaMap.channel)
            alphaMap.channel = 'm';
        const auto withAlpha = [&](uint32_t color, uint32_t alpha) {
            return (color & 0x00ffffffu) | numberOf(alpha, alphaMap) << 24;
        };
        material.baseColorTexture = textureOfBoth(scene, maps.color, std::optional(alphaMap), true,
                                                  "color and alpha", withAlpha);
        constexpr double HALF = 0.5;
        material.alphaCutoff = toFloat(HALF / std::max(opacity, HALF * HALF));
    } else if (maps.color) {
        material.baseColorTexture = textureOf(scene, *maps.color, true);
    }
    if (maps.emission) material.emissionTexture = textureOf(scene, *maps.emission, true);
    if (maps.normal) material.normalTexture = textureOf(scene, *maps.normal, false);
    if (maps.roughness || maps.metallic) {
        const auto both = [&](uint32_t roughness, uint32_t metallic) {
            const uint32_t green = maps.roughness ? numberOf(roughness, *maps.roughness) : 255;
            const uint32_t blue = maps.metallic ? numberOf(metallic, *maps.metallic) : 255;
            return packTexel(255, green, blue, 255);
        };
        material.roughnessTexture = textureOfBoth(scene, maps.roughness, maps.metallic, false,
                                                  "roughness and metallic", both);
    }
}

}  // namespace sahl
