// Fireflies: pixels that stand out because one of their samples found far more light than the
// others.
#pragma once

#include "film/film.h"

#include <vector>

namespace sahl {

/// A pixel that is at least twice as bright as what is around it, and to which a single replicate
/// (a sample, or a block of them: Film::replicateSize) gave at least a quarter of its light
/// and four times its due. So a light, a highlight or an edge that samples find again and again is
/// none.
struct Firefly {
    uint32_t x = 0, y = 0;  ///< [pixels] from the top left
    double luminance = 0;   ///< of the pixel
    double around = 0;  ///< median luminance of the pixels around it (24, fewer at a border), or 10
                        ///< % of the picture's mean where that is more
    double share = 0;   ///< of its light that came from one replicate, at least; in (0, 1]

    double excess() const { return luminance - around; }
};

/// All of them, those with most excess first. None among pixels of fewer than 8 replicates: what is
/// not known is not told.
std::vector<Firefly> firefliesOf(const Film& film);

/// Share of the picture's light that the excess of these is.
double excessShare(const Film& film, const std::vector<Firefly>& fireflies);

/// The channel "firefly.Y" for a map: how many times as bright as what is around it a firefly is,
/// else 0.
ImageChannel fireflyChannel(const Film& film, const std::vector<Firefly>& fireflies);

}  // namespace sahl
