// How the values of a picture are distributed: exact counts, and plots of them.
#pragma once

#include "image/axis.h"
#include "image/drawing.h"

#include <span>
#include <string>

namespace sahl {

/// Counts in bins of equal width. Bin i holds low + [i, i + 1) * (high - low) / bins; the last one
/// holds `high` too. When both ends are equal, the bin in the middle holds that value.
struct Histogram {
    double low = 0, high = 1;
    std::vector<uint64_t> counts;
};

/// From the smallest value to the largest, or over [0,1]. Values must be finite, and within [0,1]
/// for the latter. No value is left out: the counts add up to their number.
Histogram histogramOfRange(std::span<const float> values, size_t bins);
Histogram histogramOfUnit(std::span<const float> values, size_t bins);

/// Plots with titles, one below the other, on white: values to the right, counts up on a
/// logarithmic axis from 1 on, so that a single value shows beside millions.
struct HistogramPlot {
    std::string title;  ///< see drawText()
    Histogram histogram;
};
Image8 plotHistograms(std::span<const HistogramPlot> plots);

}  // namespace sahl
