#include "app/map_options.h"

#include "app/option_kinds.h"
#include "util/error.h"

namespace sahl {

namespace {

std::vector<std::string> quantityNames()
{
    std::vector<std::string> names;
    for (const MapQuantity& quantity : mapQuantities()) names.push_back(quantity.name);
    return names;
}

/// Breaks a text at the blank next to its middle.
std::string twoLines(std::string text)
{
    const size_t blank = text.find(' ', text.size() / 2);
    if (blank != std::string::npos) text[blank] = '\n';
    return text;
}

MapOptions::Request parseMap(const std::string& text)
{
    const size_t equals = text.find('=');
    if (equals == std::string::npos) {
        throw CLI::ValidationError(
            fmt::format("--map '{}' names no file; give QUANTITY=FILE.png", text));
    }
    const size_t which = parseChoice("--map", text.substr(0, equals), quantityNames());
    return {mapQuantities()[which], text.substr(equals + 1)};
}

/// LO:HI
void parseRange(const std::string& text, MapStyle& style)
{
    const size_t colon = text.find(':');
    if (colon == std::string::npos) {
        throw CLI::ValidationError(fmt::format("--map-range '{}' is no range; give LO:HI", text));
    }
    style.low = parseReal("--map-range", text.substr(0, colon), -1e30, 1e30);
    style.high = parseReal("--map-range", text.substr(colon + 1), -1e30, 1e30);
    if (!(style.low < style.high)) {
        throw CLI::ValidationError(
            fmt::format("--map-range {} is empty; give LO:HI with LO below HI", text));
    }
    style.fixedRange = true;
}

}  // namespace

void addMapOptions(CLI::App& command, MapOptions& options)
{
    MapStyle& style = options.style;
    auto setMaps = [&options](const std::vector<std::string>& texts) {
        for (const std::string& text : texts) options.maps.push_back(parseMap(text));
    };
    command
        .add_option_function<std::vector<std::string>>(
            "--map", setMaps,
            withDefault(twoLines("NAME=FILE.png, a picture of " + enumeration(quantityNames())) +
                            "\n(docs/maps.md); repeatable",
                        "none"))
        ->type_name("MAP")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->group("Maps");
    command
        .add_option_function<std::string>(
            "--error-map",
            [&options](const std::string& file) { options.maps.push_back(parseMap("error=" + file)); },
            withDefault("the pixels' relative errors, as --map error=FILE.png", "none"))
        ->type_name("FILE")
        ->group("Maps");
    addChoice(command, "--map-colors", style.colors,
              {{"viridis", ColorMap::viridis}, {"grey", ColorMap::grey}}, "viridis or grey")
        ->group("Maps");
    command
        .add_option_function<std::string>(
            "--map-range", [&style](const std::string& text) { parseRange(text, style); },
            withDefault("values at the ends of the colours", "smallest and largest"))
        ->type_name("LO:HI")
        ->group("Maps");
    addChoice(command, "--map-scale", style.scale, {{"on", true}, {"off", false}},
              "on or off: colours and their numbers at the side")
        ->group("Maps");
    addFlag(command, "--map-log", style.logarithmic, "colours by the logarithm of the value")
        ->group("Maps");
}

void checkMapOptions(const MapOptions& options)
{
    const MapStyle& style = options.style;
    if (style.logarithmic && style.fixedRange && style.low <= 0) {
        throw usageError("--map-range {}:{}: with --map-log both ends must be above 0", style.low,
                         style.high);
    }
}

bool needFireflies(const MapOptions& options)
{
    return std::any_of(options.maps.begin(), options.maps.end(), [](const MapOptions::Request& map) {
        return map.quantity.layer == std::string_view("firefly");
    });
}

bool needFirstHits(const MapOptions& options)
{
    return std::any_of(options.maps.begin(), options.maps.end(),
                       [](const MapOptions::Request& map) { return map.quantity.ofFirstHits; });
}

void writeMaps(const MapOptions& options, const std::vector<ImageChannel>& channels, uint32_t width,
               uint32_t height, const ImageMetadata& metadata)
{
    for (const MapOptions::Request& map : options.maps) {
        ImageMetadata told = metadata;
        told["sahl.map"] = map.quantity.name;
        const Image8 picture = drawMap(map.quantity, channels, width, height, options.style);
        writeFileAtomically(map.path, encodePng(picture, told));
    }
}

}  // namespace sahl
