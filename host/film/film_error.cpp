#include "film/film_error.h"

#include <cmath>

namespace sahl {

double relativeError(const Film& film)
{
    double sumOfVariances = 0;
    double sumOfMeans = 0;
    size_t pixels = film.half[0].size();
    for (size_t i = 0; i < pixels; i++) {
        double n = 0;
        double y = 0;
        double y2 = 0;
        for (const auto& half : film.half) {
            const HalfPixel& pixel = half[i];
            n += pixel.samples;
            y += 0.2126 * pixel.sum[0].toDouble() + 0.7152 * pixel.sum[1].toDouble() +
                 0.0722 * pixel.sum[2].toDouble();
            y2 += pixel.sumY2.toDouble();
        }
        if (n < 2) return 0;
        double mean = y / n;
        sumOfMeans += mean;
        sumOfVariances += std::fmax(0, (y2 / n - mean * mean) / (n - 1));
    }
    if (pixels == 0 || !(sumOfMeans > 0)) return 0;
    return std::sqrt(sumOfVariances / double(pixels)) / (sumOfMeans / double(pixels));
}

}  // namespace sahl
