#include "compare/metrics.h"

#include "compare/display.h"
#include "compare/flip.h"
#include "compare/luminance.h"
#include "compare/ssim.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace sahl {

namespace {

double meanOf(std::span<const double> values)
{
    double sum = 0;
    for (double value : values) sum += value;
    return values.empty() ? UNDEFINED : sum / static_cast<double>(values.size());
}

/// function(a, b) of the three values of every usable pixel.
template <class Function>
Measure over(const Image& a, const Image& b, const std::vector<bool>& usable, Function function)
{
    std::vector<double> terms;
    terms.reserve(a.rgb.size());
    for (size_t i = 0; i < a.rgb.size(); i++) {
        if (usable[i / 3]) terms.push_back(function(double(a.rgb[i]), double(b.rgb[i])));
    }
    return trimmedMean(std::move(terms));
}

double squared(double x)
{
    return x * x;
}

/// Mean absolute error and so on, of linear values.
void addPointwise(const Image& a, const Image& b, const std::vector<bool>& usable, Metrics& metrics)
{
    metrics.mae = over(a, b, usable, [](double x, double r) { return std::fabs(x - r); });
    metrics.mse = over(a, b, usable, [](double x, double r) { return squared(x - r); });
    metrics.rmse = {std::sqrt(metrics.mse.all), std::sqrt(metrics.mse.trimmed)};
    metrics.relMse = over(a, b, usable, [](double x, double r) {
        return squared(x - r) / (squared(r) + METRIC_EPSILON);
    });
    metrics.smape = over(a, b, usable, [](double x, double r) {
        return 2 * std::fabs(x - r) / (std::fabs(x) + std::fabs(r) + METRIC_EPSILON);
    });
}

void addDifferences(const Image& a, const Image& b, const std::vector<bool>& usable,
                    Metrics& metrics)
{
    for (size_t pixel = 0; pixel < usable.size(); pixel++) {
        bool differs = false;
        for (size_t i = 3 * pixel; i < 3 * pixel + 3; i++) {
            differs =
                differs || std::bit_cast<uint32_t>(a.rgb[i]) != std::bit_cast<uint32_t>(b.rgb[i]);
            const double distance = std::fabs(double(a.rgb[i]) - b.rgb[i]);
            if (!usable[pixel] || !(distance > metrics.largestDifference.value)) continue;
            metrics.largestDifference = {static_cast<uint32_t>(pixel % a.width),
                                         static_cast<uint32_t>(pixel / a.width), distance};
        }
        if (differs) metrics.differingPixels++;
    }
}

/// Rec. 709 luma of display values.
Plane lumaOf(const Image& encoded)
{
    Plane plane = {encoded.width, encoded.height, {}};
    for (size_t i = 0; i < encoded.rgb.size(); i += 3) {
        plane.values.push_back(static_cast<float>(luminance(encoded.rgb.data() + i)));
    }
    return plane;
}

/// Mean SSIM of the windows without an unusable pixel; the trimmed one without the least similar.
Measure ssimOf(const Image& a, const Image& b, const std::vector<bool>& usable, unsigned threads)
{
    const std::vector<float> map = ssimMap(lumaOf(a), lumaOf(b), threads);
    std::vector<double> dissimilarity;
    const size_t columns = a.width < SSIM_WINDOW ? 1 : a.width - SSIM_WINDOW + 1;
    for (size_t i = 0; i < map.size(); i++) {
        bool whole = true;
        for (size_t y = 0; y < SSIM_WINDOW && whole; y++) {
            const size_t row = (i / columns + y) * a.width + i % columns;
            for (size_t x = 0; x < SSIM_WINDOW; x++) whole = whole && usable[row + x];
        }
        if (whole) dissimilarity.push_back(1 - map[i]);
    }
    const Measure mean = trimmedMean(std::move(dissimilarity));
    return {1 - mean.all, 1 - mean.trimmed};
}

double decibels(double meanSquaredError)
{
    return 10 * std::log10(1 / meanSquaredError);
}

/// The value at which values from 0 up to it make half of the sum of all.
double weightedMedian(std::vector<double> values)
{
    if (values.empty()) return UNDEFINED;
    std::sort(values.begin(), values.end());
    double sum = 0;
    for (double value : values) sum += value;
    double reached = 0;
    for (double value : values) {
        reached += value;
        if (2 * reached >= sum) return value;
    }
    return values.back();
}

Flip summarized(std::vector<float> map, const std::vector<bool>& usable)
{
    Flip flip;
    std::vector<double> values;
    for (size_t i = 0; i < map.size(); i++) {
        if (usable[i]) {
            values.push_back(map[i]);
        } else {
            map[i] = std::numeric_limits<float>::quiet_NaN();
        }
    }
    if (!values.empty()) flip.largest = *std::max_element(values.begin(), values.end());
    flip.weightedMedian = weightedMedian(values);
    flip.mean = trimmedMean(std::move(values));
    flip.map = std::move(map);
    return flip;
}

/// Filters reach over pixels: those that are not finite in a picture become black in both.
Image withoutUnusable(const Image& image, const std::vector<bool>& usable)
{
    Image result = image;
    for (size_t i = 0; i < result.rgb.size(); i++) {
        if (!usable[i / 3]) result.rgb[i] = 0;
    }
    return result;
}

void addPerceived(const LoadedPicture& a, const LoadedPicture& b, const std::vector<bool>& usable,
                  const CompareOptions& options, Metrics& metrics)
{
    const Image cleanA = withoutUnusable(a.image, usable);
    const Image cleanB = withoutUnusable(b.image, usable);
    auto clipped = [&](const Image& image, const LoadedPicture& of) {
        return clippedForDisplay(image, of.displayReferred ? 0 : options.exposure);
    };
    const Image linearA = clipped(cleanA, a), linearB = clipped(cleanB, b);
    const Image displayA = encodedForDisplay(linearA), displayB = encodedForDisplay(linearB);
    const Measure displayMse =
        over(displayA, displayB, usable, [](double x, double r) { return squared(x - r); });
    metrics.psnr = {decibels(displayMse.all), decibels(displayMse.trimmed)};
    metrics.ssim = ssimOf(displayA, displayB, usable, options.threads);

    metrics.ldrFlip =
        summarized(ldrFlipMap(linearB, linearA, options.pixelsPerDegree, options.threads), usable);
    if (a.displayReferred || b.displayReferred) return;
    std::vector<double> exposures = hdrFlipExposures(cleanB);
    metrics.hdrFlip = summarized(
        hdrFlipMap(cleanB, cleanA, exposures, options.pixelsPerDegree, options.threads), usable);
    metrics.hdrFlip->exposures = std::move(exposures);
}

}  // namespace

Measure trimmedMean(std::vector<double> values)
{
    Measure result;
    result.all = meanOf(values);
    const auto dropped = static_cast<size_t>(TRIMMED_SHARE * static_cast<double>(values.size()));
    const size_t kept = values.size() - dropped;
    const auto end = values.begin() + static_cast<std::ptrdiff_t>(kept);
    if (dropped > 0) std::nth_element(values.begin(), end, values.end());
    result.trimmed = dropped > 0 ? meanOf(std::span(values).first(kept)) : result.all;
    return result;
}

std::array<ValueCounts, 3> countValues(const Image& image)
{
    std::array<ValueCounts, 3> counts;
    for (size_t i = 0; i < image.rgb.size(); i++) {
        const float value = image.rgb[i];
        ValueCounts& channel = counts[i % 3];
        if (std::isnan(value)) channel.nan++;
        if (std::isinf(value)) channel.infinite++;
        if (value < 0) channel.negative++;
    }
    return counts;
}

std::vector<bool> finitePixels(const Image& image)
{
    std::vector<bool> finite(image.rgb.size() / 3);
    for (size_t i = 0; i < finite.size(); i++) {
        const float* rgb = image.rgb.data() + 3 * i;
        finite[i] = std::isfinite(rgb[0]) && std::isfinite(rgb[1]) && std::isfinite(rgb[2]);
    }
    return finite;
}

Metrics computeMetrics(const LoadedPicture& a, const LoadedPicture& b,
                       const CompareOptions& options)
{
    Metrics metrics;
    const std::vector<bool> finiteA = finitePixels(a.image), finiteB = finitePixels(b.image);
    std::vector<bool> usable(finiteA.size());
    for (size_t i = 0; i < usable.size(); i++) {
        usable[i] = finiteA[i] && finiteB[i];
        if (usable[i]) metrics.pixels++;
        if (finiteA[i] != finiteB[i]) metrics.unmatchedPixels++;
    }
    metrics.excludedPixels = usable.size() - metrics.pixels;
    addDifferences(a.image, b.image, usable, metrics);
    addPointwise(a.image, b.image, usable, metrics);
    addPerceived(a, b, usable, options, metrics);
    return metrics;
}

}  // namespace sahl
