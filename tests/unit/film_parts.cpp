// Ranges of samples, and films as channels of files.
#include "film/merge.h"
#include "film/replicates.h"
#include "film/sample_ranges.h"
#include "shared/scene_types.h"
#include "support/film_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace sahl::testing {
namespace {

TEST(SampleRanges, text_goesThereAndBack)
{
    const SampleRanges ranges = {{0, 64}, {128, 192}, {200, 203}};
    EXPECT_EQ(rangesText(ranges), "0:64,128:192,200:203");
    EXPECT_EQ(parseRanges("0:64,128:192,200:203"), ranges);
    EXPECT_EQ(parseRanges("0:16777216"), (SampleRanges{{0, MAX_SAMPLES}}));
    for (const char* text : {"", "0:16777217", "0:0", "4:8", "0:8,8:16", "8:16,0:8", "0:8;16:24"})
        EXPECT_FALSE(parseRanges(text)) << text;
}

TEST(SampleRanges, unionAndGaps_areComplements)
{
    EXPECT_EQ(unionOf({{64, 128}, {0, 64}, {136, 144}}), (SampleRanges{{0, 128}, {136, 144}}));
    EXPECT_EQ(gapsIn({{0, 128}, {136, 144}}, 160), (SampleRanges{{128, 136}, {144, 160}}));
    EXPECT_EQ(gapsIn({{8, 16}}, 16), (SampleRanges{{0, 8}}));
    EXPECT_EQ(gapsIn({{0, 16}}, 16), SampleRanges{});
    EXPECT_EQ(gapsIn({}, 16), (SampleRanges{{0, 16}}));
}

TEST(SampleRanges, samplesAndBlocks_areCountedAsOneByOne)
{
    std::mt19937 random(1);
    for (int i = 0; i < 200; i++) {
        const uint32_t first = static_cast<uint32_t>(random() % 10) * 8;
        const SampleRange range = {first, first + 1 + static_cast<uint32_t>(random() % 60)};
        uint32_t ofHalf[2] = {};
        for (uint32_t s = range.first; s < range.end; s++) ofHalf[s / 8 % 2]++;
        EXPECT_EQ(samplesOfHalf({range}, 0), ofHalf[0]) << rangeText(range);
        EXPECT_EQ(samplesOfHalf({range}, 1), ofHalf[1]) << rangeText(range);
        EXPECT_EQ(samplesIn({range}), range.end - range.first);
        EXPECT_EQ(blocksIn(SampleRanges{range}), (range.end - range.first + 7) / 8);
    }
}

TEST(SampleRanges, ofBlocksOf64_areCountedSharedOutAndTornApartAsThose)
{
    EXPECT_EQ(samplesOfHalf({{0, 64}, {128, 300}}, 0, 64), 64u + 64u + 44u);
    EXPECT_EQ(samplesOfHalf({{0, 64}, {128, 300}}, 1, 64), 64u);
    EXPECT_EQ(blocksIn(300, 64), 5u);
    EXPECT_EQ(shardOf(1, 3, 300, 64), (SampleRange{64, 192}));
    EXPECT_EQ(shardOf(2, 3, 300, 64), (SampleRange{192, 300}));
    EXPECT_TRUE(beginWithBlocks({{0, 64}, {128, 300}}, 64));
    EXPECT_FALSE(beginWithBlocks({{0, 64}, {72, 300}}, 64));
    EXPECT_TRUE(beginWithBlocks({{8, 64}}, 8));
}

TEST(Replicates, haveASizeASamplerAndANameInFiles)
{
    const std::pair<uint32_t, uint32_t> sizes[] = {{SAMPLER_INDEPENDENT, 1}, {SAMPLER_SOBOL, 8}, {SAMPLER_SOBOL64, 64}};
    for (auto [sampler, size] : sizes) {
        EXPECT_EQ(replicateSizeOf(sampler), size);
        EXPECT_EQ(replicateSizeIn(varianceOver(size)), size);
        EXPECT_EQ(blockOfReplicates(size), std::max(size, 8u));
    }
    EXPECT_EQ(replicateSizeIn("blocks of 32"), 1u);
    EXPECT_EQ(replicatesIn(129, 64), 3u);
    EXPECT_EQ(replicatesIn(128, 64), 2u);
    EXPECT_EQ(replicatesIn(5, 1), 5u);
}

TEST(SampleRanges, shards_coverThePictureInOrderAndNoneIsEmpty)
{
    for (uint32_t total : {1u, 8u, 9u, 64u, 125u, 16777216u, 16777215u}) {
        for (uint32_t count : {1u, 2u, 3u, 7u, 16u, 1000u, 2097152u}) {
            if (count > blocksIn(total)) continue;
            uint32_t next = 0;
            for (uint32_t i = 0; i < count; i++) {
                const SampleRange shard = shardOf(i, count, total);
                ASSERT_EQ(shard.first, next);
                ASSERT_GT(shard.end, shard.first);
                ASSERT_TRUE(shard.end % 8 == 0 || shard.end == total);
                next = shard.end;
            }
            ASSERT_EQ(next, total);
        }
    }
    EXPECT_EQ(shardOf(1, 3, 37), (SampleRange{8, 24}));
}

TEST(FilmChannels, names_areDistinctAndDescribed)
{
    std::vector<std::string> names = filmChannelNames();
    EXPECT_EQ(names.size(), 37u);
    EXPECT_EQ(names[0], "film.A.red0");
    EXPECT_EQ(names[15], "film.A.squares3");
    EXPECT_EQ(names[16], "film.A.samples");
    EXPECT_EQ(names[21], "film.B.green0");
    std::sort(names.begin(), names.end());
    EXPECT_EQ(std::unique(names.begin(), names.end()), names.end());
}

TEST(FilmChannels, words_areThoseOfTheNumbers)
{
    Film film(2, 1);
    film.half[0][1].sum[0] = {0x1122334455667788u, 0x99aabbccddeeff00u};
    film.half[1][1].sumY2 = {7, 0};
    film.half[1][1].samples = 5;
    film.digest[1] = 0xabcdef01u;
    film.work[1] = {3, 4};
    const FilmFileParts parts = [&] {
        FilmFileParts made;
        made.film = film;
        made.fromFilm({{{0, 8}}, 8});
        return made;
    }();
    auto word = [&](const std::string& name) {
        const auto found = std::find(parts.names.begin(), parts.names.end(), name);
        return parts.words[static_cast<size_t>(found - parts.names.begin())][1];
    };
    EXPECT_EQ(word("film.A.red0"), 0xddeeff00u);
    EXPECT_EQ(word("film.A.red1"), 0x99aabbccu);
    EXPECT_EQ(word("film.A.red2"), 0x55667788u);
    EXPECT_EQ(word("film.A.red3"), 0x11223344u);
    EXPECT_EQ(word("film.B.squares2"), 7u);
    EXPECT_EQ(word("film.B.samples"), 5u);
    EXPECT_EQ(word("film.digest"), 0xabcdef01u);
    EXPECT_EQ(word("film.boxTests"), 3u);
    EXPECT_EQ(word("film.primitiveTests"), 4u);
}

class MergedFilms : public ::testing::Test {
protected:
    fs::path write(const std::string& name, const FilmFileParts& parts) const
    {
        writeFileAtomically(folder_.path / name, parts.encode());
        return folder_.path / name;
    }

    TemporaryFolder folder_;
};

TEST_F(MergedFilms, anySplitInAnyOrder_isTheFilmOfOneRun)
{
    const uint32_t total = 125;
    const Film whole = filmOfRanges(5, 4, {{0, total}});
    std::mt19937 random(9);
    for (uint32_t count : {1u, 2u, 3u, 7u, 16u}) {
        std::vector<FilmFile> files;
        for (uint32_t i = 0; i < count; i++) {
            files.push_back(openFilmFile(
                write(std::to_string(i), filmFileOf({shardOf(i, count, total)}, total))));
        }
        for (int order = 0; order < 4; order++) {
            std::shuffle(files.begin(), files.end(), random);
            const MergedFilm merged = mergeFilms(files, false);
            EXPECT_TRUE(merged.film == whole) << count;
            EXPECT_TRUE(merged.label.isWhole());
            EXPECT_EQ(merged.metadata.at("sahl.sampleCount"), "125");
            EXPECT_EQ(merged.metadata.at("sahl.passes"), "16");
            EXPECT_FALSE(merged.metadata.contains("sahl.film"));
        }
    }
}

TEST_F(MergedFilms, thatTearABlockOf64Apart_areRefused)
{
    FilmFileParts parts = filmFileOf({{8, 72}}, 72);
    EXPECT_EQ(openFilmFile(write("eights", parts)).replicateSize(), 1u);
    parts.metadata["sahl.varianceOver"] = "blocks of 64";
    const fs::path path = write("torn", parts);
    try {
        openFilmFile(path);
        ADD_FAILURE() << "taken";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("ranges that begin with blocks of 64 samples"), std::string::npos) << error.what();
    }
}

TEST_F(MergedFilms, saturatedNumbers_saturateAsInOneRun)
{
    FilmFileParts a = filmFileOf({{0, 32}}), b = filmFileOf({{32, 64}});
    for (FilmFileParts* part : {&a, &b}) {
        const bool first = part == &a;
        part->film.half[0][3].sum[1] = {~uint64_t{0} - 5, 1};
        part->film.work[3] = {0xfffffff0u, 5};
        part->fromFilm({{first ? SampleRange{0, 32} : SampleRange{32, 64}}, 64});
    }
    const MergedFilm merged =
        mergeFilms({openFilmFile(write("a", a)), openFilmFile(write("b", b))}, false);
    EXPECT_EQ(merged.film.half[0][3].sum[1], (Fixed64x64{~uint64_t{0}, ~uint64_t{0}}));
    EXPECT_EQ(merged.film.work[3], (PixelWork{0xffffffffu, 10}));
}

TEST_F(MergedFilms, layersOfFirstHits_comeFromTheFirstSamples)
{
    FilmFileParts a = filmFileOf({{0, 32}}), b = filmFileOf({{32, 64}});
    a.layers.push_back({"depth.Z", std::vector<float>(20, 1.5f)});
    b.layers.push_back({"depth.Z", std::vector<float>(20, 2.5f)});
    const MergedFilm merged =
        mergeFilms({openFilmFile(write("b", b)), openFilmFile(write("a", a))}, false);
    ASSERT_EQ(merged.firstHits.size(), 1u);
    EXPECT_EQ(merged.firstHits[0].name, "depth.Z");
    EXPECT_EQ(merged.firstHits[0].values, std::vector<float>(20, 1.5f));
}

}  // namespace
}  // namespace sahl::testing
