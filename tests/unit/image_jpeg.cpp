// JPEG files as texels.
#include "image/texel_image.h"
#include "support/jpeg_files.h"

#include <gtest/gtest.h>

namespace sahl {
namespace {

using namespace sahl::testing;

int valueOf(uint32_t texel, int channel)
{
    return static_cast<int>(texel >> (8 * channel) & 255);
}

/// A picture that the format keeps to a value or two at the best quality: it is smooth.
FileBytes smoothSamples(int width, int height, int channels)
{
    FileBytes samples;
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            for (int c = 0; c < channels; c++)
                samples.push_back(static_cast<uint8_t>(40 + 3 * x + 5 * y + 20 * c));
        }
    }
    return samples;
}

void expectSmooth(const TexelImage& image, int channels)
{
    ASSERT_EQ(image.width, 21u);
    ASSERT_EQ(image.height, 13u);
    for (int y = 0; y < 13; y++) {
        for (int x = 0; x < 21; x++) {
            const uint32_t texel = image.rgba[static_cast<size_t>(y * 21 + x)];
            for (int c = 0; c < 3; c++) {
                const int expected = 40 + 3 * x + 5 * y + (channels == 3 ? 20 * c : 0);
                EXPECT_NEAR(valueOf(texel, c), expected, 2) << x << " " << y << " " << c;
            }
            EXPECT_EQ(valueOf(texel, 3), 255);
        }
    }
}

TEST(JpegRead, readsColoursGreysAndProgressiveFiles)
{
    for (const bool progressive : {false, true}) {
        for (const int channels : {1, 3}) {
            const FileBytes bytes =
                makeJpeg(21, 13, smoothSamples(21, 13, channels), {channels, 100, progressive});
            expectSmooth(decodeTexels("a.jpg", bytes), channels);
        }
    }
}

TEST(JpegRead, refusesTheInksOfPrint)
{
    const FileBytes bytes = makeJpeg(8, 8, smoothSamples(8, 8, 4), {4});
    try {
        decodeTexels("a.jpg", bytes);
        FAIL() << "CMYK was read";
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(),
                     "a.jpg: is a JPEG with the four inks of print (CMYK); convert it to RGB");
    }
}

}  // namespace
}  // namespace sahl
