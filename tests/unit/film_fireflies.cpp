// Which pixels stand out because of one sample, with answers known by hand.
#include "film/fireflies.h"

#include <gtest/gtest.h>

namespace sahl {
namespace {

/// One pixel's samples, grey, put into a film in blocks of 8.
void addSamples(Film& film, uint32_t x, uint32_t y, const std::vector<float>& values)
{
    for (uint32_t first = 0; first < values.size(); first += BLOCK_SIZE) {
        PixelBlock block = {};
        float sum = 0;
        for (size_t i = first; i < values.size() && block.samplesDone < BLOCK_SIZE; i++) {
            sum += values[i];
            block.sumY2 += values[i] * values[i];
            block.samplesDone++;
        }
        block.sum = vec3(sum);
        if (film.replicateSize == BLOCK_SIZE) block.sumY2 = sum * sum / float(block.samplesDone);
        film.add(x, y, 1, 1, first, {&block, 1});
    }
}

std::vector<float> samplesOf(size_t count, float usual, float brightest)
{
    std::vector<float> values(count, usual);
    values.back() = brightest;
    return values;
}

/// A film of 5 x 5 pixels of brightness 1, but for the middle.
Film filmAround(const std::vector<float>& middle, bool overBlocks = false)
{
    Film film(5, 5);
    film.replicateSize = overBlocks ? BLOCK_SIZE : 1;
    for (uint32_t i = 0; i < 25; i++) {
        if (i != 12) addSamples(film, i % 5, i / 5, std::vector<float>(middle.size(), 1));
    }
    addSamples(film, 2, 2, middle);
    return film;
}

TEST(Fireflies, arePixelsThatOneSampleMadeBright)
{
    const Film film = filmAround(samplesOf(64, 1, 1 + 64 * 3));  // mean 4
    const std::vector<Firefly> found = firefliesOf(film);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].x, 2u);
    EXPECT_EQ(found[0].y, 2u);
    EXPECT_NEAR(found[0].luminance, 4, 1e-6);
    EXPECT_NEAR(found[0].around, 1, 1e-6);
    EXPECT_LE(found[0].share, 193.0 / 256);  // of the brightest; told is a lower bound
    EXPECT_GT(found[0].share, 0.5);
    EXPECT_NEAR(excessShare(film, found), 3 / 28.0, 1e-6);
    const ImageChannel channel = fireflyChannel(film, found);
    EXPECT_NEAR(channel.values[12], 4, 1e-6);
    EXPECT_EQ(channel.values[11], 0);
}

TEST(Fireflies, areNotWhatAllSamplesSee)
{
    EXPECT_TRUE(firefliesOf(filmAround(std::vector<float>(64, 100))).empty()) << "a lamp";
    std::vector<float> edge(64, 1);
    for (size_t i = 0; i < 16; i++) edge[4 * i] = 50;
    EXPECT_TRUE(firefliesOf(filmAround(edge)).empty()) << "its edge";
    EXPECT_TRUE(firefliesOf(filmAround(samplesOf(64, 1, 20))).empty()) << "mere noise";
    EXPECT_TRUE(firefliesOf(filmAround(std::vector<float>(64, 1))).empty());
}

TEST(Fireflies, areFoundAmongBlocksToo)
{
    const std::vector<float> values = samplesOf(64, 1, 1 + 64 * 3);
    ASSERT_EQ(firefliesOf(filmAround(values, true)).size(), 1u);
    EXPECT_TRUE(firefliesOf(filmAround(samplesOf(56, 1, 1000), true)).empty())
        << "7 blocks are too few to tell";
    EXPECT_TRUE(firefliesOf(filmAround(std::vector<float>(64, 100), true)).empty());
}

TEST(Fireflies, areComparedWithTheDarkestThatCountsWhereAllAroundIsBlack)
{
    Film film(9, 1);
    addSamples(film, 0, 0, std::vector<float>(64, 8));
    addSamples(film, 8, 0, samplesOf(64, 0, 0.5f));
    ASSERT_TRUE(firefliesOf(film).empty()) << "10 % of the mean of all is more than half of it";
    addSamples(film, 7, 0, samplesOf(64, 0, 64));
    const std::vector<Firefly> found = firefliesOf(film);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].x, 7u);
    EXPECT_EQ(found[0].share, 1);
}

TEST(Fireflies, areSortedByWhatTheyHaveTooMuch)
{
    Film film(9, 1);
    for (uint32_t x = 0; x < 9; x++) {
        addSamples(film, x, 0, samplesOf(64, 1, x == 4 ? 500.0f : x == 7 ? 900.0f : 1.0f));
    }
    const std::vector<Firefly> found = firefliesOf(film);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0].x, 7u);
    EXPECT_EQ(found[1].x, 4u);
}

}  // namespace
}  // namespace sahl
