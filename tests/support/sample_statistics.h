// Mean and variance of the samples of a pixel, from the sums that a film keeps.
#pragma once

#include "film/film.h"

#include <algorithm>

namespace sahl::testing {

/// Of the luminance of single samples, both halves of the film together.
struct SampleStatistics {
    double mean = 0;
    double variance = 0;  ///< of a sample about the mean
    double count = 0;
};

inline SampleStatistics sampleStatistics(const Film& film, size_t pixel)
{
    double sum = 0, sum2 = 0, n = 0;
    for (const auto& half : film.half) {
        const HalfPixel& sums = half[pixel];
        sum += 0.2126 * sums.sum[0].toDouble() + 0.7152 * sums.sum[1].toDouble() +
               0.0722 * sums.sum[2].toDouble();
        sum2 += sums.sumY2.toDouble();
        n += sums.samples;
    }
    return {sum / n, std::max(0.0, (sum2 - sum * sum / n) / (n - 1)), n};
}

}  // namespace sahl::testing
