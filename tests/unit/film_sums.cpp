// The film: where blocks go, and that no split of the work changes the sums.
#include "film/film_error.h"
#include "util/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace sahl {
namespace {

PixelBlock makeBlock(float value, uint32_t samples)
{
    PixelBlock block = {};
    block.sum = vec3(value, 2 * value, 4 * value);
    block.sumY2 = value * value;
    block.samplesDone = samples;
    block.digest = 0x80000001u;
    block.indirectRays = 2;
    block.shadowRays = 3;
    block.boxTests = 4;
    block.primitiveTests = 5;
    block.bounces = 6;
    block.badSamples = 1;
    return block;
}

TEST(Film, add_putsEvenBlocksIntoAAndOddOnesIntoB)
{
    Film film(1, 1);
    for (uint32_t k = 0; k < 5; k++) {
        const PixelBlock block = makeBlock(static_cast<float>(1 + k), 8);
        film.add(0, 0, 1, 1, k * BLOCK_SIZE, {&block, 1});
    }
    EXPECT_EQ(film.half[0][0].sum[0], (Fixed64x64{1 + 3 + 5, 0}));
    EXPECT_EQ(film.half[1][0].sum[0], (Fixed64x64{2 + 4, 0}));
    EXPECT_EQ(film.half[1][0].sum[2], (Fixed64x64{4 * (2 + 4), 0}));
    EXPECT_EQ(film.half[0][0].sumY2, (Fixed64x64{1 + 9 + 25, 0}));
    EXPECT_EQ(film.half[0][0].samples, 24u);
    EXPECT_EQ(film.half[1][0].samples, 16u);
    EXPECT_EQ(film.digest[0], 5 * 0x80000001u);  // wraps around
}

/// A block of 8 samples of grey light whose luminances add up to `sum`; what it says of their squares is of no use.
PixelBlock greyBlock(float sum, uint32_t samples = BLOCK_SIZE)
{
    PixelBlock block = {};
    block.sum = vec3(sum);
    block.sumY2 = 12345;
    block.samplesDone = samples;
    return block;
}

TEST(Film, add_ofReplicatesOf64_putsThemIntoHalvesInTurnsAndSquaresEachAsAWhole)
{
    Film film(1, 1);
    film.replicateSize = 64;
    std::mt19937 random(11);
    // Of the replicate so far, and of those before, by half
    double sum = 0, squares[2] = {};
    for (uint32_t pass = 0; pass < 35; pass++) {
        const uint32_t first = pass * BLOCK_SIZE, half = first / 64 % 2, before = first % 64;
        const uint32_t samples = pass == 34 ? 5 : BLOCK_SIZE;
        const PixelBlock block = greyBlock(static_cast<float>(random() % 1000) / 16, samples);
        film.add(0, 0, 1, 1, first, {&block, 1});
        sum = (before == 0 ? 0 : sum) + block.sum.x;
        const double ofReplicate = sum * sum / (before + samples);
        EXPECT_EQ(film.half[half][0].samples, first / 128 * 64 + before + samples);
        // A few roundings of double
        EXPECT_NEAR(film.half[half][0].sumY2.toDouble(), squares[half] + ofReplicate, 1e-15 * (squares[half] + ofReplicate));
        EXPECT_NEAR(film.half[1 - half][0].sumY2.toDouble(), squares[1 - half], 1e-15 * squares[1 - half]);
        if (before + samples == 64) squares[half] += ofReplicate;
    }
    // 4 whole replicates, and 21 samples of a fifth
    EXPECT_EQ(pixelStatistics(film, 0).replicates, 5);
}

TEST(Film, ofReplicatesOf64_isTheSumOfPartsThatTearNoneApart)
{
    std::mt19937 random(12);
    std::vector<PixelBlock> blocks;
    for (uint32_t pass = 0; pass < 30; pass++) blocks.push_back(greyBlock(static_cast<float>(random() % 100000) / 977));
    Film whole(1, 1), parts(1, 1);
    whole.replicateSize = parts.replicateSize = 64;
    for (uint32_t pass = 0; pass < 30; pass++) whole.add(0, 0, 1, 1, pass * BLOCK_SIZE, {&blocks[pass], 1});
    for (auto [first, end] : {std::pair{16u, 30u}, {0u, 8u}, {8u, 16u}}) {
        Film part(1, 1);
        part.replicateSize = 64;
        for (uint32_t pass = first; pass < end; pass++) part.add(0, 0, 1, 1, pass * BLOCK_SIZE, {&blocks[pass], 1});
        parts.merge(part);
    }
    EXPECT_TRUE(parts == whole);
    Film other(1, 1);
    EXPECT_THROW(other.merge(whole), Error);
}

TEST(Film, add_putsTilesWhereTheyBelong)
{
    Film film(5, 4);
    const std::vector<PixelBlock> blocks = {makeBlock(1, 8), makeBlock(2, 8), makeBlock(3, 8),
                                            makeBlock(4, 8), makeBlock(5, 8), makeBlock(6, 8)};
    film.add(2, 1, 3, 2, 0, blocks);
    const Image mean = meanImage(film);
    const float expected[4][5] = {
        {0, 0, 0, 0, 0}, {0, 0, 1, 2, 3}, {0, 0, 4, 5, 6}, {0, 0, 0, 0, 0}};
    for (size_t y = 0; y < 4; y++) {
        for (size_t x = 0; x < 5; x++) {
            EXPECT_EQ(mean.rgb[3 * (5 * y + x)], expected[y][x] / 8) << x << ", " << y;
        }
    }
}

TEST(Film, add_countsTheWork)
{
    Film film(2, 1);
    const PixelBlock blocks[2] = {makeBlock(1, 8), makeBlock(1, 3)};
    film.add(0, 0, 2, 1, 0, blocks);
    const Counters expected = {11, 4, 6, 8, 10, 12, 2};
    EXPECT_EQ(film.counters, expected);
}

TEST(Film, add_countsTheWorkOfEachPixel)
{
    Film film(2, 1);
    PixelBlock blocks[2] = {makeBlock(1, 8), makeBlock(1, 3)};
    blocks[1].boxTests = 10;
    film.add(0, 0, 2, 1, 0, blocks);
    film.add(0, 0, 2, 1, BLOCK_SIZE, blocks);
    EXPECT_EQ(film.work[0], (PixelWork{8, 10}));
    EXPECT_EQ(film.work[1], (PixelWork{20, 10}));
    Film merged = film;
    merged.merge(film);
    EXPECT_EQ(merged.work[1], (PixelWork{40, 20}));
}

TEST(PixelWork, staysAtTheLargestNumber)
{
    PixelWork work = {0xfffffff0u, 7};
    work.add({0xfu, 1});
    EXPECT_EQ(work, (PixelWork{0xffffffffu, 8}));
    work.add({2, 1});
    EXPECT_EQ(work, (PixelWork{0xffffffffu, 9}));
}

TEST(Film, add_saturatesOnSumsThatOverflowedToInfinity)
{
    Film film(1, 1);
    PixelBlock block = makeBlock(1, 8);
    block.sumY2 = std::numeric_limits<float>::infinity();
    film.add(0, 0, 1, 1, 0, {&block, 1});
    EXPECT_EQ(film.half[0][0].sumY2.whole, std::numeric_limits<uint64_t>::max());
    EXPECT_EQ(film.half[0][0].sum[0], (Fixed64x64{1, 0}));
}

TEST(Film, meanImage_poolsBothHalves)
{
    Film film(2, 1);
    const PixelBlock a[2] = {makeBlock(8, 8), makeBlock(0, 0)};
    const PixelBlock b[2] = {makeBlock(3, 3), makeBlock(0, 0)};
    film.add(0, 0, 2, 1, 0, a);
    film.add(0, 0, 2, 1, BLOCK_SIZE, b);
    const Image mean = meanImage(film);
    EXPECT_EQ(mean.width, 2u);
    EXPECT_EQ(mean.height, 1u);
    EXPECT_EQ(mean.rgb, (std::vector<float>{1, 2, 4, 0, 0, 0}));  // no samples: black
}

TEST(Film, meanImage_isThatOfTheHalvesMeansWhereTheseWeighEqually)
{
    // A: 16 samples of 1; B: 8 samples of 4.
    Film film(1, 1);
    PixelBlock block = {};
    block.samplesDone = 8;
    block.sum = vec3(8);
    block.sumY2 = 8;
    for (uint32_t first : {0u, 16u}) film.add(0, 0, 1, 1, first, {&block, 1});
    film.halvesWeighEqually = true;
    EXPECT_EQ(meanImage(film).rgb[0], 1.0f) << "without B there is only A";
    block.sum = vec3(32);
    block.sumY2 = 8 * 23;  // some spread: variance 7 of a mean square of 23 about 16
    film.add(0, 0, 1, 1, 8, {&block, 1});
    EXPECT_EQ(meanImage(film).rgb[0], 2.5f);
    // Variance: A none, B 7 8/7 / 8 = 1 of its mean, a quarter of that of the picture.
    EXPECT_NEAR(pixelStatistics(film, 0).varianceOfMean, 0.25, 1e-6);
    EXPECT_NEAR(pixelErrors(film)[0], 0.5 / 2.5, 1e-6);
    film.halvesWeighEqually = false;
    EXPECT_EQ(meanImage(film).rgb[0], 2.0f);
}

TEST(Film, meanImage_roundsTheExactSumOnce)
{
    Film film(1, 1);
    // In float or double the small terms would vanish beside the large one.
    const PixelBlock large = makeBlock(0x1p40f, 1), small = makeBlock(0x1p-20f, 1);
    film.add(0, 0, 1, 1, 0, {&large, 1});
    for (int i = 0; i < 63; i++) film.add(0, 0, 1, 1, BLOCK_SIZE, {&small, 1});
    EXPECT_EQ(film.half[1][0].sum[0], Fixed64x64::fromFloat(63 * 0x1p-20f));
    EXPECT_EQ(meanImage(film).rgb[0], static_cast<float>((0x1p40 + 63 * 0x1p-20) / 64));
}

/// 40 random blocks on each pixel of a 4 x 3 film, as (pixel, first sample, block).
struct Work {
    uint32_t x, y, firstSample;
    PixelBlock block;
};

std::vector<Work> randomWork()
{
    std::mt19937 random(11);
    std::vector<Work> all;
    for (uint32_t i = 0; i < 4 * 3 * 40; i++) {
        PixelBlock block = makeBlock(
            std::ldexp(static_cast<float>(random() % 100000), -30 + i % 50), 1 + random() % 8);
        block.digest = static_cast<uint32_t>(random());
        all.push_back({i % 4, i / 4 % 3, i / 12 * BLOCK_SIZE, block});
    }
    return all;
}

void addAll(Film& film, std::span<const Work> work)
{
    for (const Work& w : work) film.add(w.x, w.y, 1, 1, w.firstSample, {&w.block, 1});
}

TEST(Film, add_doesNotDependOnTheOrder)
{
    std::vector<Work> work = randomWork();
    Film first(4, 3);
    addAll(first, work);
    std::mt19937 random(12);
    for (int round = 0; round < 5; round++) {
        std::shuffle(work.begin(), work.end(), random);
        Film film(4, 3);
        addAll(film, work);
        ASSERT_TRUE(film == first);
    }
}

TEST(Film, merge_givesTheSameFilmAsOneRun)
{
    const std::vector<Work> work = randomWork();
    Film whole(4, 3);
    addAll(whole, work);
    Film shards[3] = {Film(4, 3), Film(4, 3), Film(4, 3)};
    const std::span<const Work> all = work;
    addAll(shards[0], all.subspan(0, 100));
    addAll(shards[1], all.subspan(100, 17));
    addAll(shards[2], all.subspan(117));
    Film merged = shards[2];
    merged.merge(shards[0]);
    merged.merge(shards[1]);
    EXPECT_TRUE(merged == whole);
    EXPECT_EQ(meanImage(merged).rgb, meanImage(whole).rgb);
}

TEST(Film, merge_refusesAnotherSize)
{
    Film film(4, 3);
    EXPECT_THROW(film.merge(Film(3, 4)), Error);
}

}  // namespace
}  // namespace sahl
