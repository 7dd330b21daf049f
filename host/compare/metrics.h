// Errors of one picture against another, by exact definitions. Non-finite pixels are left out and
// counted; docs/compare.md has the formulas.
#pragma once

#include "compare/compare.h"

namespace sahl {

constexpr double METRIC_EPSILON = 0.01;  ///< of relMSE and SMAPE
constexpr double TRIMMED_SHARE = 0.001;  ///< of the values, left out of trimmed measures

/// Mean of all values, and of those without the largest 0.1 %, rounded down to a whole number of
/// them.
Measure trimmedMean(std::vector<double> values);

std::array<ValueCounts, 3> countValues(const Image& image);

/// Whether R, G and B are all finite, for each pixel.
std::vector<bool> finitePixels(const Image& image);

/// All metrics: b is the reference. Both pictures of one size.
Metrics computeMetrics(const LoadedPicture& a, const LoadedPicture& b,
                       const CompareOptions& options);

}  // namespace sahl
