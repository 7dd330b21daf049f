// Pictures and picture files for tests.
#pragma once

#include "image/image.h"
#include "support/temporary_folder.h"
#include "util/error.h"

#include <bit>
#include <cstring>
#include <fstream>
#include <random>
#include <string_view>

namespace sahl::testing {

using FileBytes = std::vector<uint8_t>;

inline FileBytes bytesOf(std::string_view text)
{
    return {text.begin(), text.end()};
}

inline FileBytes operator+(FileBytes a, const FileBytes& b)
{
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

/// Writes the bytes to a file and reads it as a picture.
inline Image readBytes(const FileBytes& bytes)
{
    static const TemporaryFolder folder;
    const fs::path path = folder.path / "picture";
    fs::remove(path);  // some file systems write truncated files to the disk at once
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
    return readImage(path);
}

/// The text of the badInput error that reading these bytes gives, without the file's name; "" when
/// they can be read.
inline std::string errorOf(const FileBytes& bytes)
{
    try {
        readBytes(bytes);
    } catch (const Error& error) {
        EXPECT_EQ(error.kind, ErrorKind::badInput);
        const std::string text = error.what();
        EXPECT_NE(text.find("picture: "), std::string::npos) << text;
        return text.substr(text.find("picture: ") + 9);
    }
    return "";
}

/// What one reads out of a picture that tells rows, columns and channels apart:
/// value = 100 y + 10 x + channel.
inline Image numberedImage(uint32_t width, uint32_t height)
{
    Image image = {width, height, {}};
    for (uint32_t y = 0; y < height; y++) {
        for (uint32_t x = 0; x < width; x++) {
            for (uint32_t c = 0; c < 3; c++) {
                image.rgb.push_back(static_cast<float>(100 * y + 10 * x + c));
            }
        }
    }
    return image;
}

/// Any bit patterns: NaNs, infinities, denormals and both zeros among them.
inline Image randomBitsImage(uint32_t width, uint32_t height, uint32_t seed)
{
    std::mt19937 random(seed);
    Image image = {width, height, std::vector<float>(size_t{3} * width * height)};
    for (float& value : image.rgb) value = std::bit_cast<float>(uint32_t(random()));
    const uint32_t special[] = {0x00000000u, 0x80000000u, 0x00000001u, 0x7f7fffffu,
                                0x7f800000u, 0xff800000u, 0x7fc00001u, 0x3f800000u};
    for (size_t i = 0; i < std::size(special) && i < image.rgb.size(); i++) {
        image.rgb[i] = std::bit_cast<float>(special[i]);
    }
    return image;
}

inline void expectSameBits(const Image& a, const Image& b)
{
    ASSERT_EQ(a.width, b.width);
    ASSERT_EQ(a.height, b.height);
    ASSERT_EQ(a.rgb.size(), b.rgb.size());
    EXPECT_EQ(std::memcmp(a.rgb.data(), b.rgb.data(), a.rgb.size() * sizeof(float)), 0);
}

}  // namespace sahl::testing
