// Tests of means against noise: numbers worked out by hand, and what counts as evidence.
#include "compare/distributions.h"
#include "compare/noise.h"
#include "support/noisy_pictures.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sahl::testing {
namespace {

TEST(CompareDistributions, quantiles_equalPrintedTables)
{
    EXPECT_NEAR(normalQuantile(0.975), 1.959963985, 1e-8);
    EXPECT_NEAR(normalQuantile(0.8), 0.841621234, 1e-8);
    EXPECT_NEAR(normalQuantile(0.05), -1.644853627, 1e-8);
    EXPECT_NEAR(normalCdf(-3), 0.001349898, 1e-9);
    EXPECT_NEAR(studentCritical(0.05, 1), 12.7062, 1e-4);
    EXPECT_NEAR(studentCritical(0.05, 10), 2.228139, 1e-6);
    EXPECT_NEAR(studentCritical(0.01, 5), 4.032143, 1e-6);
    EXPECT_NEAR(studentCritical(0.05, 1e9), 1.959964, 1e-5);
    EXPECT_NEAR(studentCritical(0.1, 120), 1.657651, 1e-6);
}

TEST(CompareDistributions, student_hasItsClosedForms)
{
    for (double t : {0.0, 0.3, 1.0, 5.0, 100.0}) {
        // Of 1 degree: Cauchy. Of 2 degrees: 1 - t / sqrt(2 + t^2).
        EXPECT_NEAR(studentTwoSided(t, 1), 1 - 2 * std::atan(t) / std::acos(-1.0), 1e-12);
        EXPECT_NEAR(studentTwoSided(-t, 2), 1 - t / std::sqrt(2 + t * t), 1e-12);
        EXPECT_NEAR(studentTwoSided(t, 9.9e6), studentTwoSided(t, 1.01e7), 1e-7);
    }
    EXPECT_GT(studentTwoSided(30, 1e6), 0);
}

TEST(CompareNoise, frameAndBlocks_equalHandComputedValues)
{
    // 16 x 8 pixels: 2 blocks. Standard error of a pixel's difference: sqrt(0.04 + 0.05) = 0.3.
    LoadedPicture a = statedPicture(16, 8, 1.1f, 0.04f, 100);
    const LoadedPicture b = statedPicture(16, 8, 1, 0.05f, 80);
    const Statistics s = testDifferences(a, b, {});
    EXPECT_NEAR(s.frame.difference, 0.1, 1e-6);
    EXPECT_NEAR(s.frame.standardError, 0.3 / std::sqrt(128), 1e-6);
    EXPECT_NEAR(s.frame.z, 0.1 * std::sqrt(128) / 0.3, 1e-4);
    // 2 * (128 * 0.09)^2 / (128 * (0.04^2 + 0.05^2))
    EXPECT_NEAR(s.frame.degreesOfFreedom, 2 * 128 * 0.0081 / 0.0041, 0.01);
    ASSERT_EQ(s.blocks.size(), 2u);
    EXPECT_EQ(s.testedBlocks, 2u);
    EXPECT_NEAR(s.blocks[1].mean.z, 0.1 * 8 / 0.3, 1e-4);
    EXPECT_NEAR(s.z[17], 0.1 / 0.3, 1e-6);
    EXPECT_NEAR(s.meanA, 1.1, 1e-6);
}

TEST(CompareNoise, levels_addUpToTheStatedOne)
{
    CompareOptions options;
    options.level = 0.05;
    const Statistics s =
        testDifferences(statedPicture(80, 40, 1, 1, 4), statedPicture(80, 40, 1, 1, 4), options);
    EXPECT_EQ(s.testedBlocks, 50u);
    EXPECT_NEAR((1 - s.frameLevel) * std::pow(1 - s.blockLevel, 50), 0.95, 1e-12);
}

TEST(CompareNoise, equivalence_followsItsFormulas)
{
    CompareOptions options;
    options.margin = 0.01;
    // Standard error of the frame: sqrt(2 * 0.5) / 100 = 1 % of the mean.
    const LoadedPicture a = statedPicture(100, 100, 1, 0.5f, 10);
    const Statistics s = testDifferences(a, a, options);
    EXPECT_NEAR(s.confidenceBound, 1.64485 * 0.01, 1e-5);
    EXPECT_FALSE(s.equivalent);
    const double critical = normalQuantile(1 - 0.00501256 / 2);  // half of 1 %
    EXPECT_NEAR(s.detectableBias, (critical + 0.841621) * 0.01, 1e-5);
    EXPECT_NEAR(s.moreSamples, std::pow(critical + 0.841621, 2), 1e-3);
    options.margin = 0.02;
    EXPECT_TRUE(testDifferences(a, a, options).equivalent);
    // 100 times the samples bring the standard error to a tenth.
    const LoadedPicture more = statedPicture(100, 100, 1, 0.005f, 1000);
    EXPECT_NEAR(testDifferences(more, more, options).confidenceBound, 0.00164485, 1e-6);
}

TEST(CompareNoise, toleratedDifferences_areNone)
{
    const LoadedPicture a = statedPicture(64, 64, 1.004f, 1e-6f, 64);
    const LoadedPicture b = statedPicture(64, 64, 1, 1e-6f, 64);
    CompareOptions options;
    EXPECT_TRUE(testDifferences(a, b, options).frameDiffers);
    EXPECT_EQ(testDifferences(a, b, options).differingBlocks, 64u);
    options.tolerated = options.margin = 0.005;
    const Statistics s = testDifferences(a, b, options);
    EXPECT_FALSE(s.frameDiffers);
    EXPECT_EQ(s.differingBlocks, 0u);
    EXPECT_TRUE(s.equivalent);
}

TEST(CompareNoise, oneWrongBlock_isFoundWhereTheFrameHidesIt)
{
    LoadedPicture a = statedPicture(128, 128, 1, 0.01f, 64);
    const LoadedPicture b = a;
    for (uint32_t y = 40; y < 48; y++) {
        for (uint32_t x = 16; x < 24; x++) {
            for (uint32_t c = 0; c < 3; c++) a.image.rgb[3 * (y * 128 + x) + c] = 1.15f;
        }
    }
    const Statistics s = testDifferences(a, b, {});
    EXPECT_FALSE(s.frameDiffers);
    EXPECT_EQ(s.differingBlocks, 1u);
    EXPECT_TRUE(s.blocks[5 * 16 + 2].differs);
}

TEST(CompareNoise, pixelsWithoutSpreadInBoth_areNoEvidenceByThemselves)
{
    LoadedPicture a = statedPicture(16, 16, 1, 0, 16);
    LoadedPicture b = statedPicture(16, 16, 1, 0, 16);
    a.image.rgb[0] = a.image.rgb[1] = a.image.rgb[2] = 2;
    const Statistics s = testDifferences(a, b, {});
    EXPECT_EQ(s.noEvidencePixels, 256u);
    EXPECT_EQ(s.noEvidenceDiffering, 1u);
    EXPECT_NEAR(s.noEvidenceShare, 1.0 / 256, 1e-4);
    EXPECT_EQ(s.testedBlocks, 0u);
    EXPECT_FALSE(s.frameDiffers);
    EXPECT_EQ(s.frame.standardError, 0);
    for (float z : s.z) EXPECT_TRUE(std::isnan(z));
}

TEST(CompareNoise, oneBrightPixel_isNoEvidenceOfMore)
{
    // A single pixel of 1024 met rare light, in one of 16 samples: its variance is all there is.
    LoadedPicture a = statedPicture(32, 32, 0, 0, 16);
    const LoadedPicture b = a;
    for (size_t c = 0; c < 3; c++) a.image.rgb[3 * 100 + c] = 100.0f / 16;
    a.variance[100] = (100.0f * 100.0f / 16 - 100.0f * 100.0f / 256) / 15;
    const Statistics s = testDifferences(a, b, {});
    EXPECT_NEAR(s.frame.z, 1, 1e-3);
    EXPECT_NEAR(s.frame.degreesOfFreedom, 2, 1e-6);
    EXPECT_FALSE(s.frameDiffers);
    EXPECT_EQ(s.differingBlocks, 0u);
}

TEST(CompareNoise, fewSamplesThatMetNoLight_areJudgedByTheOtherFile)
{
    // One in 100 samples is 100: mean 1, variance of a sample 99 * 100. With 2 samples per pixel a
    // block of 64 is black in a quarter of all cases; its own variance, 0, knows nothing of that.
    const LoadedPicture black = statedPicture(8, 8, 0, 0, 2);
    const LoadedPicture right = statedPicture(8, 8, 1, 9900.0f / 1e5f, 1e5f);
    const Statistics s = testDifferences(black, right, {});
    EXPECT_NEAR(s.frame.standardError, std::sqrt(9900.0 / 2 / 64), 0.01);
    EXPECT_FALSE(s.frameDiffers);
    EXPECT_EQ(s.differingBlocks, 0u);
}

TEST(CompareNoise, pixelsWithoutUsableVariance_areLeftOutAndCounted)
{
    LoadedPicture a = statedPicture(8, 8, 1, 0.1f, 4);
    const LoadedPicture b = a;
    a.variance[3] = std::numeric_limits<float>::quiet_NaN();
    a.variance[4] = -1;
    a.image.rgb[3 * 5] = std::numeric_limits<float>::infinity();
    a.samples[6] = 1;
    const Statistics s = testDifferences(a, b, {});
    EXPECT_EQ(s.excludedPixels, 4u);
    EXPECT_NEAR(s.frame.standardError, std::sqrt(0.2 / 60), 1e-6);
}

TEST(CompareNoise, roundingOfFloats_isNoDifference)
{
    // A systematic difference of one unit in the last place, with hardly any noise.
    const LoadedPicture a = statedPicture(64, 64, 1, 1e-20f, 65536);
    const LoadedPicture b = statedPicture(64, 64, std::nextafter(1.0f, 2.0f), 1e-20f, 65536);
    const Statistics s = testDifferences(a, b, {});
    EXPECT_FALSE(s.frameDiffers);
    EXPECT_EQ(s.differingBlocks, 0u);
}

TEST(CompareNoise, pairedDifferences_areMeansOverBlocks)
{
    LoadedPicture a = statedPicture(16, 8, 1, 0.1f, 4);
    const LoadedPicture b = a;
    for (size_t i = 0; i < a.image.rgb.size(); i++) {
        if (i / 3 % 16 < 8) a.image.rgb[i] = 1.2f;
    }
    const PairedDifferences paired = pairDifferences(a, b);  // 0.2 and 0, of a mean of 1.05
    EXPECT_NEAR(paired.mean, 0.1 / 1.05, 1e-6);
    EXPECT_NEAR(paired.largest, 0.2 / 1.05, 1e-6);
    EXPECT_NEAR(paired.spread, 0.1 / 1.05, 1e-6);
}

}  // namespace
}  // namespace sahl::testing
