// PNG files read back into memory, by libpng's simplified interface.
#pragma once

#include "image/image.h"

#include <gtest/gtest.h>
#include <png.h>

namespace sahl::testing {

/// Empty, and a failure of the test, when the file cannot be read.
inline Image8 readPng(const fs::path& path)
{
    png_image png = {};
    png.version = PNG_IMAGE_VERSION;
    Image8 image;
    if (png_image_begin_read_from_file(&png, path.c_str()) != 0) {
        png.format = PNG_FORMAT_RGB;
        image = {png.width, png.height, std::vector<uint8_t>(PNG_IMAGE_SIZE(png))};
        png_image_finish_read(&png, nullptr, image.rgb.data(), 0, nullptr);
    }
    EXPECT_EQ(png.warning_or_error, 0u) << path << ": " << png.message;
    png_image_free(&png);
    return image;
}

}  // namespace sahl::testing
