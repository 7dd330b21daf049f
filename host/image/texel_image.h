// Pictures as textures want them, of PNG and JPEG files: the values of the file, 8 bits each, with
// alpha.
#pragma once

#include "util/files.h"

#include <span>
#include <string>
#include <vector>

namespace sahl {

/// Top row first; a texel is one number, red in its lowest byte, then green, blue and alpha.
struct TexelImage {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint32_t> rgba;
};

inline uint32_t packTexel(uint32_t red, uint32_t green, uint32_t blue, uint32_t alpha)
{
    return red | green << 8 | blue << 16 | alpha << 24;
}

/// Decodes a PNG (of any kind; 16 bits a value are rounded to 8) or a JPEG (grey or YCbCr), told
/// apart by their first bytes. Grey becomes RGB; alpha is 255 where the file has none. What a file
/// says of gamma, colour profiles and orientation is not applied. Throws badInput that begins with
/// `name` and says what is wrong: neither format, more than MAX_TEXTURE_PIXELS, damaged anywhere
/// (nothing half read is returned).
TexelImage decodeTexels(const std::string& name, std::span<const uint8_t> bytes);

/// decodeTexels of a file.
TexelImage readTexels(const fs::path& path);

constexpr uint64_t MAX_TEXTURE_PIXELS = uint64_t{1} << 27;

}  // namespace sahl
