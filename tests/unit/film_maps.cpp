// Maps of quantities with answers known by hand.
#include "film/maps.h"

#include <gtest/gtest.h>

#include <string_view>

namespace sahl {
namespace {

const MapQuantity& quantityNamed(std::string_view name)
{
    for (const MapQuantity& quantity : mapQuantities()) {
        if (quantity.name == name) return quantity;
    }
    throw std::logic_error("no such quantity");
}

std::vector<uint8_t> drawn(std::string_view name, const std::vector<ImageChannel>& channels,
                           uint32_t width, MapStyle style = {})
{
    style.scale = false;
    return drawMap(quantityNamed(name), channels, width, 1, style).rgb;
}

TEST(Maps, normals_areHalfOfOnePlusTheNormal)
{
    const std::vector<ImageChannel> channels = {
        {"normal.X", {1, 0, 0, 0}}, {"normal.Y", {0, -1, 0, 0}}, {"normal.Z", {0, 0, 0.5f, 0}}};
    EXPECT_EQ(drawn("normals", channels, 4),
              (std::vector<uint8_t>{255, 128, 128, 128, 0, 128, 128, 128, 191, 0, 0, 0}));
}

TEST(Maps, albedo_isEncodedAsSrgb)
{
    const std::vector<ImageChannel> channels = {
        {"albedo.R", {0.5f}}, {"albedo.G", {1}}, {"albedo.B", {0}}};
    EXPECT_EQ(drawn("albedo", channels, 1), (std::vector<uint8_t>{188, 255, 0}));
}

TEST(Maps, scalars_goFromTheSmallestToTheLargest)
{
    MapStyle grey;
    grey.colors = ColorMap::grey;
    const std::vector<ImageChannel> channels = {
        {"nodeVisits.Y", {10, 20, 30}}, {"primitiveTests.Y", {0, 4, 1}}, {"samples.Y", {8, 8, 8}}};
    EXPECT_EQ(drawn("nodes", channels, 3, grey),
              (std::vector<uint8_t>{0, 0, 0, 128, 128, 128, 255, 255, 255}));
    EXPECT_EQ(drawn("primitives", channels, 3, grey),
              (std::vector<uint8_t>{0, 0, 0, 255, 255, 255, 64, 64, 64}));
    EXPECT_EQ(drawn("samples", channels, 3, grey), std::vector<uint8_t>(9, 128));
}

TEST(Maps, fixedRange_makesMapsComparable)
{
    MapStyle style;
    style.fixedRange = true;
    style.low = 1;
    style.high = 1000;
    const std::vector<ImageChannel> channels = {{"samples.Y", {1, 1000, 5000}}};
    EXPECT_EQ(drawn("samples", channels, 3, style),
              (std::vector<uint8_t>{68, 1, 84, 253, 231, 37, 253, 231, 37}));
}

TEST(Maps, depth_isBlackWhereNothingWasMet)
{
    MapStyle grey;
    grey.colors = ColorMap::grey;
    const std::vector<ImageChannel> channels = {{"depth.Z", {0, 3, 5, 4}}};
    // 3 is the nearest: the 0 of nothing is not in the range
    EXPECT_EQ(drawn("depth", channels, 4, grey),
              (std::vector<uint8_t>{0, 0, 0, 0, 0, 0, 255, 255, 255, 128, 128, 128}));
}

}  // namespace
}  // namespace sahl
