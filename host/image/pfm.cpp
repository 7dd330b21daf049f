// PFM: a text header of three fields, then raw float32 rows from the bottom to the top.
#include "image/image_readers.h"
#include "util/error.h"

#include <bit>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string_view>

namespace sahl {

namespace {

struct PfmHeader {
    uint32_t channels = 0;  // 1 or 3
    int64_t width = 0;      // [pixels]
    int64_t height = 0;
    float scale = 0;  // what all values are multiplied by, > 0
    bool bigEndian = false;
    size_t pixelStart = 0;  // offset of the first value in the file
};

bool isSpace(uint8_t c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/// The next word of the header; `pos` ends up at the byte behind it. "" at the end of the file.
std::string_view nextWord(std::span<const uint8_t> bytes, size_t& pos)
{
    while (pos < bytes.size() && isSpace(bytes[pos])) pos++;
    size_t start = pos;
    while (pos < bytes.size() && !isSpace(bytes[pos])) pos++;
    return {reinterpret_cast<const char*>(bytes.data()) + start, pos - start};
}

template <class Number>
Number parseField(const ImageFile& file, std::string_view word, std::string_view what)
{
    if (word.starts_with('+')) word.remove_prefix(1);
    Number value{};
    auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty() || error != std::errc{} || end != word.data() + word.size()) {
        throw badInput("{}: PFM header: {} is not a number: {}", file.name, what, printable(word));
    }
    return value;
}

/// The header ends with one white-space byte. Writers on Windows end it with two, which shows in
/// a file that is one byte too long.
size_t findPixels(std::span<const uint8_t> bytes, size_t pos, size_t pixelBytes)
{
    bool crLf = pos + 1 < bytes.size() && bytes[pos] == '\r' && bytes[pos + 1] == '\n';
    if (crLf && bytes.size() - (pos + 2) == pixelBytes) return pos + 2;
    return pos + 1;
}

PfmHeader parsePfmHeader(const ImageFile& file)
{
    PfmHeader header;
    size_t pos = 0;
    std::string_view magic = nextWord(file.bytes, pos);
    if (magic != "PF" && magic != "Pf") {
        throw badInput("{}: PFM header: \"PF\" and \"Pf\" are read, nothing else", file.name);
    }
    header.channels = magic == "PF" ? 3 : 1;
    header.width = parseField<int64_t>(file, nextWord(file.bytes, pos), "the width");
    header.height = parseField<int64_t>(file, nextWord(file.bytes, pos), "the height");
    float scale = parseField<float>(file, nextWord(file.bytes, pos), "the scale");
    if (!std::isfinite(scale) || scale == 0) {
        throw badInput("{}: PFM header: the scale is {}; it must be finite and not zero", file.name,
                       scale);
    }
    requireImageSize(file, header.width, header.height);
    header.scale = std::fabs(scale);
    header.bigEndian = scale > 0;

    size_t pixelBytes = static_cast<size_t>(header.width * header.height) * header.channels * 4;
    header.pixelStart = findPixels(file.bytes, pos, pixelBytes);
    size_t have = header.pixelStart < file.bytes.size() ? file.bytes.size() - header.pixelStart : 0;
    if (have < pixelBytes) {
        throw badInput("{}: is truncated: {} x {} pixels need {} bytes, {} are there", file.name,
                       header.width, header.height, pixelBytes, have);
    }
    if (have > pixelBytes) {
        warn(fmt::format("{}: {} bytes after the last pixel are ignored", file.name,
                         have - pixelBytes));
    }
    return header;
}

uint32_t loadWord(const uint8_t* bytes, bool bigEndian)
{
    uint32_t b0 = bytes[0], b1 = bytes[1], b2 = bytes[2], b3 = bytes[3];
    return bigEndian ? b0 << 24 | b1 << 16 | b2 << 8 | b3 : b3 << 24 | b2 << 16 | b1 << 8 | b0;
}

}  // namespace

Image decodePfm(const ImageFile& file)
{
    const PfmHeader header = parsePfmHeader(file);
    Image image = makeImage(file, header.width, header.height);
    const uint8_t* next = file.bytes.data() + header.pixelStart;
    for (uint32_t row = image.height; row-- > 0;) {
        float* pixel = &image.rgb[size_t{3} * row * image.width];
        for (uint32_t x = 0; x < image.width; x++, pixel += 3) {
            for (uint32_t c = 0; c < header.channels; c++, next += 4) {
                pixel[c] = std::bit_cast<float>(loadWord(next, header.bigEndian));
                if (header.scale != 1) pixel[c] *= header.scale;
            }
            if (header.channels == 1) pixel[1] = pixel[2] = pixel[0];
        }
    }
    return image;
}

std::vector<uint8_t> encodePfm(const Image& image)
{
    assert(image.rgb.size() == size_t{3} * image.width * image.height);
    static_assert(std::endian::native == std::endian::little);
    const std::string header = fmt::format("PF\n{} {}\n-1.0\n", image.width, image.height);
    std::vector<uint8_t> bytes(header.begin(), header.end());
    bytes.resize(header.size() + image.rgb.size() * sizeof(float));
    const size_t rowFloats = size_t{3} * image.width;
    uint8_t* next = bytes.data() + header.size();
    for (uint32_t row = image.height; row-- > 0; next += rowFloats * sizeof(float)) {
        std::memcpy(next, image.rgb.data() + row * rowFloats, rowFloats * sizeof(float));
    }
    return bytes;
}

}  // namespace sahl
