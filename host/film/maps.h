// Pictures of what goes along with the light: work, sample counts, normals, depth, albedo.
#pragma once

#include "image/color_map.h"
#include "image/image.h"

#include <string>
#include <vector>

namespace sahl {

/// A quantity that a map can show, by the layers of docs/exr.md that it is made from.
struct MapQuantity {
    const char* name;   ///< on the command line
    const char* layer;  ///< "depth" of the channel depth.Z
    enum class Kind { scalar, distance, direction, colour } kind;
    bool ofFirstHits;  ///< from firstHitChannels(), else from statisticsChannels() or fireflyChannel()
};

/// All of them.
const std::vector<MapQuantity>& mapQuantities();

/// How scalar quantities are shown.
struct MapStyle {
    ColorMap colors = ColorMap::viridis;
    bool scale = true;
    bool logarithmic = false;
    bool fixedRange = false;  ///< low to high, else from the smallest value to the largest
    double low = 0, high = 1;
};

/// A picture of a quantity whose channels are among `channels`.
///   scalar     false colours
///   distance   the same; 0 stands for no surface and is black
///   direction  red, green, blue = (x + 1) / 2, (y + 1) / 2, (z + 1) / 2 as in normal maps; black
///              where there is none
///   colour     sRGB
Image8 drawMap(const MapQuantity& quantity, const std::vector<ImageChannel>& channels,
               uint32_t width, uint32_t height, const MapStyle& style);

}  // namespace sahl
