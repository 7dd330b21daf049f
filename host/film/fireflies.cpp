#include "film/fireflies.h"

#include "film/film_error.h"

#include <algorithm>

namespace sahl {

namespace {

constexpr double LEAST_REPLICATES = 8;
constexpr double LEAST_SHARE = 0.25;
constexpr double LEAST_TIMES_DUE = 4;
constexpr double LEAST_TIMES_AROUND = 2;
constexpr double DARKEST = 0.1;  // of the mean, that around counts for at least
constexpr int REACH = 2;         // [pixels] of what is around

double sumOf(const std::vector<double>& values)
{
    double sum = 0;
    for (double value : values) sum += value;
    return sum;
}

/// Median of the pixels around one of them, itself left out.
double medianAround(const Film& film, const std::vector<double>& luminances, int x, int y)
{
    const int width = static_cast<int>(film.width), height = static_cast<int>(film.height);
    std::vector<double> around;
    for (int j = std::max(0, y - REACH); j <= std::min(height - 1, y + REACH); j++) {
        for (int i = std::max(0, x - REACH); i <= std::min(width - 1, x + REACH); i++) {
            if (i != x || j != y) around.push_back(luminances[size_t(j) * film.width + size_t(i)]);
        }
    }
    if (around.empty()) return 0;
    const auto middle = around.begin() + static_cast<std::ptrdiff_t>(around.size() / 2);
    std::ranges::nth_element(around, middle);
    return *middle;
}

/// Of the light y_1 + ... + y_R of a pixel's replicates one has at least the share (sum y^2) / (sum
/// y)^2, as the largest y times sum y is at least sum y^2.
double shareOfOne(const Film& film, size_t pixel, double replicates)
{
    double samples = 0, sum = 0, squares = 0;
    for (const auto& halves : film.half) {
        const HalfPixel& half = halves[pixel];
        samples += half.samples;
        sum += 0.2126 * half.sum[0].toDouble() + 0.7152 * half.sum[1].toDouble() +
               0.0722 * half.sum[2].toDouble();
        squares += half.sumY2.toDouble();
    }
    // The squares are of the replicates' means, times the samples in each
    return sum > 0 ? std::min(1.0, samples / replicates * squares / (sum * sum)) : 0;
}

}  // namespace

std::vector<Firefly> firefliesOf(const Film& film)
{
    std::vector<double> luminances, replicates;
    for (size_t i = 0; i < film.half[0].size(); i++) {
        const PixelStatistics pixel = pixelStatistics(film, i);
        luminances.push_back(pixel.luminance);
        replicates.push_back(pixel.replicates);
    }
    const double mean = luminances.empty() ? 0 : sumOf(luminances) / double(luminances.size());
    std::vector<Firefly> found;
    for (size_t i = 0; i < luminances.size(); i++) {
        if (replicates[i] < LEAST_REPLICATES || !(luminances[i] > 0)) continue;
        const double share = shareOfOne(film, i, replicates[i]);
        if (share < std::max(LEAST_SHARE, LEAST_TIMES_DUE / replicates[i])) continue;
        Firefly firefly;
        firefly.x = static_cast<uint32_t>(i % film.width);
        firefly.y = static_cast<uint32_t>(i / film.width);
        firefly.luminance = luminances[i];
        firefly.around =
            std::max(DARKEST * mean, medianAround(film, luminances, static_cast<int>(firefly.x),
                                                  static_cast<int>(firefly.y)));
        firefly.share = share;
        if (firefly.luminance >= LEAST_TIMES_AROUND * firefly.around) found.push_back(firefly);
    }
    std::ranges::stable_sort(found, std::greater{}, &Firefly::excess);
    return found;
}

double excessShare(const Film& film, const std::vector<Firefly>& fireflies)
{
    double excess = 0, sum = 0;
    for (const Firefly& firefly : fireflies) excess += firefly.excess();
    for (size_t i = 0; i < film.half[0].size(); i++) sum += pixelStatistics(film, i).luminance;
    return sum > 0 ? excess / sum : 0;
}

ImageChannel fireflyChannel(const Film& film, const std::vector<Firefly>& fireflies)
{
    ImageChannel channel = {"firefly.Y", std::vector<float>(film.half[0].size())};
    for (const Firefly& firefly : fireflies) {
        channel.values[size_t{firefly.y} * film.width + firefly.x] =
            static_cast<float>(firefly.luminance / firefly.around);
    }
    return channel;
}

}  // namespace sahl
