// Colours, axes and letters with known answers.
#include "image/color_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sahl {
namespace {

constexpr float NOTHING = std::numeric_limits<float>::quiet_NaN();

Colour8 pixelOf(const Image8& image, uint32_t x, uint32_t y)
{
    const uint8_t* rgb = &image.rgb[size_t{3} * (size_t{y} * image.width + x)];
    return {rgb[0], rgb[1], rgb[2]};
}

std::vector<double> valuesOf(const std::vector<Tick>& ticks)
{
    std::vector<double> values;
    for (const Tick& tick : ticks) values.push_back(tick.value);
    return values;
}

TEST(ColorMap, viridis_hasItsPublishedColours)
{
    EXPECT_EQ(colorOf(ColorMap::viridis, 0), (Colour8{68, 1, 84}));
    EXPECT_EQ(colorOf(ColorMap::viridis, 64 / 256.0), (Colour8{59, 82, 139}));
    EXPECT_EQ(colorOf(ColorMap::viridis, 128 / 256.0), (Colour8{33, 145, 140}));
    EXPECT_EQ(colorOf(ColorMap::viridis, 192 / 256.0), (Colour8{94, 201, 98}));
    EXPECT_EQ(colorOf(ColorMap::viridis, 1), (Colour8{253, 231, 37}));
}

TEST(ColorMap, viridis_isSmooth)
{
    // A slip in the table would bend one of the channels.
    for (int i = 1; i < 255; i++) {
        const Colour8 before = colorOf(ColorMap::viridis, (i - 0.5) / 256);
        const Colour8 here = colorOf(ColorMap::viridis, (i + 0.5) / 256);
        const Colour8 after = colorOf(ColorMap::viridis, (i + 1.5) / 256);
        for (size_t c = 0; c < 3; c++)
            EXPECT_LE(std::abs(before[c] - 2 * here[c] + after[c]), 1) << i;
    }
}

TEST(ColorMap, grey_isTheNumberTimes255)
{
    EXPECT_EQ(colorOf(ColorMap::grey, 0), BLACK);
    EXPECT_EQ(colorOf(ColorMap::grey, 0.5), (Colour8{128, 128, 128}));
    EXPECT_EQ(colorOf(ColorMap::grey, 1), WHITE);
    EXPECT_EQ(colorOf(ColorMap::grey, 7), WHITE);
}

TEST(Axis, position_isLinearOrLogarithmicAndClipped)
{
    const Axis linear = {2, 6, false};
    EXPECT_EQ(linear.position(3), 0.25);
    EXPECT_EQ(linear.position(1), 0);
    EXPECT_EQ(linear.position(9), 1);
    const Axis logarithmic = {1, 10000, true};
    EXPECT_DOUBLE_EQ(logarithmic.position(10), 0.25);
    EXPECT_EQ(logarithmic.position(0), 0);
    EXPECT_EQ((Axis{5, 5, false}).position(5), 0.5);
}

TEST(Axis, ticks_areBothEndsAndRoundNumbers)
{
    EXPECT_EQ(valuesOf(ticksOf({0, 10, false}, 0.2)), (std::vector<double>{0, 2, 4, 6, 8, 10}));
    EXPECT_EQ(valuesOf(ticksOf({1, 1000, false}, 0.15)),
              (std::vector<double>{1, 200, 400, 600, 800, 1000}));
    // 300 would be too near to 373
    EXPECT_EQ(valuesOf(ticksOf({3, 373, false}, 0.2)), (std::vector<double>{3, 100, 200, 373}));
    EXPECT_EQ(valuesOf(ticksOf({1, 10000, true}, 0.2)),
              (std::vector<double>{1, 10, 100, 1000, 10000}));
    EXPECT_EQ(valuesOf(ticksOf({1, 10000, true}, 0.3)), (std::vector<double>{1, 100, 10000}));
    EXPECT_EQ(valuesOf(ticksOf({7, 7, false}, 0.1)), (std::vector<double>{7}));
}

TEST(Axis, ticks_areApart)
{
    for (double spacing : {0.05, 0.13, 0.4, 2.0}) {
        for (const Axis& axis :
             {Axis{-3, 17.3, false}, Axis{1e-7, 1.1e-7, false}, Axis{0.3, 4e6, true},
              Axis{-1e30, 1e30, false}, Axis{1, std::nextafter(1, 2), false}}) {
            const std::vector<Tick> ticks = ticksOf(axis, spacing);
            ASSERT_GE(ticks.size(), 2u);
            EXPECT_LE(static_cast<double>(ticks.size()), 1 / spacing + 2);
            for (size_t i = 1; i < ticks.size() && ticks.size() > 2; i++) {
                EXPECT_GE(axis.position(ticks[i].value) - axis.position(ticks[i - 1].value),
                          spacing * (1 - 1e-9));
            }
        }
    }
}

TEST(Axis, labels_areShort)
{
    EXPECT_EQ(axisLabel(0), "0");
    EXPECT_EQ(axisLabel(-0.0), "0");
    EXPECT_EQ(axisLabel(0.25), "0.25");
    EXPECT_EQ(axisLabel(2.0 / 3), "0.6667");
    EXPECT_EQ(axisLabel(786432), "786432");
    EXPECT_EQ(axisLabel(16777216), "1.678e7");
    EXPECT_EQ(axisLabel(12345.6), "1.235e4");
    EXPECT_EQ(axisLabel(-1.5e-6), "-1.5e-6");
}

TEST(Drawing, text_isMadeOfDots)
{
    Image8 image = filledImage(12, 16, BLACK);
    drawText(image, 0, 0, "7", 2, WHITE);
    // 7 has its upper bar, then a stroke from the right.
    for (uint32_t x = 0; x < 12; x++) EXPECT_EQ(pixelOf(image, x, 0), x < 10 ? WHITE : BLACK) << x;
    EXPECT_EQ(pixelOf(image, 9, 3), WHITE);
    EXPECT_EQ(pixelOf(image, 0, 3), BLACK);
    EXPECT_EQ(textWidth("123", 2), 36);
}

TEST(Drawing, whatLiesOutside_isCutOff)
{
    Image8 image = filledImage(4, 3, BLACK);
    fillRectangle(image, -5, 1, 100, 1, WHITE);
    fillRectangle(image, 10, 10, 5, 5, WHITE);
    drawText(image, -3, -2, "8", 1, WHITE);
    drawImage(image, filledImage(9, 9, WHITE), 3, 2);
    EXPECT_EQ(image.rgb.size(), 36u);
    EXPECT_EQ(pixelOf(image, 0, 1), WHITE);
    EXPECT_EQ(pixelOf(image, 3, 2), WHITE);
    EXPECT_EQ(pixelOf(image, 2, 2), BLACK);
}

TEST(Drawing, everyLetter_isSevenRowsOfFiveDotsUnlikeAnyOther)
{
    std::vector<std::vector<uint8_t>> seen;
    for (char letter : std::string("0123456789.-+: ABCDEFGHIJKLMNOPQRSTUVWXYZ?")) {
        Image8 image = filledImage(8, 10, BLACK);
        drawText(image, 1, 1, std::string(1, letter), 1, WHITE);
        for (uint32_t y = 0; y < 10; y++) {
            EXPECT_EQ(pixelOf(image, 0, y), BLACK) << letter;
            EXPECT_EQ(pixelOf(image, 6, y), BLACK) << letter;
        }
        for (const auto& other : seen) EXPECT_NE(image.rgb, other) << letter;
        seen.push_back(image.rgb);
    }
    Image8 small = filledImage(8, 10, BLACK), capital = small;
    drawText(small, 1, 1, "q", 1, WHITE);
    drawText(capital, 1, 1, "Q", 1, WHITE);
    EXPECT_EQ(small.rgb, capital.rgb);
}

TEST(FalseColors, withoutAScale_areOnePixelAValue)
{
    FalseColors colors = {ColorMap::grey, {0, 4, false}, false};
    const Image8 image = falseColorImage({3, 2, {0, 1, 2, 4, 9, NOTHING}}, colors);
    ASSERT_EQ(image.width, 3u);
    ASSERT_EQ(image.height, 2u);
    EXPECT_EQ(image.rgb, (std::vector<uint8_t>{0, 0, 0, 64, 64, 64, 128, 128, 128,  //
                                               255, 255, 255, 255, 255, 255, 0, 0, 0}));
}

TEST(FalseColors, nothing_isBlackInAnyColours)
{
    const Image8 image =
        falseColorImage({2, 1, {NOTHING, 1}}, {ColorMap::viridis, {1, 2, false}, false});
    EXPECT_EQ(pixelOf(image, 0, 0), BLACK);
    EXPECT_EQ(pixelOf(image, 1, 0), (Colour8{68, 1, 84}));
}

TEST(FalseColors, onALogarithmicAxis_valuesThatHaveNoLogarithmAreBlack)
{
    FalseColors colors = {ColorMap::grey, axisOf(std::vector<float>{0, -3, 1, 100, 10}, true),
                          false};
    EXPECT_EQ(colors.axis.low, 1);
    EXPECT_EQ(colors.axis.high, 100);
    const Image8 image = falseColorImage({5, 1, {0, -3, 1, 100, 10}}, colors);
    EXPECT_EQ(pixelOf(image, 0, 0), BLACK);
    EXPECT_EQ(pixelOf(image, 1, 0), BLACK);
    EXPECT_EQ(pixelOf(image, 3, 0), WHITE);
    EXPECT_EQ(pixelOf(image, 4, 0), (Colour8{128, 128, 128}));
}

TEST(FalseColors, axis_goesFromTheSmallestFiniteValueToTheLargest)
{
    const float inf = std::numeric_limits<float>::infinity();
    const Axis axis = axisOf(std::vector<float>{NOTHING, 3, -2, inf, 7, -inf}, false);
    EXPECT_EQ(axis.low, -2);
    EXPECT_EQ(axis.high, 7);
}

TEST(FalseColors, scale_showsAllColoursBesideThePicture)
{
    ScalarField field = {100, 200, std::vector<float>(20000, 5.0f)};
    field.values[0] = 1;
    const FalseColors colors = {ColorMap::viridis, {1, 9, false}, true};
    const Image8 image = falseColorImage(field, colors);
    EXPECT_EQ(image.height, 200u);
    EXPECT_GT(image.width, 100u);
    EXPECT_EQ(pixelOf(image, 0, 0), (Colour8{68, 1, 84}));
    EXPECT_EQ(pixelOf(image, 99, 199), colorOf(ColorMap::viridis, 0.5));
    // The bar: yellow at the top, dark blue at the bottom, and then the numbers in white.
    EXPECT_EQ(pixelOf(image, 110, 8), (Colour8{253, 231, 37}));
    EXPECT_EQ(pixelOf(image, 110, 191), (Colour8{68, 1, 84}));
    size_t white = 0;
    for (uint32_t y = 0; y < 200; y++) {
        for (uint32_t x = 124; x < image.width; x++) white += pixelOf(image, x, y) == WHITE;
    }
    EXPECT_GT(white, 50u);
}

TEST(FalseColors, scaleOfASmallPicture_hasRoomForItsNumbers)
{
    const FalseColors colors = {ColorMap::grey, {0, 1, false}, true};
    const Image8 image = falseColorImage({1, 1, {1}}, colors);
    EXPECT_GE(image.height, 64u);
    EXPECT_EQ(pixelOf(image, 0, 0), WHITE);
    EXPECT_EQ(pixelOf(image, 0, 1), BLACK);
}

}  // namespace
}  // namespace sahl
