// Colours as FLIP sees them: an opponent space to filter in, and one to measure differences in.
// Andersson et al. 2020, "FLIP: A Difference Evaluator for Alternating Images", Sec. 4.1.
#pragma once

namespace sahl {

struct Color3 {
    double x = 0, y = 0, z = 0;
};

/// Linear Rec. 709 to Y Cx Cz, CIELAB made linear: Y in [-16, 100].
Color3 opponentFromLinear(const Color3& rgb);
Color3 linearFromOpponent(const Color3& ycc);

/// Linear Rec. 709 in [0,1] to CIELAB (D65) with the Hunt adjustment: chroma counts less in the
/// dark.
Color3 huntLabFromLinear(const Color3& rgb);

/// Distance for large differences: of lightness along an axis, of chroma in the plane.
/// Abasi et al. 2020, "Distancing from the ideal: HyAB".
double hyabDistance(const Color3& a, const Color3& b);

}  // namespace sahl
