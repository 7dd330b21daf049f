// JPEG files in memory, made by libjpeg-turbo.
#pragma once

#include "support/pictures.h"

#include <cstddef>
#include <cstdio>

#include <jpeglib.h>

#include <cstdlib>

namespace sahl::testing {

struct JpegKind {
    int channels = 3;  ///< 1: grey, 3: RGB, 4: CMYK
    int quality = 100;
    bool progressive = false;
};

/// `samples` in rows, top row first.
inline FileBytes makeJpeg(uint32_t width, uint32_t height, FileBytes samples,
                          const JpegKind& kind = {})
{
    jpeg_compress_struct encoder = {};
    jpeg_error_mgr errors = {};
    encoder.err = jpeg_std_error(&errors);
    jpeg_create_compress(&encoder);
    unsigned char* memory = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&encoder, &memory, &size);
    encoder.image_width = width;
    encoder.image_height = height;
    encoder.input_components = kind.channels;
    encoder.in_color_space =
        kind.channels == 1 ? JCS_GRAYSCALE : (kind.channels == 3 ? JCS_RGB : JCS_CMYK);
    jpeg_set_defaults(&encoder);
    jpeg_set_quality(&encoder, kind.quality, TRUE);
    for (int i = 0; i < encoder.num_components; i++)
        encoder.comp_info[i].h_samp_factor = encoder.comp_info[i].v_samp_factor = 1;
    if (kind.progressive) jpeg_simple_progression(&encoder);
    jpeg_start_compress(&encoder, TRUE);
    const size_t rowBytes = samples.size() / height;
    while (encoder.next_scanline < height) {
        uint8_t* row = samples.data() + encoder.next_scanline * rowBytes;
        jpeg_write_scanlines(&encoder, &row, 1);
    }
    jpeg_finish_compress(&encoder);
    jpeg_destroy_compress(&encoder);
    FileBytes bytes(memory, memory + size);
    std::free(memory);
    return bytes;
}

}  // namespace sahl::testing
