// --map and its companions: pictures of work, samples, normals and the like beside the light.
#pragma once

#include "film/maps.h"
#include "util/files.h"

#include <CLI/CLI.hpp>

namespace sahl {

struct MapOptions {
    struct Request {
        MapQuantity quantity;
        fs::path path;  ///< .png
    };
    std::vector<Request> maps;
    MapStyle style;
};

void addMapOptions(CLI::App& command, MapOptions& options);

/// Refuses options that contradict each other (usage).
void checkMapOptions(const MapOptions& options);

/// Whether some map shows fireflies.
bool needFireflies(const MapOptions& options);

/// Whether some map needs what camera rays meet first.
bool needFirstHits(const MapOptions& options);

/// Draws and writes every map. `channels`: what the maps are made from.
void writeMaps(const MapOptions& options, const std::vector<ImageChannel>& channels, uint32_t width,
               uint32_t height, const ImageMetadata& metadata);

}  // namespace sahl
