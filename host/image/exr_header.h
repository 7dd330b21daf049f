// A first look at an EXR file with code of our own: whether it is of the plain kind that we read,
// before the library sees it.
#pragma once

#include "image/image_readers.h"

#include <map>

namespace sahl {

/// What a channel's values are, as the file numbers it.
enum class ExrKind : uint32_t { integer = 0, half = 1, real = 2 };

struct ExrChannel {
    ExrKind kind = ExrKind::real;
    bool fullResolution = true;  // one value a pixel
    bool operator==(const ExrChannel&) const = default;
};

/// Corners, both of them inside [pixels].
struct ExrWindow {
    int64_t minX = 0, minY = 0, maxX = 0, maxY = 0;
    bool operator==(const ExrWindow&) const = default;
};

struct ExrHeader {
    int32_t minX = 0, minY = 0;      // data window, top left [pixels]
    uint32_t width = 0, height = 0;  // of the data window
    bool rec709 = true;              // no other primaries are named
    bool cropped = false;            // the data window is not the displayed one
    bool grey = false;               // Y instead of R, G, B
    ExrWindow display;
    std::map<std::string, ExrChannel> channels;
    ImageMetadata texts;  // attributes that are strings
};

/// Throws badInput unless the file begins like an EXR file.
void requireExrMagic(const ImageFile& file);

/// Throws badInput unless the file is a single-part picture (scanlines or tiles, any compression)
/// with channels R, G, B or Y at full resolution, within the limits of readImage, and long enough
/// to hold its own table of chunks.
ExrHeader checkExrHeader(const ImageFile& file);

}  // namespace sahl
