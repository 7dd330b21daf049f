// PNG files, read back with libpng.
#include "support/pictures.h"

#include <png.h>

#include <map>

namespace sahl {
namespace {

using namespace sahl::testing;

struct DecodedPng {
    Image8 image;
    bool hasSrgb = false;
    bool hasTime = false;
    std::map<std::string, std::string> texts;
};

struct PngSource {
    const FileBytes& bytes;
    size_t pos;
};

void readSource(png_structp png, png_bytep data, size_t size)
{
    auto* source = static_cast<PngSource*>(png_get_io_ptr(png));
    if (size > source->bytes.size() - source->pos) png_error(png, "end of file");
    std::memcpy(data, source->bytes.data() + source->pos, size);
    source->pos += size;
}

DecodedPng decodePng(const FileBytes& bytes)
{
    PngSource source = {bytes, 0};
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_set_read_fn(png, &source, readSource);
    png_read_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);  // ends the test program on errors
    EXPECT_EQ(source.pos, bytes.size());
    EXPECT_EQ(png_get_bit_depth(png, info), 8);
    EXPECT_EQ(png_get_color_type(png, info), PNG_COLOR_TYPE_RGB);

    DecodedPng decoded;
    decoded.image.width = png_get_image_width(png, info);
    decoded.image.height = png_get_image_height(png, info);
    png_bytepp rows = png_get_rows(png, info);
    for (uint32_t y = 0; y < decoded.image.height; y++) {
        decoded.image.rgb.insert(decoded.image.rgb.end(), rows[y],
                                 rows[y] + size_t{3} * decoded.image.width);
    }
    decoded.hasSrgb = png_get_valid(png, info, PNG_INFO_sRGB) != 0;
    decoded.hasTime = png_get_valid(png, info, PNG_INFO_tIME) != 0;
    png_textp texts = nullptr;
    const int count = png_get_text(png, info, &texts, nullptr);
    for (int i = 0; i < count; i++) decoded.texts[texts[i].key] = texts[i].text;
    png_destroy_read_struct(&png, &info, nullptr);
    return decoded;
}

TEST(Png, encodePng_isReadBackByLibpng)
{
    Image8 image = {37, 19, {}};
    std::mt19937 random(5);
    for (size_t i = 0; i < size_t{3} * 37 * 19; i++) {
        image.rgb.push_back(static_cast<uint8_t>(random()));
    }
    const ImageMetadata metadata = {
        {"Software", "Sahl"}, {"sahl.seed", "7"}, {"Comment", "Größe ≤ 3"}};
    const DecodedPng decoded = decodePng(encodePng(image, metadata));
    EXPECT_EQ(decoded.image.width, image.width);
    EXPECT_EQ(decoded.image.height, image.height);
    EXPECT_EQ(decoded.image.rgb, image.rgb);
    EXPECT_EQ(decoded.texts, metadata);
    EXPECT_TRUE(decoded.hasSrgb);
}

TEST(Png, encodePng_givesTheSameBytesAgain)
{
    const Image8 image = {1, 2, {1, 2, 3, 4, 5, 6}};
    EXPECT_EQ(encodePng(image, {{"a", "b"}}), encodePng(image, {{"a", "b"}}));
    EXPECT_FALSE(decodePng(encodePng(image, {})).hasTime);
}

}  // namespace
}  // namespace sahl
