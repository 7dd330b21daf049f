// FLIP: how much two pictures seem to differ when one flips between them.
//   LDR-FLIP  Andersson et al. 2020, "FLIP: A Difference Evaluator for Alternating Images", HPG
//   HDR-FLIP  Andersson et al. 2021, "Visualizing Errors in Rendered High Dynamic Range Images", EG
#pragma once

#include "image/image.h"

#include <vector>

namespace sahl {

/// Pixels per degree of the visual field: a display of 3840 pixels and 0.7 m, seen from 0.7 m.
constexpr double FLIP_PIXELS_PER_DEGREE = 67.0206;

/// Error of each pixel in [0,1]. Both pictures linear Rec. 709, of one size, values in [0,1].
std::vector<float> ldrFlipMap(const Image& reference, const Image& test, double pixelsPerDegree,
                              unsigned threads);

/// Exposures [stops] that HDR-FLIP looks at: from where the brightest pixel of the reference has tone
/// mapped luminance 0.85 up to where the median one has, as many as there are stops between, at least 2.
/// Where the median is 0, that of the luminances above 0; a single 0 for a black reference.
std::vector<double> hdrFlipExposures(const Image& reference);

/// The largest LDR-FLIP of each pixel over these exposures, under a fit of the ACES tone curve.
/// Pictures linear and finite; negative values count as 0.
std::vector<float> hdrFlipMap(const Image& reference, const Image& test,
                              const std::vector<double>& exposures, double pixelsPerDegree,
                              unsigned threads);

}  // namespace sahl
