// Radiance HDR files written by hand, with the values they must have.
#include "support/pictures.h"

namespace sahl {
namespace {

using namespace sahl::testing;

const std::string RGBE = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n";

FileBytes hdr(const std::string& resolution, const FileBytes& pixels,
              const std::string& header = RGBE)
{
    return bytesOf(header + "\n" + resolution + "\n") + pixels;
}

FileBytes repeated(const FileBytes& bytes, int count)
{
    FileBytes all;
    for (int i = 0; i < count; i++) all = all + bytes;
    return all;
}

TEST(Hdr, readHdr_readsFlatPixels)
{
    // m * 2^(E - 136): exponent 136 stands for the mantissa itself, 128 for 1/256 of it.
    const FileBytes pixels = {1, 2, 255, 136, 128, 64, 0, 129, 9, 9, 9, 0};
    expectSameBits(readBytes(hdr("-Y 1 +X 3", pixels)), {3, 1, {1, 2, 255, 1, 0.5f, 0, 0, 0, 0}});
}

TEST(Hdr, readHdr_readsExtremeExponents)
{
    const FileBytes pixels = {1, 255, 0, 1, 255, 1, 0, 255};
    expectSameBits(readBytes(hdr("-Y 1 +X 2", pixels)),
                   {2, 1, {0x1p-135f, 0x1.fep-128f, 0, 0x1.fep126f, 0x1p119f, 0}});
}

TEST(Hdr, readHdr_readsRunsOfTheNewCode)
{
    const FileBytes line = {2,       2,   0, 8,                        // a new scanline of 8
                            128 + 8, 10,                               // red: 8 times 10
                            3,       1,   2, 3,  128 + 5, 4,           // green: 1 2 3, 5 times 4
                            8,       0,   1, 2,  3,       4, 5, 6, 7,  // blue: 0 to 7
                            128 + 7, 136, 1, 137};                     // exponents
    const Image image = readBytes(hdr("-Y 1 +X 8", line));
    const Image expected = {
        8, 1, {10, 1, 0, 10, 2, 1, 10, 3, 2, 10, 4, 3, 10, 4, 4, 10, 4, 5, 10, 4, 6, 20, 8, 14}};
    expectSameBits(image, expected);
}

TEST(Hdr, readHdr_readsRunsOfTheOldCode)
{
    // One pixel, 3 repeats of it, another, then 257 repeats written as 1 + 256 * 1.
    const FileBytes pixels = {8, 0, 0, 136, 1, 1, 1, 3, 9, 0, 0, 136, 1, 1, 1, 1, 1, 1, 1, 1};
    const Image image = readBytes(hdr("-Y 1 +X 262", pixels));
    for (size_t x = 0; x < 262; x++) ASSERT_EQ(image.rgb[3 * x], x < 4 ? 8 : 9) << x;
}

TEST(Hdr, readHdr_dividesByAllExposures)
{
    const std::string header = RGBE + "EXPOSURE=2\nEXPOSURE= 4.0 \n";
    expectSameBits(readBytes(hdr("-Y 1 +X 1", {80, 8, 16, 136}, header)), {1, 1, {10, 1, 2}});
}

TEST(Hdr, readHdr_refusesExposureThatIsNotPositive)
{
    for (const char* exposure : {"0", "-1", "nan", "inf", "", "two"}) {
        const std::string header = RGBE + "EXPOSURE=" + exposure + "\n";
        EXPECT_NE(errorOf(hdr("-Y 1 +X 1", {1, 1, 1, 136}, header)).find("EXPOSURE"),
                  std::string::npos)
            << exposure;
    }
    const std::string tiny = RGBE + "EXPOSURE=1e-200\nEXPOSURE=1e-200\n";
    EXPECT_NE(errorOf(hdr("-Y 1 +X 1", {1, 1, 1, 136}, tiny)).find("EXPOSURE"), std::string::npos);
}

TEST(Hdr, readHdr_convertsXyz)
{
    // The white point of Rec. 709, times 200: X 190.1, Y 200, Z 217.8.
    const std::string header = "#?RGBE\nFORMAT=32-bit_rle_xyze\n";
    const Image image = readBytes(hdr("-Y 1 +X 1", {190, 200, 218, 136}, header));
    for (float value : image.rgb) EXPECT_NEAR(value, 200, 0.5);
}

TEST(Hdr, readHdr_takesPixelsWithoutFormatAsRgbe)
{
    ::testing::internal::CaptureStderr();
    const Image image = readBytes(hdr("-Y 1 +X 1", {1, 2, 3, 136}, "#?RADIANCE\n"));
    EXPECT_NE(::testing::internal::GetCapturedStderr().find("no FORMAT"), std::string::npos);
    expectSameBits(image, {1, 1, {1, 2, 3}});
}

// Red tells the pixels of a 2 x 3 picture apart: 1 2 / 3 4 / 5 6 seen from the top left.
TEST(Hdr, readHdr_knowsAllOrientations)
{
    const struct {
        const char* resolution;
        std::vector<uint8_t> order;
    } cases[] = {
        {"-Y 3 +X 2", {1, 2, 3, 4, 5, 6}}, {"-Y 3 -X 2", {2, 1, 4, 3, 6, 5}},
        {"+Y 3 +X 2", {5, 6, 3, 4, 1, 2}}, {"+Y 3 -X 2", {6, 5, 4, 3, 2, 1}},
        {"+X 2 -Y 3", {1, 3, 5, 2, 4, 6}}, {"-X 2 -Y 3", {2, 4, 6, 1, 3, 5}},
        {"+X 2 +Y 3", {5, 3, 1, 6, 4, 2}}, {"-X 2 +Y 3", {6, 4, 2, 5, 3, 1}},
    };
    for (const auto& test : cases) {
        FileBytes pixels;
        for (uint8_t red : test.order) pixels = pixels + FileBytes{red, 0, 0, 136};
        SCOPED_TRACE(test.resolution);
        expectSameBits(readBytes(hdr(test.resolution, pixels)),
                       {2, 3, {1, 0, 0, 2, 0, 0, 3, 0, 0, 4, 0, 0, 5, 0, 0, 6, 0, 0}});
    }
}

TEST(Hdr, readHdr_refusesResolutionLinesOfOtherKinds)
{
    for (const char* line :
         {"", "-Y 1", "-Y 1 +Y 1", "Y 1 X 1", "-Y x +X 1", "-Y 1 +X 1 2", "-Z 1 +X 1", "-Y4 +X8"}) {
        EXPECT_NE(errorOf(hdr(line, {1, 1, 1, 136})).find("resolution line"), std::string::npos)
            << line;
    }
}

TEST(Hdr, readHdr_refusesUnknownFormat)
{
    EXPECT_NE(errorOf(hdr("-Y 1 +X 1", {1, 1, 1, 136}, "#?RADIANCE\nFORMAT=8-bit\n")).find("8-bit"),
              std::string::npos);
}

TEST(Hdr, readHdr_refusesScanlineOfAnotherWidth)
{
    EXPECT_NE(errorOf(hdr("-Y 1 +X 8", {2, 2, 0, 9, 1, 1, 1, 1})).find("a scanline of 9"),
              std::string::npos);
}

TEST(Hdr, readHdr_refusesRunsPastTheEndOfTheLine)
{
    const FileBytes tooLong = {2, 2, 0, 8, 128 + 9, 1};
    const FileBytes literal = {2, 2, 0, 8, 128, 1};
    const FileBytes empty = {2, 2, 0, 8, 0, 0};
    const FileBytes oldCode = {8, 0, 0, 136, 1, 1, 1, 8};
    const FileBytes nothingBefore = {1, 1, 1, 2, 0, 0, 0, 0};
    const FileBytes overflow =
        FileBytes{8, 0, 0, 136} + repeated({1, 1, 1, 0}, 4) + FileBytes{1, 1, 1, 1};
    for (const FileBytes& pixels : {tooLong, literal, empty, oldCode, nothingBefore, overflow}) {
        EXPECT_NE(errorOf(hdr("-Y 1 +X 8", pixels)).find("damaged at byte"), std::string::npos);
    }
}

}  // namespace
}  // namespace sahl
