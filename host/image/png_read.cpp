// Through libpng, from memory.
#include "image/png_read.h"

#include "image/image_readers.h"
#include "util/error.h"

#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstring>
#include <new>

namespace sahl {

namespace {

/// What libpng's callbacks work on. libpng is C: nothing may be thrown through it.
struct PngInput {
    std::span<const uint8_t> bytes;
    size_t pos = 0;
    std::string failure;
};

struct PngInfo {
    uint32_t width = 0, height = 0;
    bool hadAlpha = false;
};

void takeBytes(png_structp png, png_bytep target, size_t size)
{
    auto* input = static_cast<PngInput*>(png_get_io_ptr(png));
    if (size > input->bytes.size() - input->pos) png_error(png, "is truncated");
    std::memcpy(target, input->bytes.data() + input->pos, size);
    input->pos += size;
}

[[noreturn]] void keepError(png_structp png, png_const_charp text)
{
    static_cast<PngInput*>(png_get_error_ptr(png))->failure = text;
    png_longjmp(png, 1);
}

void ignoreWarning(png_structp, png_const_charp) {}

/// How the values of a row are wanted.
enum class Row {
    rgb16,  ///< 6 bytes a pixel, in the byte order of the file
    rgba8,  ///< 4 bytes a pixel
};

/// No object with a destructor lives in here.
bool readHeader(png_structp png, png_infop info, Row row, PngInfo& result)
{
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_read_info(png, info);
    result.width = png_get_image_width(png, info);
    result.height = png_get_image_height(png, info);
    result.hadAlpha = (png_get_color_type(png, info) & PNG_COLOR_MASK_ALPHA) != 0 ||
                      png_get_valid(png, info, PNG_INFO_tRNS) != 0;
    if (row == Row::rgb16) {
        png_set_expand_16(png);
        png_set_strip_alpha(png);
    } else {
        png_set_expand(png);
        png_set_scale_16(png);
        png_set_add_alpha(png, 255, PNG_FILLER_AFTER);
    }
    png_set_gray_to_rgb(png);
    png_set_interlace_handling(png);
    png_read_update_info(png, info);
    return true;
}

bool readRows(png_structp png, png_infop info, png_bytepp rows)
{
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_read_image(png, rows);
    png_read_end(png, info);  // texts may stand behind the pixels
    return true;
}

ImageMetadata textsOf(png_structp png, png_infop info)
{
    ImageMetadata metadata;
    png_textp texts = nullptr;
    int count = 0;
    png_get_text(png, info, &texts, &count);
    for (int i = 0; i < count; i++) metadata[texts[i].key] = texts[i].text ? texts[i].text : "";
    return metadata;
}

/// Destroys libpng's structs, whatever happens.
struct PngReader {
    png_structp png = nullptr;
    png_infop info = nullptr;

    explicit PngReader(PngInput& input)
    {
        png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &input, keepError, ignoreWarning);
        info = png != nullptr ? png_create_info_struct(png) : nullptr;
        if (info == nullptr) {
            png_destroy_read_struct(&png, &info, nullptr);
            throw std::bad_alloc();
        }
        png_set_read_fn(png, &input, takeBytes);
    }
    ~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;
};

Error damagedPng(const ImageFile& file, const std::string& finding)
{
    return badInput("{}: damaged PNG: {}", file.name, finding);
}

/// Reads all rows, one behind the other.
std::vector<uint8_t> readBody(const ImageFile& file, PngReader& reader, const PngInput& input,
                              size_t rowBytes, size_t height)
{
    if (png_get_rowbytes(reader.png, reader.info) != rowBytes)
        throw damagedPng(file, "rows of an unexpected length");
    std::vector<uint8_t> bytes(rowBytes * height);
    std::vector<png_bytep> rows;
    for (size_t y = 0; y < height; y++) rows.push_back(bytes.data() + y * rowBytes);
    if (!readRows(reader.png, reader.info, rows.data())) throw damagedPng(file, input.failure);
    return bytes;
}

}  // namespace

PngPicture readPngPicture(const fs::path& path)
{
    const std::vector<uint8_t> bytes = readFile(path);
    const ImageFile file = {path.string(), bytes};
    PngInput input = {bytes, 0, {}};
    PngReader reader(input);
    PngInfo info;
    if (!readHeader(reader.png, reader.info, Row::rgb16, info))
        throw damagedPng(file, input.failure);
    PngPicture picture;
    picture.hadAlpha = info.hadAlpha;
    picture.srgb = makeImage(file, info.width, info.height);
    const std::vector<uint8_t> words =
        readBody(file, reader, input, size_t{6} * info.width, info.height);
    for (size_t i = 0; i < picture.srgb.rgb.size(); i++) {
        const int value = words[2 * i] << 8 | words[2 * i + 1];
        picture.srgb.rgb[i] = static_cast<float>(value) / 65535.0f;
    }
    picture.metadata = textsOf(reader.png, reader.info);
    return picture;
}

TexelImage decodePngTexels(const ImageFile& file)
{
    PngInput input = {file.bytes, 0, {}};
    PngReader reader(input);
    PngInfo info;
    if (!readHeader(reader.png, reader.info, Row::rgba8, info))
        throw damagedPng(file, input.failure);
    TexelImage image = makeTexelImage(file, info.width, info.height);
    const std::vector<uint8_t> bytes =
        readBody(file, reader, input, size_t{4} * info.width, info.height);
    for (size_t i = 0; i < image.rgba.size(); i++)
        image.rgba[i] =
            packTexel(bytes[4 * i], bytes[4 * i + 1], bytes[4 * i + 2], bytes[4 * i + 3]);
    return image;
}

}  // namespace sahl
