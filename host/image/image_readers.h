// The readers behind readImage, one per format. Each gets the whole file and throws badInput.
#pragma once

#include "image/image.h"
#include "image/texel_image.h"

#include <span>
#include <string_view>

namespace sahl {

/// An input file in memory. `name` is for messages.
struct ImageFile {
    std::string name;
    std::span<const uint8_t> bytes;
};

/// A piece of the file for a message: quotes around at most 40 characters, '?' for what would not
/// print.
std::string printable(std::string_view text);

/// Throws badInput unless a picture of this size is within the limits of readImage and believable
/// for a file of this length: no format of ours packs large pictures 2000 times smaller.
void requireImageSize(const ImageFile& file, int64_t width, int64_t height);

/// A black picture of that size, after requireImageSize.
Image makeImage(const ImageFile& file, int64_t width, int64_t height);

Image decodePfm(const ImageFile& file);
Image decodeHdr(const ImageFile& file);
Image decodeExr(const ImageFile& file);

/// A picture of that size for decodeTexels, whose limits are checked.
TexelImage makeTexelImage(const ImageFile& file, int64_t width, int64_t height);

TexelImage decodePngTexels(const ImageFile& file);
TexelImage decodeJpegTexels(const ImageFile& file);

}  // namespace sahl
