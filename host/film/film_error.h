// How far a film may be from the picture it converges to.
#pragma once

#include "film/film.h"

namespace sahl {

struct PixelStatistics {
    double samples = 0;         ///< of both halves
    double luminance = 0;       ///< mean
    double varianceOfMean = 0;  ///< from the spread of the samples; 0 with fewer than 2
};

PixelStatistics pixelStatistics(const Film& film, size_t pixel);

/// One standard error of a pixel's luminance, root mean square over all pixels, relative to the mean
/// luminance of the picture. From the spread of the single samples. 0 with fewer than 2 samples a
/// pixel or for a black picture.
double relativeError(const Film& film);

}  // namespace sahl
