// Textures that are damaged or hostile: a whole picture or a badInput error that names the file.
#include "image/texel_image.h"
#include "support/assets.h"
#include "support/jpeg_files.h"

#include <gtest/gtest.h>

namespace sahl {
namespace {

using namespace sahl::testing;

/// "" when it could be read.
std::string texelErrorOf(const FileBytes& bytes)
{
    try {
        const TexelImage image = decodeTexels("a.jpg", bytes);
        EXPECT_EQ(image.rgba.size(), size_t{image.width} * image.height);
        EXPECT_FALSE(image.rgba.empty());
    } catch (const Error& error) {
        EXPECT_EQ(error.kind, ErrorKind::badInput);
        EXPECT_EQ(std::string(error.what()).find("a.jpg: "), 0u) << error.what();
        return error.what();
    }
    return "";
}

FileBytes smallJpeg(bool progressive)
{
    FileBytes samples;
    for (int i = 0; i < 19 * 11 * 3; i++) samples.push_back(static_cast<uint8_t>(i * 29));
    return makeJpeg(19, 11, samples, {3, 80, progressive});
}

FileBytes smallPng()
{
    Image8 image = {9, 7, {}};
    for (int i = 0; i < 9 * 7 * 3; i++) image.rgb.push_back(static_cast<uint8_t>(i * 29));
    return encodePng(image, {});
}

TEST(TexelFaults, filesCutAtAnyByte_areRefused)
{
    for (const FileBytes& bytes : {smallJpeg(false), smallJpeg(true), smallPng()}) {
        EXPECT_EQ(texelErrorOf(bytes), "");
        for (size_t length = 0; length < bytes.size(); length++) {
            const FileBytes cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length));
            EXPECT_NE(texelErrorOf(cut), "") << length << " of " << bytes.size();
        }
    }
}

TEST(TexelFaults, flippedBits_areRefusedOrHarmless)
{
    for (const FileBytes& bytes : {smallJpeg(false), smallJpeg(true)}) {
        for (size_t at = 0; at < bytes.size(); at++) {
            for (int bit = 0; bit < 8; bit += 3) {
                FileBytes flipped = bytes;
                flipped[at] = static_cast<uint8_t>(flipped[at] ^ 1 << bit);
                texelErrorOf(flipped);
            }
        }
    }
}

TEST(TexelFaults, enormousPictures_areRefusedBeforeMemoryIsTaken)
{
    for (const bool progressive : {false, true}) {
        FileBytes bytes = smallJpeg(progressive);
        const FileBytes start = {0xff, static_cast<uint8_t>(progressive ? 0xc2 : 0xc0), 0, 17, 8};
        const auto frame = std::search(bytes.begin(), bytes.end(), start.begin(), start.end());
        ASSERT_NE(frame, bytes.end());
        std::fill(frame + 5, frame + 9, uint8_t{0x7f});
        EXPECT_NE(texelErrorOf(bytes).find("32639 x 32639"), std::string::npos)
            << texelErrorOf(bytes);
    }
}

TEST(TexelFaults, otherFiles_areRefusedWithAnAdvice)
{
    EXPECT_EQ(texelErrorOf({}), "a.jpg: the file is empty");
    EXPECT_EQ(texelErrorOf(bytesOf("GIF89a")),
              "a.jpg: is neither PNG nor JPEG; textures are read from these; convert it");
}

/// What others have collected: files that crashed or stalled a reader.
TEST(TexelFaults, hostileFilesOfOthers_areReadWholeOrRefused)
{
    SAHL_REQUIRE_ASSET("bad/jpeg-oiio");
    size_t bombs = 0;
    for (const char* folder : {"bad/jpeg-oiio", "bad/png-pngsuite"}) {
        for (const auto& entry : fs::directory_iterator(assetFolder() / folder)) {
            const std::string name = entry.path().filename().string();
            try {
                const TexelImage image = readTexels(entry.path());
                EXPECT_EQ(image.rgba.size(), size_t{image.width} * image.height);
                EXPECT_NE(name[0], 'x') << name << " is damaged and was read";
                EXPECT_EQ(name.find("bomb"), std::string::npos) << name << " was read";
            } catch (const Error& error) {
                EXPECT_EQ(error.kind, ErrorKind::badInput);
                bombs += name.find("bomb") != std::string::npos ? 1 : 0;
            }
        }
    }
    EXPECT_EQ(bombs, 2u);
}

}  // namespace
}  // namespace sahl
