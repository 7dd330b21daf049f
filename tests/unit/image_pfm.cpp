// PFM files written by hand, with the values they must have.
#include "support/gzip_files.h"
#include "support/pictures.h"

#include <cmath>

namespace sahl {
namespace {

using namespace sahl::testing;

FileBytes littleEndian(std::initializer_list<float> values)
{
    FileBytes bytes;
    for (float value : values) {
        for (int shift = 0; shift < 32; shift += 8) {
            bytes.push_back(static_cast<uint8_t>(std::bit_cast<uint32_t>(value) >> shift));
        }
    }
    return bytes;
}

FileBytes bigEndian(std::initializer_list<float> values)
{
    FileBytes bytes = littleEndian(values);
    for (size_t i = 0; i < bytes.size(); i += 4) {
        std::swap(bytes[i], bytes[i + 3]);
        std::swap(bytes[i + 1], bytes[i + 2]);
    }
    return bytes;
}

TEST(Pfm, readPfm_undoesEncodePfmBitForBit)
{
    const Image image = randomBitsImage(7, 5, 1);
    expectSameBits(readBytes(encodePfm(image)), image);
}

TEST(Pfm, readPfm_unpacksGzip)
{
    const Image image = randomBitsImage(7, 5, 2);
    const FileBytes plain = encodePfm(image);
    expectSameBits(readBytes(bytesOf(packed({plain.begin(), plain.end()}))), image);
}

TEST(Pfm, encodePfm_writesBottomRowFirst)
{
    const Image image = {1, 2, {1, 2, 3, 4, 5, 6}};
    EXPECT_EQ(encodePfm(image), bytesOf("PF\n1 2\n-1.0\n") + littleEndian({4, 5, 6, 1, 2, 3}));
}

TEST(Pfm, readPfm_returnsTopRowFirst)
{
    const Image image = readBytes(bytesOf("PF\n1 2\n-1.0\n") + littleEndian({4, 5, 6, 1, 2, 3}));
    expectSameBits(image, {1, 2, {1, 2, 3, 4, 5, 6}});
}

TEST(Pfm, readPfm_takesBigEndianForPositiveScale)
{
    const Image image = readBytes(bytesOf("PF 2 1 1\n") + bigEndian({1, 2, 3, 4, 5, 6.5f}));
    expectSameBits(image, {2, 1, {1, 2, 3, 4, 5, 6.5f}});
}

TEST(Pfm, readPfm_spreadsGreyOverThreeChannels)
{
    const Image image = readBytes(bytesOf("Pf\n2 1\n-1\n") + littleEndian({0.25f, 8}));
    expectSameBits(image, {2, 1, {0.25f, 0.25f, 0.25f, 8, 8, 8}});
}

TEST(Pfm, readPfm_multipliesBySizeOfScale)
{
    expectSameBits(readBytes(bytesOf("Pf\n1 1\n-2.5\n") + littleEndian({4})), {1, 1, {10, 10, 10}});
    expectSameBits(readBytes(bytesOf("Pf\n1 1\n+0.5\n") + bigEndian({4})), {1, 1, {2, 2, 2}});
}

TEST(Pfm, readPfm_keepsNonFiniteValues)
{
    const Image image = readBytes(bytesOf("PF\n1 1\n-1\n") + littleEndian({NAN, INFINITY, -1}));
    EXPECT_TRUE(std::isnan(image.rgb[0]));
    EXPECT_EQ(image.rgb[1], INFINITY);
    EXPECT_EQ(image.rgb[2], -1);
}

TEST(Pfm, readPfm_refusesScaleThatIsZeroOrNotFinite)
{
    for (const char* scale : {"0", "-0.0", "nan", "inf", "-inf", "1e99", "x", "1x"}) {
        const std::string text = fmt::format("Pf\n1 1\n{}\n", scale);
        EXPECT_NE(errorOf(bytesOf(text) + littleEndian({4})).find("scale"), std::string::npos)
            << scale;
    }
}

TEST(Pfm, readPfm_acceptsCarriageReturnAndLineFeed)
{
    const Image image = readBytes(bytesOf("Pf\r\n1 1\r\n-1.0\r\n") + littleEndian({3}));
    expectSameBits(image, {1, 1, {3, 3, 3}});
}

TEST(Pfm, readPfm_takesLineFeedAfterCarriageReturnAsPixelWhenTheLengthSaysSo)
{
    const Image image = readBytes(bytesOf("Pf\n1 1\n-1.0\r\n") + FileBytes{0, 0x80, 0x3f});
    EXPECT_EQ(std::bit_cast<uint32_t>(image.rgb[0]), 0x3f80000au);
}

TEST(Pfm, readPfm_warnsOfTrailingBytesAndReads)
{
    ::testing::internal::CaptureStderr();
    const Image image = readBytes(bytesOf("Pf\n1 1\n-1\n") + littleEndian({3}) + bytesOf("abc"));
    const std::string warning = ::testing::internal::GetCapturedStderr();
    EXPECT_NE(warning.find("3 bytes after the last pixel"), std::string::npos) << warning;
    expectSameBits(image, {1, 1, {3, 3, 3}});
}

TEST(Pfm, readPfm_saysHowMuchIsMissing)
{
    EXPECT_EQ(errorOf(bytesOf("Pf\n2 1\n-1\n") + littleEndian({3})),
              "is truncated: 2 x 1 pixels need 8 bytes, 4 are there");
}

}  // namespace
}  // namespace sahl
