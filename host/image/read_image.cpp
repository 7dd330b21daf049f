// Finds out what kind of picture a file is and hands it to the reader of that format.
#include "image/image_readers.h"
#include "util/error.h"
#include "util/gzip.h"

#include <algorithm>
#include <string_view>

namespace sahl {

namespace {

constexpr int64_t MAX_SIDE = 32768;
constexpr int64_t MAX_PIXELS = int64_t{1} << 28;

// Plain black packs about 1000 times smaller with zip. Small pictures may do as they like.
constexpr uint64_t FREE_BYTES = uint64_t{256} << 20;
constexpr uint64_t MAX_EXPANSION = 2000;

bool startsWith(std::span<const uint8_t> bytes, std::string_view magic)
{
    return bytes.size() >= magic.size() &&
           std::equal(magic.begin(), magic.end(), bytes.begin(),
                      [](char a, uint8_t b) { return static_cast<uint8_t>(a) == b; });
}

/// What else people hand in, for a message that helps.
std::string_view foreignFormat(std::span<const uint8_t> bytes)
{
    if (startsWith(bytes, "\x89PNG")) return "PNG";
    if (startsWith(bytes, "\xff\xd8\xff")) return "JPEG";
    if (startsWith(bytes, "II*") || startsWith(bytes, "MM")) return "TIFF";
    if (bytes.size() > 1 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '7') return "PNM";
    return "";
}

}  // namespace

std::string printable(std::string_view text)
{
    std::string result = "\"";
    for (char c : text.substr(0, 40)) result += c >= ' ' && c <= '~' ? c : '?';
    return result + (text.size() > 40 ? "...\"" : "\"");
}

void requireImageSize(const ImageFile& file, int64_t width, int64_t height)
{
    if (width <= 0 || height <= 0) {
        throw badInput("{}: the picture is {} x {} pixels, hence empty", file.name, width, height);
    }
    if (width > MAX_SIDE || height > MAX_SIDE || width * height > MAX_PIXELS) {
        throw badInput("{}: {} x {} pixels are too many; at most {} a side and {} in all are read",
                       file.name, width, height, MAX_SIDE, MAX_PIXELS);
    }
    uint64_t decoded = static_cast<uint64_t>(width * height) * 3 * sizeof(float);
    if (decoded > FREE_BYTES && decoded / MAX_EXPANSION > file.bytes.size()) {
        throw badInput("{}: {} bytes cannot hold {} x {} pixels", file.name, file.bytes.size(),
                       width, height);
    }
}

Image makeImage(const ImageFile& file, int64_t width, int64_t height)
{
    requireImageSize(file, width, height);
    Image image;
    image.width = static_cast<uint32_t>(width);
    image.height = static_cast<uint32_t>(height);
    image.rgb.resize(static_cast<size_t>(width) * static_cast<size_t>(height) * 3);
    return image;
}

Image readImage(const fs::path& path)
{
    const std::vector<uint8_t> bytes = readUnpacked(path);
    const ImageFile file = {path.string(), bytes};
    if (startsWith(bytes, "\x76\x2f\x31\x01")) return decodeExr(file);
    if (startsWith(bytes, "PF") || startsWith(bytes, "Pf")) return decodePfm(file);
    if (startsWith(bytes, "#?")) return decodeHdr(file);

    if (bytes.empty()) throw badInput("{}: the file is empty", file.name);
    std::string_view foreign = foreignFormat(bytes);
    throw badInput("{}: is {}, not EXR, PFM or Radiance HDR; convert it to one of these", file.name,
                   foreign.empty() ? "of unknown kind" : foreign);
}

}  // namespace sahl
