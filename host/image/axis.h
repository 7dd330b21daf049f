// An axis from one value to another, linear or logarithmic, with round numbers to write beside it.
#pragma once

#include <string>
#include <vector>

namespace sahl {

struct Axis {
    double low = 0, high = 1;  ///< finite, low <= high; logarithmic: low > 0
    bool logarithmic = false;

    /// 0 at low, 1 at high; clipped to [0,1]. 1/2 everywhere when the two are equal.
    double position(double value) const;
};

struct Tick {
    double value;
    std::string label;  ///< "0", "2500", "1.5e-6"
};

/// Both ends of the axis and, between them, round numbers (1, 2 or 5 times a power of ten; powers
/// of ten alone on a logarithmic axis), so that neighbours are at least `spacing` of the axis
/// apart.
std::vector<Tick> ticksOf(const Axis& axis, double spacing);

/// Up to 4 significant digits.
std::string axisLabel(double value);

}  // namespace sahl
