#include "image/texel_image.h"

#include "image/image_readers.h"
#include "util/error.h"

#include <algorithm>

namespace sahl {

namespace {

bool startsWith(std::span<const uint8_t> bytes, std::string_view magic)
{
    return bytes.size() >= magic.size() &&
           std::equal(magic.begin(), magic.end(), bytes.begin(),
                      [](char a, uint8_t b) { return static_cast<uint8_t>(a) == b; });
}

}  // namespace

TexelImage makeTexelImage(const ImageFile& file, int64_t width, int64_t height)
{
    requireImageSize(file, width, height);
    if (static_cast<uint64_t>(width * height) > MAX_TEXTURE_PIXELS) {
        throw badInput(
            "{}: {} x {} pixels are too many for a texture; at most {} are read; scale it down",
            file.name, width, height, MAX_TEXTURE_PIXELS);
    }
    TexelImage image;
    image.width = static_cast<uint32_t>(width);
    image.height = static_cast<uint32_t>(height);
    image.rgba.resize(size_t{image.width} * image.height);
    return image;
}

TexelImage decodeTexels(const std::string& name, std::span<const uint8_t> bytes)
{
    const ImageFile file = {name, bytes};
    if (startsWith(bytes, "\x89PNG")) return decodePngTexels(file);
    if (startsWith(bytes, "\xff\xd8\xff")) return decodeJpegTexels(file);
    if (bytes.empty()) throw badInput("{}: the file is empty", name);
    throw badInput("{}: is neither PNG nor JPEG; textures are read from these; convert it", name);
}

TexelImage readTexels(const fs::path& path)
{
    constexpr uint64_t MOST_BYTES = uint64_t{1} << 30;
    const std::vector<uint8_t> bytes = readFile(path, MOST_BYTES);
    return decodeTexels(path.string(), bytes);
}

}  // namespace sahl
