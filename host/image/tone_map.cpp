#include "image/tone_map.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sahl {

double srgbFromLinear(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double linearFromSrgb(double srgb)
{
    return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

namespace {

double encode(double value, double gamma)
{
    if (gamma == SRGB_GAMMA) return srgbFromLinear(value);
    return gamma == 1 ? value : std::pow(value, 1 / gamma);
}

/// A fit to the Academy's ACES curve for ordinary displays: Narkowicz 2016, "ACES Filmic Tone
/// Mapping Curve". 0 stays 0, 1 becomes 0.80, 7.24 and more become 1.
double filmic(double x)
{
    x = std::max(x, 0.0);
    return std::min(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 1.0);
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

bool fitsRange(ToneOperator op)
{
    return op == ToneOperator::naive || op == ToneOperator::percentile;
}

}  // namespace

double ToneCurve::operator()(double value) const
{
    double result = 0;
    if (op == ToneOperator::filmic) {
        result = filmic(value * gain);
    } else if (op == ToneOperator::exposure) {
        result = std::clamp(value * gain, 0.0, 1.0);
    } else {
        result = low < high ? std::clamp((value - low) / (high - low), 0.0, 1.0) : 0.5;
    }
    return encode(result, gamma);
}

std::vector<float> finiteValues(const Image& image)
{
    std::vector<float> values = image.rgb;
    for (float& value : values) value = std::isfinite(value) ? value : 0.0f;
    return values;
}

ToneCurve fitToneCurve(const Image& image, const ToneMap& map)
{
    ToneCurve curve;
    curve.op = map.op;
    curve.gamma = map.gamma.value_or(fitsRange(map.op) ? 1 : SRGB_GAMMA);
    // 300 stops span all floats: beyond, all is black or white.
    curve.gain = std::exp2(std::clamp(map.stops, -300.0, 300.0));
    if (!fitsRange(map.op) || image.rgb.empty()) return curve;
    std::vector<float> values = finiteValues(image);
    if (map.op == ToneOperator::naive) {
        const auto [low, high] = std::minmax_element(values.begin(), values.end());
        curve.low = *low;
        curve.high = *high;
    } else {
        curve.low = percentile(values, 0.05);
        curve.high = percentile(values, 0.95);
    }
    return curve;
}

Image8 applyToneCurve(const Image& image, const ToneCurve& curve)
{
    assert(image.rgb.size() == size_t{3} * image.width * image.height);
    Image8 result = {image.width, image.height, std::vector<uint8_t>(image.rgb.size())};
    for (size_t i = 0; i < image.rgb.size(); i++) {
        const float value = std::isfinite(image.rgb[i]) ? image.rgb[i] : 0.0f;
        result.rgb[i] = static_cast<uint8_t>(std::floor(curve(double{value}) * 255 + 0.5));
    }
    return result;
}

Image8 toneMap(const Image& image, const ToneMap& map)
{
    return applyToneCurve(image, fitToneCurve(image, map));
}

}  // namespace sahl
