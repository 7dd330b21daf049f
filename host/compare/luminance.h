// Luminance of linear Rec. 709, as the film counts it.
#pragma once

#include <algorithm>

namespace sahl {

inline double luminance(const float* rgb)
{
    return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

/// With channels below `least` counted as that.
inline double luminance(const float* rgb, float least)
{
    const float clipped[3] = {std::max(rgb[0], least), std::max(rgb[1], least),
                              std::max(rgb[2], least)};
    return luminance(clipped);
}

}  // namespace sahl
