#include "compare/display.h"

#include "image/tone_map.h"

#include <algorithm>
#include <cmath>

namespace sahl {

Image clippedForDisplay(const Image& image, double stops)
{
    const double gain = std::exp2(stops);
    Image result = image;
    for (float& value : result.rgb) {
        value =
            std::isfinite(value) ? static_cast<float>(std::clamp(value * gain, 0.0, 1.0)) : 0.0f;
    }
    return result;
}

Image encodedForDisplay(const Image& clipped)
{
    Image result = clipped;
    for (float& value : result.rgb) value = static_cast<float>(srgbFromLinear(value));
    return result;
}

}  // namespace sahl
