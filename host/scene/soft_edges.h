// Smooth steps and bands, of which procedural probes are drawn.
#pragma once

#include <algorithm>

namespace sahl {

/// 0 below `from`, 1 above `to`, smooth between.
inline double smoothStep(double from, double to, double x)
{
    double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

/// 1 between `lo` and `hi`, 0 outside, half way at both; the edges are 2 * `fade` wide.
inline double softBand(double lo, double hi, double fade, double x)
{
    return smoothStep(lo - fade, lo + fade, x) * (1 - smoothStep(hi - fade, hi + fade, x));
}

}  // namespace sahl
