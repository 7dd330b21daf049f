// Counts of values, and that plots show them.
#include "image/histogram.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

namespace sahl {
namespace {

uint64_t sumOf(const Histogram& histogram)
{
    return std::accumulate(histogram.counts.begin(), histogram.counts.end(), uint64_t{0});
}

TEST(Histogram, countsByHand)
{
    const std::vector<float> values = {0, 1, 1.9f, 2, 3.5f, 4, 4, 8};
    const Histogram histogram = histogramOfRange(values, 4);  // [0,2) [2,4) [4,6) [6,8]
    EXPECT_EQ(histogram.low, 0);
    EXPECT_EQ(histogram.high, 8);
    EXPECT_EQ(histogram.counts, (std::vector<uint64_t>{3, 2, 2, 1}));
    const Histogram unit = histogramOfUnit(std::vector<float>{0, 0.25f, 0.24f, 0.5f, 1}, 4);
    EXPECT_EQ(unit.counts, (std::vector<uint64_t>{2, 1, 1, 1}));
}

TEST(Histogram, countsAddUpToTheNumberOfValues)
{
    std::mt19937 random(5);
    std::lognormal_distribution<float> bright(0, 3);
    std::vector<float> values(30011);
    for (float& value : values) value = bright(random) - 1;
    for (size_t bins : {1u, 7u, 160u, 4096u}) {
        EXPECT_EQ(sumOf(histogramOfRange(values, bins)), values.size());
    }
    values[17] = 3e38f;
    values[18] = -3e38f;
    EXPECT_EQ(sumOf(histogramOfRange(values, 160)), values.size());
}

TEST(Histogram, ofEqualValues_hasThemInTheMiddle)
{
    const Histogram histogram = histogramOfRange(std::vector<float>{2, 2, 2}, 5);
    EXPECT_EQ(histogram.counts, (std::vector<uint64_t>{0, 0, 3, 0, 0}));
}

/// Height of the bar of each bin [pixels], found by its colour.
std::vector<int> barHeights(const Image8& image, size_t bins, uint32_t top, uint32_t height)
{
    std::vector<int> heights(bins);
    uint32_t left = image.width;  // of the first bar, by the bar in the first bin
    auto isBar = [&](uint32_t x, uint32_t y) {
        const uint8_t* rgb = &image.rgb[size_t{3} * (size_t{y} * image.width + x)];
        return rgb[0] == 49 && rgb[1] == 104 && rgb[2] == 142;
    };
    for (uint32_t y = top; y < top + height; y++) {
        for (uint32_t x = 0; x < image.width; x++) {
            if (isBar(x, y)) left = std::min(left, x);
        }
    }
    for (size_t i = 0; i < bins; i++) {
        for (uint32_t y = top; y < top + height; y++) {
            const uint32_t x = left + 4 * static_cast<uint32_t>(i) + 1;
            heights[i] += x < image.width && isBar(x, y);
        }
    }
    return heights;
}

TEST(HistogramPlot, barsGrowWithTheLogarithmOfTheCount)
{
    HistogramPlot plot = {"values", {0, 1, std::vector<uint64_t>(40)}};
    plot.histogram.counts[0] = 1;
    plot.histogram.counts[1] = 10;
    plot.histogram.counts[2] = 100;
    plot.histogram.counts[39] = 1000;
    const Image8 image = plotHistograms({&plot, 1});
    const std::vector<int> heights = barHeights(image, 40, 0, image.height);
    EXPECT_GT(heights[0], 5) << "a single value shows";
    EXPECT_EQ(heights[3], 0);
    const int decade = heights[1] - heights[0];
    EXPECT_GT(decade, 20);
    EXPECT_NEAR(heights[2] - heights[1], decade, 2);
    EXPECT_NEAR(heights[39] - heights[2], decade, 2);
}

TEST(HistogramPlot, plots_standBelowEachOther)
{
    HistogramPlot plots[2] = {{"before", {0, 1, std::vector<uint64_t>(20)}},
                              {"after", {0, 1, std::vector<uint64_t>(20)}}};
    plots[0].histogram.counts[0] = 5;
    plots[1].histogram.counts[0] = 5;
    plots[1].histogram.counts[19] = 5;
    const Image8 image = plotHistograms(plots);
    const uint32_t half = image.height / 2;
    const std::vector<int> upper = barHeights(image, 20, 0, half);
    const std::vector<int> lower = barHeights(image, 20, half, half);
    EXPECT_EQ(upper[19], 0);
    EXPECT_EQ(lower[19], lower[0]);
    EXPECT_EQ(lower[0], upper[0]);
    EXPECT_GT(lower[0], 0);
}

}  // namespace
}  // namespace sahl
