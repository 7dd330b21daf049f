// Error metrics: each against values worked out by hand from its definition.
#include "compare/metrics.h"
#include "compare/ssim.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sahl {
namespace {

constexpr float NOT_A_NUMBER = std::numeric_limits<float>::quiet_NaN();
constexpr float INFINITE = std::numeric_limits<float>::infinity();

LoadedPicture pictureOf(uint32_t width, uint32_t height, std::vector<float> rgb)
{
    LoadedPicture picture;
    picture.image = {width, height, std::move(rgb)};
    return picture;
}

LoadedPicture grey(uint32_t width, uint32_t height, float value)
{
    return pictureOf(width, height, std::vector<float>(size_t{3} * width * height, value));
}

TEST(CompareMetrics, pointwiseMetrics_equalHandComputedValues)
{
    const LoadedPicture x = pictureOf(2, 1, {1, 0, 2, 0, 0.5f, 0});
    const LoadedPicture r = pictureOf(2, 1, {0, 0, 1, 0, 1, 0});
    const Metrics m = computeMetrics(x, r, {});
    EXPECT_DOUBLE_EQ(m.mae.all, 2.5 / 6);
    EXPECT_DOUBLE_EQ(m.mse.all, 2.25 / 6);
    EXPECT_DOUBLE_EQ(m.rmse.all, std::sqrt(2.25 / 6));
    // 1/0.01 + 1/1.01 + 0.25/1.01, and 2*1/1.01 + 2*1/3.01 + 2*0.5/1.51
    EXPECT_NEAR(m.relMse.all, (100 + 1 / 1.01 + 0.25 / 1.01) / 6, 1e-12);
    EXPECT_NEAR(m.smape.all, (2 / 1.01 + 2 / 3.01 + 1 / 1.51) / 6, 1e-12);
    EXPECT_EQ(m.differingPixels, 2u);
    EXPECT_EQ(m.largestDifference.value, 1);
    EXPECT_EQ(m.largestDifference.x, 0u);
}

TEST(CompareMetrics, relMse_isRelativeToTheReference)
{
    const Metrics m = computeMetrics(grey(1, 1, 0.2f), grey(1, 1, 0.1f), {});
    const Metrics swapped = computeMetrics(grey(1, 1, 0.1f), grey(1, 1, 0.2f), {});
    EXPECT_NEAR(m.relMse.all, 0.5, 1e-6);        // 0.01 / (0.01 + 0.01)
    EXPECT_NEAR(swapped.relMse.all, 0.2, 1e-6);  // 0.01 / (0.04 + 0.01)
}

TEST(CompareMetrics, psnr_isOfDisplayValues)
{
    // sRGB: 0.0031308 linear is 0.04045; clipped, everything above 1 is white.
    EXPECT_NEAR(computeMetrics(grey(2, 2, 0.0031308f), grey(2, 2, 0), {}).psnr.all,
                -20 * std::log10(0.04045), 1e-3);
    EXPECT_EQ(computeMetrics(grey(2, 2, 7), grey(2, 2, 1), {}).psnr.all,
              std::numeric_limits<double>::infinity());
    EXPECT_NEAR(computeMetrics(grey(2, 2, 7), grey(2, 2, 0), {}).psnr.all, 0, 1e-9);
    CompareOptions darker;
    darker.exposure = -1;
    EXPECT_NEAR(computeMetrics(grey(2, 2, 2), grey(2, 2, 0), darker).psnr.all, 0, 1e-9);
}

TEST(CompareMetrics, trimmedMean_leavesOutTheLargestThousandth)
{
    std::vector<double> values(2000, 1.0);
    values[17] = 1e6;
    values[1234] = 500;
    const Measure mean = trimmedMean(values);
    EXPECT_DOUBLE_EQ(mean.trimmed, 1);
    EXPECT_DOUBLE_EQ(mean.all, (1998 + 1e6 + 500) / 2000);
    values.resize(999);  // a thousandth is less than one value
    EXPECT_EQ(trimmedMean(values).trimmed, trimmedMean(values).all);
    EXPECT_TRUE(std::isnan(trimmedMean({}).all));
}

TEST(CompareMetrics, pixelsThatAreNotFinite_areCountedAndLeftOutOfEverything)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<float> uniform;
    LoadedPicture a = grey(40, 30, 0), b = a;
    for (float& value : a.image.rgb) value = uniform(random);
    for (float& value : b.image.rgb) value = uniform(random);
    LoadedPicture brokenA = a, brokenB = b;
    const size_t at = 3 * (15 * 40 + 20);
    brokenA.image.rgb[at] = NOT_A_NUMBER;
    brokenA.image.rgb[at + 1] = -INFINITE;
    brokenB.image.rgb[at + 5] = INFINITE;
    const Metrics m = computeMetrics(brokenA, brokenB, {});
    EXPECT_EQ(m.pixels, 1198u);
    EXPECT_EQ(m.excludedPixels, 2u);
    EXPECT_EQ(m.unmatchedPixels, 2u);
    for (const Measure& measure :
         {m.mae, m.mse, m.relMse, m.smape, m.psnr, m.ssim, m.ldrFlip.mean, m.hdrFlip->mean}) {
        EXPECT_TRUE(std::isfinite(measure.all));
    }
    double sum = 0;
    for (size_t i = 0; i < a.image.rgb.size(); i++) {
        if (i / 3 != at / 3 && i / 3 != at / 3 + 1) {
            sum += std::fabs(double(a.image.rgb[i]) - b.image.rgb[i]);
        }
    }
    EXPECT_NEAR(m.mae.all, sum / (3 * 1198), 1e-12);
    EXPECT_TRUE(std::isnan(m.ldrFlip.map[at / 3]));
    EXPECT_FALSE(std::isnan(m.ldrFlip.map[at / 3 + 2]));

    const auto counts = countValues(brokenA.image);
    EXPECT_EQ(counts[0].nan, 1u);
    EXPECT_EQ(counts[1].infinite, 1u);
    EXPECT_EQ(counts[1].negative, 1u);  // an infinity below 0 is both
    EXPECT_EQ(counts[2].nan + counts[2].infinite + counts[2].negative, 0u);
}

TEST(CompareMetrics, nothingButNaN_leavesEveryMetricUndefined)
{
    const Metrics m = computeMetrics(grey(12, 12, NOT_A_NUMBER), grey(12, 12, 1), {});
    EXPECT_EQ(m.pixels, 0u);
    for (const Measure& measure : {m.mae, m.mse, m.rmse, m.relMse, m.smape, m.psnr, m.ssim,
                                   m.ldrFlip.mean, m.hdrFlip->mean}) {
        EXPECT_TRUE(std::isnan(measure.all));
        EXPECT_TRUE(std::isnan(measure.trimmed));
    }
}

TEST(CompareMetrics, extremeValues_giveFiniteMetrics)
{
    const float most = std::numeric_limits<float>::max();
    const Metrics m = computeMetrics(grey(12, 12, most), grey(12, 12, -most), {});
    EXPECT_DOUBLE_EQ(m.mae.all, 2.0 * most);
    EXPECT_TRUE(std::isfinite(m.mse.all) && std::isfinite(m.relMse.all));
    EXPECT_NEAR(m.smape.all, 2, 1e-9);
    EXPECT_LE(m.hdrFlip->largest, 1);
}

Plane planeOf(uint32_t width, uint32_t height, std::vector<float> values)
{
    return {width, height, std::move(values)};
}

TEST(CompareSsim, constantPlanes_followTheClosedForm)
{
    const Plane a = planeOf(13, 12, std::vector<float>(156, 0.25f));
    const Plane b = planeOf(13, 12, std::vector<float>(156, 0.5f));
    const std::vector<float> map = ssimMap(a, b, 2);
    ASSERT_EQ(map.size(), 6u);
    for (float value : map) EXPECT_NEAR(value, (2 * 0.125 + 1e-4) / (0.3125 + 1e-4), 1e-5);
}

TEST(CompareSsim, equalPlanesGiveOne_andInvertedContrastLessThanZero)
{
    std::vector<float> values, inverted;
    for (int i = 0; i < 400; i++) {
        values.push_back(0.5f + 0.3f * ((i / 20 + i) % 2 ? 1.0f : -1.0f));
        inverted.push_back(1 - values.back());
    }
    for (float value : ssimMap(planeOf(20, 20, values), planeOf(20, 20, values), 1)) {
        EXPECT_NEAR(value, 1, 1e-6);
    }
    for (float value : ssimMap(planeOf(20, 20, values), planeOf(20, 20, inverted), 1)) {
        EXPECT_LT(value, -0.95);
    }
}

TEST(CompareSsim, oneWindow_equalsTheSumsWrittenOut)
{
    std::vector<float> a, b;
    for (int i = 0; i < 121; i++) {
        a.push_back(static_cast<float>(i * 37 % 100) / 100);
        b.push_back(static_cast<float>(i * 53 % 90) / 90);
    }
    double weights = 0, ma = 0, mb = 0, saa = 0, sbb = 0, sab = 0;
    auto weight = [](int i) {
        return std::exp(-(std::pow(i % 11 - 5, 2) + std::pow(i / 11 - 5, 2)) / (2 * 1.5 * 1.5));
    };
    for (int i = 0; i < 121; i++) {
        weights += weight(i);
        ma += weight(i) * a[size_t(i)];
        mb += weight(i) * b[size_t(i)];
    }
    ma /= weights;
    mb /= weights;
    for (int i = 0; i < 121; i++) {
        saa += weight(i) * std::pow(a[size_t(i)] - ma, 2) / weights;
        sbb += weight(i) * std::pow(b[size_t(i)] - mb, 2) / weights;
        sab += weight(i) * (a[size_t(i)] - ma) * (b[size_t(i)] - mb) / weights;
    }
    const double expected =
        (2 * ma * mb + 1e-4) * (2 * sab + 9e-4) / ((ma * ma + mb * mb + 1e-4) * (saa + sbb + 9e-4));
    EXPECT_NEAR(ssimMap(planeOf(11, 11, a), planeOf(11, 11, b), 1).at(0), expected, 1e-6);
}

TEST(CompareSsim, picturesSmallerThanAWindow_haveNone)
{
    EXPECT_TRUE(std::isnan(computeMetrics(grey(10, 40, 1), grey(10, 40, 0), {}).ssim.all));
    EXPECT_NEAR(computeMetrics(grey(11, 11, 1), grey(11, 11, 1), {}).ssim.all, 1, 1e-6);
}

}  // namespace
}  // namespace sahl
