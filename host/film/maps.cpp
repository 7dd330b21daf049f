#include "film/maps.h"

#include "image/tone_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace sahl {

namespace {

const std::vector<float>& valuesOf(const std::vector<ImageChannel>& channels,
                                   const std::string& name)
{
    for (const ImageChannel& channel : channels) {
        if (channel.name == name) return channel.values;
    }
    throw std::logic_error("a map needs the channel " + name);
}

/// Three channels side by side.
Image imageOf(const MapQuantity& quantity, const std::vector<ImageChannel>& channels,
              const char* tails, uint32_t width, uint32_t height)
{
    Image image = {width, height, std::vector<float>(size_t{3} * width * height)};
    for (size_t c = 0; c < 3; c++) {
        const auto& values = valuesOf(channels, std::string(quantity.layer) + "." + tails[c]);
        for (size_t i = 0; i < values.size(); i++) image.rgb[3 * i + c] = values[i];
    }
    return image;
}

Image8 directionMap(const Image& directions)
{
    Image8 map = filledImage(directions.width, directions.height, BLACK);
    for (size_t i = 0; i < directions.rgb.size(); i += 3) {
        const float* n = &directions.rgb[i];
        if (n[0] == 0 && n[1] == 0 && n[2] == 0) continue;
        for (size_t c = 0; c < 3; c++) {
            const double level = std::floor((double{n[c]} + 1) / 2 * 255 + 0.5);
            map.rgb[i + c] = static_cast<uint8_t>(std::clamp(level, 0.0, 255.0));
        }
    }
    return map;
}

Image8 scalarMap(const ScalarField& field, const MapStyle& style)
{
    FalseColors colors;
    colors.map = style.colors;
    colors.scale = style.scale;
    colors.axis = axisOf(field.values, style.logarithmic);
    if (style.fixedRange) {
        colors.axis.low = style.low;
        colors.axis.high = style.high;
    }
    return falseColorImage(field, colors);
}

}  // namespace

const std::vector<MapQuantity>& mapQuantities()
{
    using Kind = MapQuantity::Kind;
    static const std::vector<MapQuantity> all = {
        {"nodes", "nodeVisits", Kind::scalar, false},
        {"primitives", "primitiveTests", Kind::scalar, false},
        {"samples", "samples", Kind::scalar, false},
        {"error", "error", Kind::scalar, false},
        {"fireflies", "firefly", Kind::scalar, false},
        {"normals", "normal", Kind::direction, true},
        {"geometric-normals", "geometricNormal", Kind::direction, true},
        {"depth", "depth", Kind::distance, true},
        {"albedo", "albedo", Kind::colour, true},
    };
    return all;
}

Image8 drawMap(const MapQuantity& quantity, const std::vector<ImageChannel>& channels,
               uint32_t width, uint32_t height, const MapStyle& style)
{
    using Kind = MapQuantity::Kind;
    if (quantity.kind == Kind::direction) {
        return directionMap(imageOf(quantity, channels, "XYZ", width, height));
    }
    if (quantity.kind == Kind::colour) {
        return toneMap(imageOf(quantity, channels, "RGB", width, height), {ToneOperator::exposure});
    }
    const bool isDistance = quantity.kind == Kind::distance;
    const std::string name = std::string(quantity.layer) + (isDistance ? ".Z" : ".Y");
    ScalarField field = {width, height, valuesOf(channels, name)};
    if (isDistance) {
        for (float& value : field.values) {
            if (value == 0) value = std::numeric_limits<float>::quiet_NaN();
        }
    }
    return scalarMap(field, style);
}

}  // namespace sahl
