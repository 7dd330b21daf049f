// EXR files: our own come back bit for bit, and those of other programs are read right or refused.
#include "support/exr_files.h"

#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

namespace sahl {
namespace {

using namespace sahl::testing;

/// Values that half floats hold exactly, smooth enough for lossy compression.
Image smoothImage(uint32_t width, uint32_t height)
{
    Image image = {width, height, {}};
    for (uint32_t i = 0; i < width * height * 3; i++) {
        image.rgb.push_back(0.25f * static_cast<float>(i % 3) +
                            static_cast<float>(i / 3 % width) / 64);
    }
    return image;
}

TEST(Exr, readExr_undoesEncodeExrBitForBit)
{
    for (uint32_t size : {1u, 2u, 17u, 100u}) {
        const Image image = randomBitsImage(size, size + 1, size);
        expectSameBits(readBytes(encodeExr(image, {})), image);
    }
}

TEST(Exr, encodeExr_storesMetadataAsStringAttributes)
{
    const ImageMetadata metadata = {{"comments", "a \"quoted\" text\nwith two lines"},
                                    {"sahl.anAttributeWithANameOfMoreThan31Letters", "long"}};
    const FileBytes bytes = encodeExr(numberedImage(3, 2), metadata);
    const TemporaryFolder folder;
    const fs::path path = folder.path / "a.exr";
    writeFileAtomically(path, bytes);
    Imf::InputFile file(path.c_str());
    for (const auto& [name, text] : metadata) {
        const auto* attribute = file.header().findTypedAttribute<Imf::StringAttribute>(name);
        ASSERT_NE(attribute, nullptr) << name;
        EXPECT_EQ(attribute->value(), text);
    }
    EXPECT_EQ(file.header().compression(), Imf::ZIP_COMPRESSION);
    EXPECT_EQ(file.header().channels()["G"].type, Imf::FLOAT);
    expectSameBits(readImage(path), numberedImage(3, 2));
}

TEST(Exr, encodeExr_givesTheSameBytesAgain)
{
    const Image image = randomBitsImage(20, 20, 3);
    EXPECT_EQ(encodeExr(image, {{"a", "b"}}), encodeExr(image, {{"a", "b"}}));
}

TEST(Exr, readExr_returnsTopRowFirst)
{
    // In the file the row of smallest y comes first and is the top one.
    for (Imf::LineOrder order : {Imf::INCREASING_Y, Imf::DECREASING_Y}) {
        ExrOptions options;
        options.lineOrder = order;
        expectSameBits(readBytes(makeExr(numberedImage(5, 40), options)), numberedImage(5, 40));
    }
}

TEST(Exr, readExr_readsEveryLosslessCompressionExactly)
{
    for (Imf::Compression compression :
         {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION, Imf::ZIP_COMPRESSION,
          Imf::PIZ_COMPRESSION}) {
        SCOPED_TRACE(compression);
        ExrOptions options;
        options.compression = compression;
        const Image image = randomBitsImage(33, 70, 9);
        expectSameBits(readBytes(makeExr(image, options)), image);
    }
}

TEST(Exr, readExr_readsEveryLossyCompressionClosely)
{
    for (Imf::Compression compression :
         {Imf::PXR24_COMPRESSION, Imf::B44_COMPRESSION, Imf::B44A_COMPRESSION,
          Imf::DWAA_COMPRESSION, Imf::DWAB_COMPRESSION}) {
        SCOPED_TRACE(compression);
        ExrOptions options;
        options.compression = compression;
        options.type = Imf::HALF;
        const Image image = smoothImage(64, 300);
        const Image read = readBytes(makeExr(image, options));
        ASSERT_EQ(read.rgb.size(), image.rgb.size());
        for (size_t i = 0; i < image.rgb.size(); i++) ASSERT_NEAR(read.rgb[i], image.rgb[i], 0.02);
    }
}

TEST(Exr, readExr_readsTiles)
{
    ExrOptions options;
    options.tileSize = 16;
    options.type = Imf::HALF;
    expectSameBits(readBytes(makeExr(numberedImage(20, 18), options)), numberedImage(20, 18));
}

TEST(Exr, readExr_readsUnsignedIntegers)
{
    ExrOptions options;
    options.type = Imf::UINT;
    Image bits = {1, 1, {}};
    for (uint32_t value : {0u, 7u, 1u << 20}) bits.rgb.push_back(std::bit_cast<float>(value));
    expectSameBits(readBytes(makeExr(bits, options)), {1, 1, {0, 7, 1048576}});
}

TEST(Exr, readExr_readsDataWindowsAwayFromTheOrigin)
{
    for (Imath::V2i origin : {Imath::V2i(-100, -7), Imath::V2i(1000000, 5)}) {
        ExrOptions options;
        options.origin = origin;
        expectSameBits(readBytes(makeExr(numberedImage(6, 5), options)), numberedImage(6, 5));
    }
}

TEST(Exr, readExr_spreadsGreyOverThreeChannels)
{
    ExrOptions options;
    options.channels = {"Y"};
    const Image read = readBytes(makeExr(numberedImage(2, 1), options));
    expectSameBits(read, {2, 1, {0, 0, 0, 10, 10, 10}});
}

TEST(Exr, readExr_ignoresOtherChannels)
{
    ExrOptions options;
    options.channels = {"R", "G", "B", "A", "Z", "albedo.B", "Y"};
    expectSameBits(readBytes(makeExr(numberedImage(4, 3), options)), numberedImage(4, 3));
}

TEST(Exr, readExr_refusesPicturesWithoutColourNamingTheirChannels)
{
    ExrOptions options;
    options.channels = {"R", "G", "view.B"};
    EXPECT_EQ(errorOf(makeExr(numberedImage(2, 2), options)),
              "needs channels R, G, B, or Y alone; it has G, R, view.B");
    options.channels = {"Y", "RY", "BY"};
    EXPECT_NE(errorOf(makeExr(numberedImage(2, 2), options)).find("BY, RY, Y"), std::string::npos);
}

TEST(Exr, readExr_refusesTooManyChannels)
{
    ExrOptions options;
    for (int i = 0; i < 1100; i++) options.channels.push_back(fmt::format("c{}", i));
    EXPECT_EQ(errorOf(makeExr(numberedImage(1, 1), options)), "has more than 1024 channels");
}

TEST(Exr, readExr_warnsOfOtherPrimaries)
{
    for (float redX : {0.64f, 0.708f}) {
        ExrOptions options;
        options.primaries.red = {redX, 0.33f};
        ::testing::internal::CaptureStderr();
        expectSameBits(readBytes(makeExr(numberedImage(2, 1), options)), numberedImage(2, 1));
        const std::string warnings = ::testing::internal::GetCapturedStderr();
        EXPECT_EQ(warnings.find("Rec. 709") != std::string::npos, redX != 0.64f) << warnings;
    }
}

}  // namespace
}  // namespace sahl
