// Pictures in memory and their files: EXR, PNG, PFM and Radiance HDR.
#pragma once

#include "util/files.h"

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sahl {

/// Linear RGB picture, Rec. 709, top row first: pixel (x, y) is at 3 * (y * width + x).
struct Image {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<float> rgb;
};

/// Picture of 8-bit sRGB values, top row first, 3 bytes a pixel.
struct Image8 {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint8_t> rgb;
};

/// Text that goes along with a picture: EXR attributes, PNG text chunks.
using ImageMetadata = std::map<std::string, std::string>;

/// Reads EXR, PFM or HDR, told apart by their first bytes; also packed with gzip. At most 2^28 pixels and 32768 a side.
/// Throws badInput naming the file and what is wrong with it: truncated, wrong magic, zero size.
/// Non-finite values are kept: what they mean is the caller's matter.
Image readImage(const fs::path& path);

/// One more channel of an EXR file, as large as the picture.
struct ImageChannel {
    std::string name;           ///< layer and channel, "albedo.R"
    std::vector<float> values;  ///< width * height, top row first
};

/// One more channel of an EXR file, of 32-bit integers that are read where they lie: that of pixel i is
/// at first + i * stride, pixels as above.
struct IntegerChannel {
    std::string name;
    const std::byte* first = nullptr;
    size_t stride = sizeof(uint32_t);  ///< [bytes]
};

/// Where a picture lies in a larger one [pixels].
struct ImagePlace {
    uint32_t left = 0, top = 0;
    uint32_t fullWidth = 0, fullHeight = 0;
    bool operator==(const ImagePlace&) const = default;
};

/// Encoders: the complete file in memory, to be written by writeFileAtomically.
/// EXR: float32, ZIP; `channels` and `integers` beside R, G and B. With a place the data window is the
/// picture, the display window the larger one.
std::vector<uint8_t> encodeExr(const Image& image, const ImageMetadata& metadata,
                               std::span<const ImageChannel> channels = {},
                               const std::optional<ImagePlace>& place = {},
                               std::span<const IntegerChannel> integers = {});
std::vector<uint8_t> encodePng(const Image8& image, const ImageMetadata& metadata);
std::vector<uint8_t> encodePfm(const Image& image);

}  // namespace sahl
