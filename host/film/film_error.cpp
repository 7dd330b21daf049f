#include "film/film_error.h"

#include <cmath>

namespace sahl {

PixelStatistics pixelStatistics(const Film& film, size_t pixel)
{
    PixelStatistics result;
    double y = 0;
    double y2 = 0;
    for (const auto& half : film.half) {
        const HalfPixel& sums = half[pixel];
        result.samples += sums.samples;
        y += 0.2126 * sums.sum[0].toDouble() + 0.7152 * sums.sum[1].toDouble() +
             0.0722 * sums.sum[2].toDouble();
        y2 += sums.sumY2.toDouble();
    }
    double n = result.samples;
    if (n == 0) return result;
    result.luminance = y / n;
    if (n > 1) {
        double spread = y2 / n - result.luminance * result.luminance;
        result.varianceOfMean = std::fmax(0, spread / (n - 1));
    }
    return result;
}

double relativeError(const Film& film)
{
    double sumOfVariances = 0;
    double sumOfMeans = 0;
    size_t pixels = film.half[0].size();
    for (size_t i = 0; i < pixels; i++) {
        PixelStatistics pixel = pixelStatistics(film, i);
        if (pixel.samples < 2) return 0;
        sumOfMeans += pixel.luminance;
        sumOfVariances += pixel.varianceOfMean;
    }
    if (pixels == 0 || !(sumOfMeans > 0)) return 0;
    return std::sqrt(sumOfVariances / double(pixels)) / (sumOfMeans / double(pixels));
}

}  // namespace sahl
