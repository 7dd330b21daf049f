// How far a film may be from the picture it converges to.
#pragma once

#include "film/film.h"

namespace sahl {

struct PixelStatistics {
    double samples = 0;         ///< of both halves
    double replicates = 0;      ///< whose spread is known: samples, or blocks of them
    double luminance = 0;       ///< mean
    double varianceOfMean = 0;  ///< from the spread of the replicates; 0 with fewer than 2
};

/// Blocks are weighed by the samples in them. A last block that is not full is noisier than others of its
/// weight, since it has not all of its strata: that makes the variance stated larger than it is, and never
/// smaller.
PixelStatistics pixelStatistics(const Film& film, size_t pixel);

/// One standard error of each pixel's luminance, relative to that or to 1 % of the median of all pixels'
/// luminances where that is more. Infinite where a pixel has fewer than 2 replicates; 0 where its samples, or
/// all pixels, are black.
std::vector<double> pixelErrors(const Film& film);

/// How good a picture is, by its own samples.
struct FilmError {
    double ofFrameMean = 0;   ///< one standard error of the mean luminance of all pixels, relative to it
    double reachedShare = 0;  ///< of the pixels: those whose error is at most the target, in [0,1]
};

FilmError filmError(const Film& film, double target);

/// One standard error of a pixel's luminance, root mean square over all pixels, relative to the mean
/// luminance of the picture. From the spread of the replicates. 0 with fewer than 2 of them a pixel or for
/// a black picture.
double relativeError(const Film& film);

}  // namespace sahl
