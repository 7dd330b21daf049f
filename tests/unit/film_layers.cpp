// The channels that go along with a picture.

#include "film/layers.h"

#include <gtest/gtest.h>

namespace sahl {
namespace {

const ImageChannel& channelNamed(const std::vector<ImageChannel>& channels, const std::string& name)
{
    for (const ImageChannel& channel : channels) {
        if (channel.name == name) return channel;
    }
    throw std::logic_error("no channel " + name);
}

/// One pixel of 4 samples of which 2 hit something, and one that saw nothing.
std::vector<FirstHits> twoPixels()
{
    FirstHits hit = {};
    hit.albedo = {1, 0.5f, 0};
    hit.depth = 6;
    hit.ns = {0, 3, 4};
    hit.ng = {0, 0, 2};
    hit.position = {2, 4, 8};
    hit.hits = 2;
    hit.number = 7;
    hit.material = 3;
    FirstHits miss = {};
    miss.number = miss.material = 0xffffffffu;
    return {hit, miss};
}

TEST(FirstHitChannels, areMeansOverWhatWasHit)
{
    const std::vector<uint32_t> objectStarts = {0, 5, 9};
    auto channels = firstHitChannels(twoPixels(), 4, objectStarts);
    auto expect = [&](const char* name, float hit, float miss) {
        EXPECT_FLOAT_EQ(channelNamed(channels, name).values.at(0), hit) << name;
        EXPECT_FLOAT_EQ(channelNamed(channels, name).values.at(1), miss) << name;
    };
    expect("albedo.R", 0.25f, 0);   // over all samples: the others were black
    expect("albedo.G", 0.125f, 0);
    expect("depth.Z", 3, 0);        // over those that hit
    expect("position.X", 1, 0);
    expect("position.Z", 4, 0);
    expect("normal.Y", 0.6f, 0);    // unit
    expect("normal.Z", 0.8f, 0);
    expect("geometricNormal.Z", 1, 0);
    expect("objectId.Y", 2, 0);     // primitive 7 lies in the second object
    expect("materialId.Y", 4, 0);
}

TEST(StatisticsChannels, giveCountsAndTheVarianceOfTheMean)
{
    // Samples of luminance 1 and 3: mean 2, variance of the samples 2, of their mean 1.
    Film film(1, 1);
    PixelBlock block = {};
    block.sum = {4, 4, 4};
    block.sumY2 = 10;
    block.samplesDone = 2;
    film.add(0, 0, 1, 1, 0, {&block, 1});
    auto channels = statisticsChannels(film);
    EXPECT_EQ(channelNamed(channels, "samples.Y").values.at(0), 2);
    EXPECT_NEAR(channelNamed(channels, "variance.Y").values.at(0), 1, 1e-6);
}

TEST(StatisticsChannels, giveTheWorkOfAllSamples)
{
    Film film(1, 1);
    PixelBlock block = {};
    block.samplesDone = BLOCK_SIZE;
    block.boxTests = 26;  // two at each node
    block.primitiveTests = 5;
    film.add(0, 0, 1, 1, 0, {&block, 1});
    film.add(0, 0, 1, 1, BLOCK_SIZE, {&block, 1});
    auto channels = statisticsChannels(film);
    EXPECT_EQ(channelNamed(channels, "nodeVisits.Y").values.at(0), 26);
    EXPECT_EQ(channelNamed(channels, "primitiveTests.Y").values.at(0), 10);
}

TEST(StatisticsChannels, haveNoVarianceOfOneSample)
{
    Film film(1, 1);
    PixelBlock block = {};
    block.sum = {1, 1, 1};
    block.sumY2 = 1;
    block.samplesDone = 1;
    film.add(0, 0, 1, 1, 0, {&block, 1});
    EXPECT_EQ(channelNamed(statisticsChannels(film), "variance.Y").values.at(0), 0);
}

}  // namespace
}  // namespace sahl
