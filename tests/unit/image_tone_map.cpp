// Tone mapping with answers known by hand.
#include "image/tone_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace sahl {
namespace {

/// A picture of one row whose 3n values are given.
Image row(std::vector<float> values)
{
    const auto width = static_cast<uint32_t>(values.size() / 3);
    return {width, 1, std::move(values)};
}

TEST(ToneMap, percentile_mapsThe5thAnd95thOf0To101)
{
    // 102 values 0 ... 101, shuffled: the percentiles lie at ranks 5.05 and 95.95.
    std::vector<float> values(102);
    std::iota(values.begin(), values.end(), 0.0f);
    std::mt19937 random(1);
    std::shuffle(values.begin(), values.end(), random);
    const Image8 mapped = toneMap(row(values), {ToneOperator::percentile});
    for (size_t i = 0; i < values.size(); i++) {
        const double position = std::clamp((values[i] - 5.05) / (95.95 - 5.05), 0.0, 1.0);
        EXPECT_EQ(mapped.rgb[i], std::floor(position * 255 + 0.5)) << values[i];
    }
}

TEST(ToneMap, percentile_poolsAllChannels)
{
    // Three values 0, 10, 20: ranks 0.1 and 1.9, hence 1 and 19.
    const Image8 mapped = toneMap(row({0, 10, 20}), {ToneOperator::percentile});
    EXPECT_EQ(mapped.rgb, (std::vector<uint8_t>{0, 128, 255}));
}

TEST(ToneMap, percentile_isNotMovedByAFewOutliers)
{
    std::vector<float> values(300, 0.0f);
    for (size_t i = 0; i < 300; i++) values[i] = i < 150 ? 1.0f : 3.0f;
    values[0] = 1e30f;
    values[299] = -1e30f;
    const Image8 mapped = toneMap(row(values), {ToneOperator::percentile});
    EXPECT_EQ(mapped.rgb[1], 0);
    EXPECT_EQ(mapped.rgb[298], 255);
    EXPECT_EQ(mapped.rgb[0], 255);
    EXPECT_EQ(mapped.rgb[299], 0);
}

TEST(ToneMap, naive_mapsSmallestAndLargest)
{
    const Image8 mapped = toneMap(row({-1, 0, 3, 1, 1, 1}), {ToneOperator::naive});
    EXPECT_EQ(mapped.rgb, (std::vector<uint8_t>{0, 64, 255, 128, 128, 128}));
}

TEST(ToneMap, equalValuesBecomeMidGrey)
{
    for (ToneOperator how : {ToneOperator::percentile, ToneOperator::naive}) {
        for (float value : {0.0f, 7.0f, -1e30f}) {
            const Image8 mapped = toneMap(row({value, value, value}), {how});
            EXPECT_EQ(mapped.rgb, (std::vector<uint8_t>{128, 128, 128}));
        }
    }
}

TEST(ToneMap, percentile_givesMidGreyWhenNearlyAllValuesAreEqual)
{
    std::vector<float> values(300, 2.0f);
    values[7] = 100;
    const Image8 mapped = toneMap(row(values), {ToneOperator::percentile});
    EXPECT_TRUE(
        std::all_of(mapped.rgb.begin(), mapped.rgb.end(), [](uint8_t v) { return v == 128; }));
}

TEST(ToneMap, exposure_decodesBackToItself)
{
    // Every 8-bit value, decoded by the definition, must come back.
    std::vector<float> values;
    for (int i = 0; i < 256; i++) {
        const double v = i / 255.0;
        values.push_back(
            static_cast<float>(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4)));
    }
    values.resize(258, 0.0f);
    const Image8 mapped = toneMap(row(values), {ToneOperator::exposure});
    for (size_t i = 0; i < 256; i++) EXPECT_EQ(mapped.rgb[i], i);
}

TEST(ToneMap, exposure_roundsAtTheMiddleBetweenTwoCodes)
{
    for (int i = 0; i < 255; i++) {
        const double v = (i + 0.5) / 255;
        const double edge = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
        const auto below = static_cast<float>(edge * (1 - 1e-6));
        const auto above = static_cast<float>(edge * (1 + 1e-6));
        const Image8 mapped = toneMap(row({below, above, 0}), {ToneOperator::exposure});
        EXPECT_EQ(mapped.rgb[0], i);
        EXPECT_EQ(mapped.rgb[1], i + 1);
    }
}

TEST(ToneMap, exposure_appliesExposureInStops)
{
    // 0.5 is code 188; two stops up from 0.125, one down from 1.
    EXPECT_EQ(toneMap(row({0.5f, 0, 1}), {ToneOperator::exposure}).rgb,
              (std::vector<uint8_t>{188, 0, 255}));
    EXPECT_EQ(toneMap(row({0.125f, 0, 1}), {ToneOperator::exposure, 2}).rgb,
              (std::vector<uint8_t>{188, 0, 255}));
    EXPECT_EQ(toneMap(row({1, 0, 9}), {ToneOperator::exposure, -1}).rgb, (std::vector<uint8_t>{188, 0, 255}));
    EXPECT_EQ(toneMap(row({1, 0, 1e-30f}), {ToneOperator::exposure, 1e9}).rgb,
              (std::vector<uint8_t>{255, 0, 255}));
}

TEST(ToneMap, filmic_followsThePublishedCurve)
{
    // Narkowicz's rational function, worked out by hand: 2.54/3.16 at 1, 0.6425/1.0425 at 1/2.
    const ToneCurve curve = fitToneCurve(row({0, 0.5f, 1}), {ToneOperator::filmic, 0, 1});
    EXPECT_DOUBLE_EQ(curve(0), 0);
    EXPECT_NEAR(curve(1), 0.8037974683544302, 1e-15);
    EXPECT_NEAR(curve(0.5), 0.6425 / 1.0425, 1e-15);
    EXPECT_NEAR(curve(4), 40.28 / 41.38, 1e-15);
    EXPECT_LT(curve(7.24), 1);
    EXPECT_EQ(curve(7.25), 1);
    EXPECT_EQ(curve(3e38), 1);
    EXPECT_EQ(curve(-1), 0);
}

TEST(ToneMap, filmic_growsWithTheValue)
{
    const ToneCurve curve = fitToneCurve(row({0, 0, 0}), {ToneOperator::filmic});
    double before = 0;
    for (double value = 1e-4; value < 7.2; value *= 1.01) {
        EXPECT_GT(curve(value), before) << value;
        before = curve(value);
    }
}

TEST(ToneMap, filmic_appliesExposureInStopsAndSrgb)
{
    const ToneCurve curve = fitToneCurve(row({0, 0, 0}), {ToneOperator::filmic, 2});
    const double linear = 2.54 / 3.16;  // of 4 * 0.25
    EXPECT_NEAR(curve(0.25), 1.055 * std::pow(linear, 1 / 2.4) - 0.055, 1e-12);
    // Black and white stay what they are at any exposure.
    for (double stops : {-100.0, 100.0, 1e9}) {
        const ToneCurve extreme = fitToneCurve(row({0, 0, 0}), {ToneOperator::filmic, stops});
        EXPECT_EQ(extreme(0), 0);
        EXPECT_DOUBLE_EQ(extreme(double{std::numeric_limits<float>::max()}), 1);
    }
}

TEST(ToneMap, gamma_isAppliedAfterTheOperator)
{
    const Image picture = row({0, 1, 4});
    EXPECT_EQ(toneMap(picture, {ToneOperator::naive, 0, 2}).rgb,
              (std::vector<uint8_t>{0, 128, 255}));  // sqrt(1/4) = 1/2
    EXPECT_EQ(toneMap(picture, {ToneOperator::naive, 0, 0.5}).rgb,
              (std::vector<uint8_t>{0, 16, 255}));  // (1/4)^2 = 1/16
    EXPECT_EQ(toneMap(row({0, 0.5f, 1}), {ToneOperator::naive, 0, SRGB_GAMMA}).rgb,
              (std::vector<uint8_t>{0, 188, 255}));
    EXPECT_EQ(toneMap(row({0, 0.25f, 2}), {ToneOperator::exposure, 0, 2}).rgb,
              (std::vector<uint8_t>{0, 128, 255}));
}

TEST(ToneMap, gamma_isLinearForFittedRangesAndSrgbForTheOthers)
{
    const Image picture = row({0, 0.5f, 1});
    EXPECT_EQ(toneMap(picture, {ToneOperator::naive}).rgb[1], 128);
    EXPECT_EQ(toneMap(picture, {ToneOperator::percentile}).rgb[1], 128);
    EXPECT_EQ(toneMap(picture, {ToneOperator::exposure}).rgb[1], 188);
    EXPECT_EQ(toneMap(picture, {ToneOperator::exposure, 0, 1}).rgb[1], 128);
}

TEST(ToneMap, countsNonFiniteValuesAsZero)
{
    const float inf = std::numeric_limits<float>::infinity();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const Image8 exposed = toneMap(row({nan, inf, -inf}), {ToneOperator::exposure});
    EXPECT_EQ(exposed.rgb, (std::vector<uint8_t>{0, 0, 0}));
    const Image8 naive = toneMap(row({nan, inf, 2, 1, -inf, 2}), {ToneOperator::naive});
    EXPECT_EQ(naive.rgb, (std::vector<uint8_t>{0, 0, 255, 128, 0, 255}));
}

}  // namespace
}  // namespace sahl
