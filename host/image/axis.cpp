#include "image/axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sahl {

namespace {

/// The smallest of 1, 2, 5 times a power of ten that is not below `least`.
double roundStep(double least)
{
    const double power = std::pow(10, std::floor(std::log10(least)));
    for (double factor : {1.0, 2.0, 5.0}) {
        if (factor * power >= least) return factor * power;
    }
    return 10 * power;
}

std::vector<double> roundNumbers(const Axis& axis, double spacing)
{
    std::vector<double> numbers;
    if (axis.logarithmic) {
        const double first = std::ceil(std::log10(axis.low)), last = std::log10(axis.high);
        const double step = std::max(1.0, std::ceil(spacing * (last - std::log10(axis.low))));
        for (double e = first; e < last; e += step) numbers.push_back(std::pow(10, e));
    } else {
        const double step = roundStep(spacing * (axis.high - axis.low));
        const double first = std::ceil(axis.low / step);
        const int most = static_cast<int>(1 / spacing) + 1;  // rounding must not make it endless
        for (int i = 0; i <= most && (first + i) * step < axis.high; i++) {
            numbers.push_back((first + i) * step);
        }
    }
    return numbers;
}

}  // namespace

double Axis::position(double value) const
{
    if (!(low < high)) return 0.5;
    if (value <= low) return 0;
    if (value >= high) return 1;
    if (logarithmic) return std::log(value / low) / std::log(high / low);
    return (value - low) / (high - low);
}

std::vector<Tick> ticksOf(const Axis& axis, double spacing)
{
    std::vector<Tick> ticks = {{axis.low, axisLabel(axis.low)}};
    if (!(axis.low < axis.high)) return ticks;
    const double apart = spacing * (1 - 1e-9);  // rounded
    for (double value : roundNumbers(axis, spacing)) {
        const double at = axis.position(value);
        const bool free = at - axis.position(ticks.back().value) >= apart && 1 - at >= apart;
        if (free) ticks.push_back({value, axisLabel(value)});
    }
    ticks.push_back({axis.high, axisLabel(axis.high)});
    return ticks;
}

std::string axisLabel(double value)
{
    if (value == 0) return "0";  // also -0
    if (std::abs(value) >= 1e4 && std::abs(value) < 1e7 && value == std::floor(value)) {
        return fmt::format("{:.0f}", value);  // counts in full
    }
    std::string text = fmt::format("{:.4g}", value);
    const size_t e = text.find('e');
    if (e == std::string::npos) return text;
    std::string exponent = text.substr(e + 1);  // "+06", "-12"
    std::string sign = exponent.front() == '-' ? "-" : "";
    exponent.erase(0, std::min(exponent.find_first_not_of("+-0"), exponent.size() - 1));
    return text.substr(0, e) + "e" + sign + exponent;
}

}  // namespace sahl
