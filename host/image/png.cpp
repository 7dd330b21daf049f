// PNG out, through libpng into memory: 8-bit RGB in sRGB, with text.
#include "image/image.h"

#include <png.h>

#include <cassert>
#include <csetjmp>
#include <new>
#include <stdexcept>

namespace sahl {

namespace {

/// What libpng's callbacks work on. libpng is C: nothing may be thrown through it.
struct PngOutput {
    std::vector<uint8_t> bytes;
    std::string failure;
};

void appendBytes(png_structp png, png_bytep data, size_t size)
{
    auto* output = static_cast<PngOutput*>(png_get_io_ptr(png));
    bool appended = true;
    try {
        output->bytes.insert(output->bytes.end(), data, data + size);
    } catch (const std::bad_alloc&) {
        appended = false;
    }
    if (!appended) png_error(png, "out of memory");
}

void flushNothing(png_structp) {}

[[noreturn]] void keepError(png_structp png, png_const_charp text)
{
    static_cast<PngOutput*>(png_get_error_ptr(png))->failure = text;
    png_longjmp(png, 1);
}

void ignoreWarning(png_structp, png_const_charp) {}

/// Text chunks in the order of the metadata, UTF-8. They point into it.
std::vector<png_text> textChunks(const ImageMetadata& metadata)
{
    std::vector<png_text> chunks;
    for (const auto& [name, text] : metadata) {
        assert(!name.empty() && name.size() <= 79);  // what the format allows for a keyword
        png_text chunk = {};
        chunk.compression = PNG_ITXT_COMPRESSION_NONE;
        chunk.key = const_cast<char*>(name.c_str());
        chunk.text = const_cast<char*>(text.c_str());
        chunk.itxt_length = text.size();
        chunks.push_back(chunk);
    }
    return chunks;
}

/// All calls of libpng that may jump out. No object with a destructor lives in here.
/// Returns false after a failure.
bool writePng(png_structp png, png_infop info, const Image8& image,
              const std::vector<png_text>& texts)
{
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_set_IHDR(png, info, image.width, image.height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    if (!texts.empty()) png_set_text(png, info, texts.data(), static_cast<int>(texts.size()));
    png_write_info(png, info);
    for (uint32_t y = 0; y < image.height; y++) {
        png_write_row(png, image.rgb.data() + size_t{3} * y * image.width);
    }
    png_write_end(png, info);
    return true;
}

}  // namespace

std::vector<uint8_t> encodePng(const Image8& image, const ImageMetadata& metadata)
{
    assert(image.width > 0 && image.height > 0);
    assert(image.rgb.size() == size_t{3} * image.width * image.height);
    PngOutput output;
    const std::vector<png_text> texts = textChunks(metadata);
    png_structp png =
        png_create_write_struct(PNG_LIBPNG_VER_STRING, &output, keepError, ignoreWarning);
    png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
    bool written = false;
    if (info != nullptr) {
        png_set_write_fn(png, &output, appendBytes, flushNothing);
        written = writePng(png, info, image, texts);
    }
    png_destroy_write_struct(&png, &info);
    if (!written) throw std::runtime_error("PNG encoder: " + output.failure);
    return std::move(output.bytes);
}

}  // namespace sahl
