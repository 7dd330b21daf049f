// JPEG in, through libjpeg-turbo, from memory. The library goes on with grey where data is missing
// or damaged, and only warns; here such a warning ends the reading.
#include "image/image_readers.h"
#include "util/error.h"

// The library's headers rely on these.
#include <cstddef>
#include <cstdio>

#include <jerror.h>
#include <jpeglib.h>

#include <csetjmp>
#include <string>

namespace sahl {

namespace {

/// A hostile progressive file can ask for ever more scans of a picture; honest ones have about ten.
constexpr int MAX_SCANS = 500;

/// What libjpeg's callbacks work on. libjpeg is C: nothing may be thrown through it.
struct JpegErrors {
    jpeg_error_mgr library;  // first, so that the library's pointer is one to all of it
    std::jmp_buf jump;
    char text[JMSG_LENGTH_MAX];
};

[[noreturn]] void keepError(j_common_ptr info)
{
    auto* errors = reinterpret_cast<JpegErrors*>(info->err);
    errors->library.format_message(info, errors->text);
    std::longjmp(errors->jump, 1);
}

/// Whether a warning is about something that changes no pixel.
bool isHarmless(int code)
{
    return code == JWRN_ADOBE_XFORM || code == JWRN_BOGUS_ICC || code == JWRN_EXTRANEOUS_DATA ||
           code == JWRN_JFIF_MAJOR;
}

void keepWarning(j_common_ptr info, int level)
{
    if (level < 0 && !isHarmless(info->err->msg_code)) keepError(info);
}

void beSilent(j_common_ptr) {}

void boundScans(j_common_ptr info)
{
    auto* errors = reinterpret_cast<JpegErrors*>(info->err);
    const auto* decoder = reinterpret_cast<j_decompress_ptr>(info);
    if (decoder->input_scan_number <= MAX_SCANS) return;
    std::snprintf(errors->text, sizeof errors->text, "it has more than %d scans", MAX_SCANS);
    std::longjmp(errors->jump, 1);
}

/// Destroys libjpeg's structs, whatever happens.
struct JpegReader {
    JpegErrors errors = {};
    jpeg_progress_mgr progress = {};
    jpeg_decompress_struct decoder = {};

    JpegReader()
    {
        decoder.err = jpeg_std_error(&errors.library);
        errors.library.error_exit = keepError;
        errors.library.emit_message = keepWarning;
        errors.library.output_message = beSilent;
        progress.progress_monitor = boundScans;
    }
    ~JpegReader() { jpeg_destroy_decompress(&decoder); }
    JpegReader(const JpegReader&) = delete;
    JpegReader& operator=(const JpegReader&) = delete;
};

/// No object with a destructor lives in here, nor in readRows.
bool readHeader(JpegReader& reader, std::span<const uint8_t> bytes)
{
    if (setjmp(reader.errors.jump) != 0) return false;
    jpeg_create_decompress(&reader.decoder);
    reader.decoder.progress = &reader.progress;
    jpeg_mem_src(&reader.decoder, bytes.data(), bytes.size());
    jpeg_read_header(&reader.decoder, TRUE);
    return true;
}

/// `row` has room for 3 bytes a pixel.
bool readRows(JpegReader& reader, uint8_t* row, uint32_t* texels)
{
    if (setjmp(reader.errors.jump) != 0) return false;
    jpeg_decompress_struct& decoder = reader.decoder;
    decoder.out_color_space = JCS_RGB;
    decoder.dct_method = JDCT_ISLOW;  // the one that is the same on every processor
    jpeg_start_decompress(&decoder);
    while (decoder.output_scanline < decoder.output_height) {
        uint32_t* target = texels + size_t{decoder.output_scanline} * decoder.output_width;
        jpeg_read_scanlines(&decoder, &row, 1);
        for (size_t x = 0; x < decoder.output_width; x++)
            target[x] = packTexel(row[3 * x], row[3 * x + 1], row[3 * x + 2], 255);
    }
    jpeg_finish_decompress(&decoder);
    return true;
}

}  // namespace

TexelImage decodeJpegTexels(const ImageFile& file)
{
    JpegReader reader;
    auto damagedJpeg = [&] {
        return badInput("{}: damaged JPEG: {}", file.name, reader.errors.text);
    };
    if (!readHeader(reader, file.bytes)) throw damagedJpeg();
    const J_COLOR_SPACE space = reader.decoder.jpeg_color_space;
    if (space == JCS_CMYK || space == JCS_YCCK) {
        throw badInput("{}: is a JPEG with the four inks of print (CMYK); convert it to RGB",
                       file.name);
    }
    TexelImage image =
        makeTexelImage(file, reader.decoder.image_width, reader.decoder.image_height);
    std::vector<uint8_t> row(size_t{3} * image.width);
    if (!readRows(reader, row.data(), image.rgba.data())) throw damagedJpeg();
    return image;
}

}  // namespace sahl
