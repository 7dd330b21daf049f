// From linear pictures to 8-bit ones.
#include "film/film.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sahl {

namespace {

/// `value` in [0,1] to the nearest of 0 ... 255.
uint8_t quantize(double value)
{
    return static_cast<uint8_t>(std::floor(value * 255.0 + 0.5));
}

/// Linear [0,1] to sRGB [0,1]. IEC 61966-2-1.
double encodeSrgb(double linear)
{
    if (linear <= 0.0031308) return 12.92 * linear;
    return 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

/// The value at rank p * (n - 1) of the sorted values, linear between neighbours. 0 <= p <= 1.
/// Reorders `values`.
double percentile(std::vector<float>& values, double p)
{
    const double rank = p * static_cast<double>(values.size() - 1);
    const auto below = values.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(values.begin(), below, values.end());
    const double low = *below;
    if (below + 1 == values.end()) return low;
    const double high = *std::min_element(below + 1, values.end());
    return low + (rank - std::floor(rank)) * (high - low);
}

/// Linear from `low` -> 0 to `high` -> 1; mid grey everywhere when the two are equal.
void mapRange(const std::vector<float>& values, double low, double high, std::vector<uint8_t>& out)
{
    for (size_t i = 0; i < values.size(); i++) {
        const double position = low < high ? (values[i] - low) / (high - low) : 0.5;
        out[i] = quantize(std::clamp(position, 0.0, 1.0));
    }
}

}  // namespace

Image8 toneMap(const Image& image, ToneMap how, float exposure)
{
    assert(image.rgb.size() == size_t{3} * image.width * image.height);
    Image8 result = {image.width, image.height, std::vector<uint8_t>(image.rgb.size())};
    if (image.rgb.empty()) return result;
    std::vector<float> values = image.rgb;
    for (float& value : values) value = std::isfinite(value) ? value : 0.0f;

    if (how == ToneMap::srgb) {
        // 300 stops span all floats: beyond, all is black or white.
        const double gain = std::exp2(std::clamp(static_cast<double>(exposure), -300.0, 300.0));
        for (size_t i = 0; i < values.size(); i++) {
            result.rgb[i] = quantize(encodeSrgb(std::clamp(values[i] * gain, 0.0, 1.0)));
        }
    } else if (how == ToneMap::naive) {
        const auto [low, high] = std::minmax_element(values.begin(), values.end());
        mapRange(values, *low, *high, result.rgb);
    } else {
        std::vector<float> pool = values;
        const double low = percentile(pool, 0.05);
        const double high = percentile(pool, 0.95);
        mapRange(values, low, high, result.rgb);
    }
    return result;
}

}  // namespace sahl
