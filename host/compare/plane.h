// One number a pixel, and filters over it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace sahl {

struct Plane {
    uint32_t width = 0, height = 0;
    std::vector<float> values;  ///< top row first
};

/// Convolution with the outer product of two kernels of odd length, along rows and along columns.
/// Beyond the border the outermost pixel repeats. kernel[0] meets the leftmost (topmost) pixel.
Plane convolve(const Plane& plane, std::span<const float> alongRows,
               std::span<const float> alongColumns, unsigned threads);

/// exp(-x^2 / (2 sigma^2)) at x = -radius ... radius, with the sum 1.
std::vector<float> gaussianKernel(double sigma, int radius);

}  // namespace sahl
