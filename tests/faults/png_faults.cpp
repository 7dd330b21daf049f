// PNG files that are damaged or hostile: a right picture or a badInput error that names the file.
#include "image/png_read.h"
#include "support/pictures.h"

#include <zlib.h>

namespace sahl {
namespace {

using namespace sahl::testing;

FileBytes smallPng()
{
    Image8 image = {9, 7, {}};
    for (int i = 0; i < 9 * 7 * 3; i++) image.rgb.push_back(static_cast<uint8_t>(i * 29));
    return encodePng(image, {{"sahl.seed", "1"}});
}

/// "" when it could be read.
std::string pngErrorOf(const FileBytes& bytes)
{
    static const TemporaryFolder folder;
    const fs::path path = folder.path / "a.png";
    fs::remove(path);
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
    try {
        const Image image = readPngPicture(path).srgb;
        EXPECT_EQ(image.rgb.size(), size_t{3} * image.width * image.height);
    } catch (const Error& error) {
        EXPECT_EQ(error.kind, ErrorKind::badInput);
        EXPECT_NE(std::string(error.what()).find("a.png: "), std::string::npos) << error.what();
        return error.what();
    }
    return "";
}

TEST(PngFaults, filesCutAtAnyByte_areRefused)
{
    const FileBytes bytes = smallPng();
    EXPECT_EQ(pngErrorOf(bytes), "");
    for (size_t length = 0; length < bytes.size(); length++) {
        const FileBytes cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length));
        EXPECT_NE(pngErrorOf(cut), "") << length;
    }
}

TEST(PngFaults, flippedBits_areRefusedOrHarmless)
{
    const FileBytes bytes = smallPng();
    for (size_t at = 0; at < bytes.size(); at++) {
        for (int bit = 0; bit < 8; bit += 3) {
            FileBytes flipped = bytes;
            flipped[at] = static_cast<uint8_t>(flipped[at] ^ 1 << bit);
            pngErrorOf(flipped);
        }
    }
}

TEST(PngFaults, enormousPictures_areRefusedBeforeMemoryIsTaken)
{
    FileBytes bytes = smallPng();
    auto put = [&bytes](size_t at, uint32_t value) {
        for (size_t i = 0; i < 4; i++) bytes[at + i] = static_cast<uint8_t>(value >> (24 - 8 * i));
    };
    for (uint32_t side : {32768u, 100000u, 0x7fffffffu}) {
        put(16, side);
        put(20, side);
        put(29, static_cast<uint32_t>(crc32(0, bytes.data() + 12, 17)));
        EXPECT_NE(pngErrorOf(bytes), "") << side;
    }
}

}  // namespace
}  // namespace sahl
