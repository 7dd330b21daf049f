#include "film/film_error.h"

#include "film/replicates.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sahl {

namespace {

/// Sums of samples, and their mean luminance.
struct Luminances {
    double samples = 0, replicates = 0, sum = 0, sumOfSquares = 0;

    void add(const HalfPixel& half, uint32_t replicateSize)
    {
        samples += half.samples;
        replicates += replicatesIn(half.samples, replicateSize);
        sum += 0.2126 * half.sum[0].toDouble() + 0.7152 * half.sum[1].toDouble() +
               0.0722 * half.sum[2].toDouble();
        sumOfSquares += half.sumY2.toDouble();
    }

    double mean() const { return samples > 0 ? sum / samples : 0; }

    /// Replicates r of n_r samples and mean y_r spread around the mean by sum n_r (y_r - y)^2. That is R - 1
    /// times n_r Var(y_r), whose share of the mean's variance is 1 / samples.
    double varianceOfMean() const
    {
        if (replicates < 2) return 0;
        const double spread = sumOfSquares / samples - mean() * mean();
        return std::fmax(0, spread / (replicates - 1));
    }
};

}  // namespace

PixelStatistics pixelStatistics(const Film& film, size_t pixel)
{
    Luminances a, b;
    a.add(film.half[0][pixel], film.replicateSize);
    b.add(film.half[1][pixel], film.replicateSize);
    Luminances both = a;
    both.add(film.half[1][pixel], film.replicateSize);
    if (!film.halvesWeighEqually || !(a.samples > 0) || !(b.samples > 0))
        return {both.samples, both.replicates, both.mean(), both.varianceOfMean()};
    double variance = (a.varianceOfMean() + b.varianceOfMean()) / 4;
    if (a.replicates < 2 || b.replicates < 2) {
        // A half that does not know its own spread has that of both.
        variance = both.varianceOfMean() * both.samples * (1 / a.samples + 1 / b.samples) / 4;
    }
    return {both.samples, both.replicates, (a.mean() + b.mean()) / 2, variance};
}

std::vector<double> pixelErrors(const Film& film)
{
    const size_t pixels = film.half[0].size();
    std::vector<PixelStatistics> statistics;
    std::vector<double> luminances;
    for (size_t i = 0; i < pixels; i++) {
        statistics.push_back(pixelStatistics(film, i));
        luminances.push_back(statistics.back().luminance);
    }
    double floor = 0;
    if (!luminances.empty()) {
        auto middle = luminances.begin() + static_cast<std::ptrdiff_t>(pixels / 2);
        std::ranges::nth_element(luminances, middle);
        floor = 0.01 * *middle;
    }
    std::vector<double> errors;
    for (const PixelStatistics& pixel : statistics) {
        const double relativeTo = std::fmax(pixel.luminance, floor);
        const double error = relativeTo > 0 ? std::sqrt(pixel.varianceOfMean) / relativeTo : 0;
        errors.push_back(pixel.replicates < 2 ? std::numeric_limits<double>::infinity() : error);
    }
    return errors;
}

FilmError filmError(const Film& film, double target)
{
    const std::vector<double> errors = pixelErrors(film);
    if (errors.empty()) return {};
    double mean = 0, variance = 0;
    for (size_t i = 0; i < errors.size(); i++) {
        const PixelStatistics pixel = pixelStatistics(film, i);
        mean += pixel.luminance;
        variance += pixel.varianceOfMean;
    }
    FilmError result;
    result.ofFrameMean = mean > 0 ? std::sqrt(variance) / mean : 0;
    const auto reached = std::ranges::count_if(errors, [&](double error) { return error <= target; });
    result.reachedShare = double(reached) / double(errors.size());
    return result;
}

double relativeError(const Film& film)
{
    double sumOfVariances = 0;
    double sumOfMeans = 0;
    size_t pixels = film.half[0].size();
    for (size_t i = 0; i < pixels; i++) {
        PixelStatistics pixel = pixelStatistics(film, i);
        if (pixel.replicates < 2) return 0;
        sumOfMeans += pixel.luminance;
        sumOfVariances += pixel.varianceOfMean;
    }
    if (pixels == 0 || !(sumOfMeans > 0)) return 0;
    return std::sqrt(sumOfVariances / double(pixels)) / (sumOfMeans / double(pixels));
}

}  // namespace sahl
