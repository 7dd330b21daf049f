// PNG in. Apart from readImage: a PNG holds what a display is to show, not radiance.
#pragma once

#include "image/image.h"

namespace sahl {

struct PngPicture {
    Image srgb;              ///< sRGB-coded values in [0,1]; grey as RGB, without alpha
    ImageMetadata metadata;  ///< texts
    bool hadAlpha = false;
};

/// Reads a PNG of any kind, 8 or 16 bits a value. Throws badInput naming the file and what is wrong
/// with it; a damaged file is refused as a whole.
PngPicture readPngPicture(const fs::path& path);

}  // namespace sahl
