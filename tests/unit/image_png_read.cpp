// PNG files in: our own, and those of other kinds, made with libpng.
#include "image/png_read.h"
#include "image/texel_image.h"
#include "support/pictures.h"

#include <png.h>

namespace sahl {
namespace {

using namespace sahl::testing;

struct Kind {
    int colorType;
    int bitDepth;
    int interlace = PNG_INTERLACE_NONE;
};

void appendTo(png_structp png, png_bytep data, size_t size)
{
    auto* bytes = static_cast<FileBytes*>(png_get_io_ptr(png));
    bytes->insert(bytes->end(), data, data + size);
}

/// `rows` holds the packed samples of all rows.
FileBytes makePng(uint32_t width, uint32_t height, const Kind& kind, FileBytes rows)
{
    FileBytes bytes;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(png, &bytes, appendTo, nullptr);
    png_set_IHDR(png, info, width, height, kind.bitDepth, kind.colorType, kind.interlace,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    const png_color palette[2] = {{0, 51, 102}, {255, 0, 0}};
    if (kind.colorType == PNG_COLOR_TYPE_PALETTE) png_set_PLTE(png, info, palette, 2);
    png_write_info(png, info);
    std::vector<png_bytep> pointers;
    for (uint32_t y = 0; y < height; y++)
        pointers.push_back(rows.data() + y * rows.size() / height);
    png_write_image(png, pointers.data());
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return bytes;
}

PngPicture readPngBytes(const FileBytes& bytes)
{
    const TemporaryFolder folder;
    writeFileAtomically(folder.path / "a.png", bytes);
    return readPngPicture(folder.path / "a.png");
}

TEST(PngRead, undoesEncodePng)
{
    const Image8 image = {
        3, 2, {0, 1, 2, 50, 100, 150, 255, 254, 253, 7, 8, 9, 10, 11, 12, 13, 14, 15}};
    const PngPicture picture =
        readPngBytes(encodePng(image, {{"sahl.seed", "4"}, {"title", "two\nlines"}}));
    EXPECT_EQ(picture.srgb.width, 3u);
    EXPECT_EQ(picture.srgb.height, 2u);
    for (size_t i = 0; i < image.rgb.size(); i++) {
        EXPECT_FLOAT_EQ(picture.srgb.rgb[i], static_cast<float>(image.rgb[i]) / 255.0f);
    }
    EXPECT_EQ(picture.metadata.at("sahl.seed"), "4");
    EXPECT_EQ(picture.metadata.at("title"), "two\nlines");
    EXPECT_FALSE(picture.hadAlpha);
}

TEST(PngRead, readsEveryKind)
{
    auto values = [](const Kind& kind, const FileBytes& rows) {
        return readPngBytes(makePng(2, 1, kind, rows)).srgb.rgb;
    };
    using Floats = std::vector<float>;
    EXPECT_EQ(values({PNG_COLOR_TYPE_GRAY, 8}, {0, 51}), (Floats{0, 0, 0, 0.2f, 0.2f, 0.2f}));
    EXPECT_EQ(values({PNG_COLOR_TYPE_GRAY, 1}, {0x40}), (Floats{0, 0, 0, 1, 1, 1}));
    EXPECT_EQ(values({PNG_COLOR_TYPE_PALETTE, 1}, {0x40}), (Floats{0, 0.2f, 0.4f, 1, 0, 0}));
    EXPECT_EQ(values({PNG_COLOR_TYPE_RGB, 16}, {0x33, 0x33, 0, 0, 0, 1, 0xff, 0xff, 0, 0, 0, 0}),
              (Floats{0.2f, 0, 1.0f / 65535, 1, 0, 0}));
    EXPECT_EQ(values({PNG_COLOR_TYPE_RGB, 8, PNG_INTERLACE_ADAM7}, {0, 51, 102, 255, 0, 0}),
              (Floats{0, 0.2f, 0.4f, 1, 0, 0}));
}

TEST(PngRead, alpha_isLeftOutAndTold)
{
    const PngPicture picture =
        readPngBytes(makePng(1, 1, {PNG_COLOR_TYPE_RGB_ALPHA, 8}, {255, 51, 0, 128}));
    EXPECT_TRUE(picture.hadAlpha);
    EXPECT_EQ(picture.srgb.rgb, (std::vector<float>{1, 0.2f, 0}));
}

TEST(PngTexels, holdTheValuesOfEveryKind_andAlpha)
{
    auto texels = [](const Kind& kind, const FileBytes& rows) {
        return decodeTexels("a.png", makePng(2, 1, kind, rows)).rgba;
    };
    using Texels = std::vector<uint32_t>;
    EXPECT_EQ(texels({PNG_COLOR_TYPE_RGB_ALPHA, 8}, {1, 2, 3, 4, 5, 6, 7, 8}),
              (Texels{0x04030201, 0x08070605}));
    EXPECT_EQ(texels({PNG_COLOR_TYPE_RGB, 8}, {1, 2, 3, 5, 6, 7}), (Texels{0xff030201, 0xff070605}));
    EXPECT_EQ(texels({PNG_COLOR_TYPE_GRAY_ALPHA, 8}, {9, 0, 10, 255}), (Texels{0x090909, 0xff0a0a0a}));
    EXPECT_EQ(texels({PNG_COLOR_TYPE_GRAY, 1}, {0x40}), (Texels{0xff000000, 0xffffffff}));
    EXPECT_EQ(texels({PNG_COLOR_TYPE_PALETTE, 1}, {0x40}), (Texels{0xff663300, 0xff0000ff}));
    // 16 bits are rounded: 0x0080 is 0.498, 0x80ff 128.494 of 255
    EXPECT_EQ(texels({PNG_COLOR_TYPE_GRAY, 16}, {0x00, 0x80, 0x80, 0xff}),
              (Texels{0xff000000, 0xff808080}));
    EXPECT_EQ(texels({PNG_COLOR_TYPE_RGB, 8, PNG_INTERLACE_ADAM7}, {1, 2, 3, 5, 6, 7}),
              (Texels{0xff030201, 0xff070605}));
}

}  // namespace
}  // namespace sahl
