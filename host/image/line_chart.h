// Lines over an axis: how one number grows with another.
#pragma once

#include "image/axis.h"
#include "image/drawing.h"

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace sahl {

struct ChartLine {
    std::string name;
    std::vector<std::pair<double, double>> points;  ///< x and y, finite and > 0, x ascending
};

/// Both axes are logarithmic. The one across reaches from the least to the greatest value, the upright one
/// over a decade at least, so that noise does not look like growth.
struct LineChart {
    std::string title;  ///< what is written of both axes: letters as drawText() has them
    std::vector<ChartLine> lines;
};

/// The charts below each other; lines without points are left out.
Image8 drawCharts(std::span<const LineChart> charts);

}  // namespace sahl
