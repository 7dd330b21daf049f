// Structural similarity. Wang et al. 2004, "Image Quality Assessment: From Error Visibility to
// Structural Similarity".
#pragma once

#include "compare/plane.h"

namespace sahl {

constexpr uint32_t SSIM_WINDOW = 11;

/// SSIM of every window of 11 x 11 pixels that lies within both planes, by its centre, row by row:
/// (width - 10) * (height - 10) values, none where a side is shorter than 11. Gaussian weights of
/// sigma 1.5, K1 0.01, K2 0.03, values in [0,1].
std::vector<float> ssimMap(const Plane& a, const Plane& b, unsigned threads);

}  // namespace sahl
