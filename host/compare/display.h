// What a display shows of a picture: the values in [0,1] that PSNR, SSIM and LDR-FLIP are defined
// over.
#pragma once

#include "image/image.h"

namespace sahl {

/// Times 2^stops, clipped to [0,1]; still linear. What is not finite becomes 0.
Image clippedForDisplay(const Image& image, double stops);

/// The same with sRGB-coded values.
Image encodedForDisplay(const Image& clipped);

}  // namespace sahl
