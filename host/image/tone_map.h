// From linear pictures to 8-bit ones: an operator brings values into [0,1], a code spends the 8
// bits.
#pragma once

#include "image/image.h"

#include <optional>

namespace sahl {

enum class ToneOperator {
    naive,       ///< the smallest RGB value becomes 0, the largest 1; linear between
    percentile,  ///< the 5th percentile of all RGB values becomes 0, the 95th 1; linear between
    exposure,    ///< times 2^stops, clipped to [0,1]
    filmic,      ///< times 2^stops, then a curve with a toe and a shoulder
};

struct ToneMap {
    ToneOperator op = ToneOperator::percentile;
    double stops = 0;  ///< exposure and filmic only
    /// Encoding of what the operator gives: v^(1/gamma), or the sRGB curve where gamma is
    /// SRGB_GAMMA. Nothing given: linear for naive and percentile, sRGB for exposure and filmic.
    std::optional<double> gamma = {};
};

constexpr double SRGB_GAMMA = 0;

/// The sRGB curve (IEC 61966-2-1) of a value in [0,1].
double srgbFromLinear(double linear);

/// Its inverse.
double linearFromSrgb(double srgb);

/// A tone map that has been fitted to a picture: what it does to one value.
struct ToneCurve {
    ToneOperator op = ToneOperator::exposure;
    double low = 0, high = 1;  ///< naive, percentile: become 0 and 1; mid grey when they are equal
    double gain = 1;           ///< exposure, filmic
    double gamma = 1;          ///< or SRGB_GAMMA

    /// In [0,1]. `value` must be finite.
    double operator()(double value) const;
};

/// Non-finite values count as 0, here and in what follows.
ToneCurve fitToneCurve(const Image& image, const ToneMap& map);
Image8 applyToneCurve(const Image& image, const ToneCurve& curve);

/// 8-bit picture: both of these.
Image8 toneMap(const Image& image, const ToneMap& map);

/// All RGB values, 0 in place of those that are not finite.
std::vector<float> finiteValues(const Image& image);

}  // namespace sahl
