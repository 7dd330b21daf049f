// Sets of files that are no parts of one picture, and files that are hostile: each is refused,
// naming what is wrong, and nothing crashes.
#include "film/merge.h"
#include "support/film_files.h"

#include <gtest/gtest.h>

namespace sahl::testing {
namespace {

using Alter = std::function<void(FilmFileParts&)>;

bool contains(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

class MergeFaults : public ::testing::Test {
protected:
    MergeFaults() { setQuiet(true); }
    ~MergeFaults() override { setQuiet(false); }

    void write(const std::string& name, const std::vector<uint8_t>& bytes) const
    {
        writeFileAtomically(folder_.path / name, bytes);
    }

    /// Merges files of the folder.
    MergedFilm merge(const std::vector<std::string>& names, bool allowGaps = false) const
    {
        std::vector<FilmFile> files;
        for (const std::string& name : names) files.push_back(openFilmFile(folder_.path / name));
        return mergeFilms(std::move(files), allowGaps);
    }

    /// The text of the badInput error that merging them gives, without the folder; "" without one.
    std::string errorOf(const std::vector<std::string>& names, bool allowGaps = false) const
    {
        try {
            merge(names, allowGaps);
        } catch (const Error& error) {
            EXPECT_EQ(error.kind, ErrorKind::badInput) << error.what();
            std::string text = error.what();
            const std::string place = folder_.path.string() + "/";
            for (size_t at; (at = text.find(place)) != std::string::npos;)
                text.erase(at, place.size());
            return text;
        }
        return "";
    }

    /// What is said of a.exr, samples 0 to 31, and an altered b.exr, samples 32 to 63.
    std::string errorWith(const Alter& alter) const
    {
        write("a.exr", filmFileOf({{0, 32}}).encode());
        FilmFileParts other = filmFileOf({{32, 64}});
        alter(other);
        write("b.exr", other.encode());
        return errorOf({"a.exr", "b.exr"});
    }

    std::string errorWithAttribute(const std::string& name, const std::string& text) const
    {
        return errorWith([&](FilmFileParts& file) { file.metadata[name] = text; });
    }

    TemporaryFolder folder_;
};

#define EXPECT_CONTAINS(text, part) EXPECT_PRED2(contains, (text), (part))

TEST_F(MergeFaults, unalteredParts_areMergedToTheWhole)
{
    EXPECT_EQ(errorWith([](FilmFileParts&) {}), "");
    const MergedFilm merged = merge({"b.exr", "a.exr"});
    EXPECT_TRUE(merged.film == filmOfRanges(5, 4, {{0, 64}}));
    EXPECT_TRUE(merged.label.isWhole());
}

TEST_F(MergeFaults, partsOfOtherPictures_areRefusedWithBothValues)
{
    const std::tuple<const char*, const char*, const char*> cases[] = {
        {"sahl.version", "0.2.0", "b.exr: sahl.version is \"0.2.0\", that of a.exr is \"0.1.0\""},
        {"sahl.seed", "7", "b.exr: sahl.seed is \"7\", that of a.exr is \"0\""},
        {"sahl.maxBounces", "3", "b.exr: sahl.maxBounces is \"3\", that of a.exr is \"8\""},
        {"sahl.integrator", "phong",
         "b.exr: sahl.integrator is \"phong\", that of a.exr is \"path\""},
        {"sahl.sampler", "sobol",
         "b.exr: sahl.sampler is \"sobol\", that of a.exr is \"independent\""},
        {"sahl.sceneHash", "0123456789abcdee", "\"0123456789abcdef\" (another scene)"},
        {"sahl.treeHash", "0",
         "b.exr: sahl.treeHash is \"0\", that of a.exr is \"fedcba9876543210\" (another tree"},
        {"sahl.normals", "flat", "b.exr: sahl.normals is \"flat\", that of a.exr is missing"},
        {"sahl.crop", "0,0,5,4", "b.exr: sahl.crop is \"0,0,5,4\", that of a.exr is missing"},
        {"sahl.terms", "diffuse", "b.exr: sahl.terms is \"diffuse\", that of a.exr is missing"},
        {"sahl.shadows", "on", "b.exr: sahl.shadows is \"on\", that of a.exr is missing"},
        {"sahl.somethingNew", "x", "b.exr: sahl.somethingNew is \"x\", that of a.exr is missing"},
    };
    for (const auto& [name, text, words] : cases)
        EXPECT_CONTAINS(errorWithAttribute(name, text), words);
    EXPECT_CONTAINS(errorWith([](FilmFileParts& file) { file.metadata.erase("sahl.seed"); }),
                    "b.exr: sahl.seed is missing, that of a.exr is \"0\"");
    EXPECT_CONTAINS(errorWith([](FilmFileParts& file) {
                        file.metadata["sahl.seed"] = "1";
                        file.metadata["sahl.maxBounces"] = "1";
                    }),
                    "sahl.maxBounces is \"1\", that of a.exr is \"8\"; sahl.seed is \"1\"");
}

TEST_F(MergeFaults, attributesOfOtherPrograms_doNotMatter)
{
    EXPECT_EQ(errorWithAttribute("comments", "looked at"), "");
    EXPECT_EQ(errorWithAttribute("sahl.device", "another"), "");
    EXPECT_EQ(merge({"a.exr", "b.exr"}).metadata.at("sahl.device"), "CPU; another");
    EXPECT_EQ(merge({"b.exr", "a.exr"}).metadata.at("sahl.device"), "CPU; another");
}

TEST_F(MergeFaults, otherSizesAndWindows_areRefused)
{
    auto resized = [](FilmFileParts& file) {
        file.film = filmOfRanges(4, 5, {{32, 64}});
        file.layers = {};
        file.fromFilm({{{32, 64}}, 64});
    };
    EXPECT_CONTAINS(
        errorWith(resized),
        "b.exr: has 4 x 5 pixels at 0,0 of 4 x 5, a.exr has 5 x 4 pixels at 0,0 of 5 x 4");
    EXPECT_CONTAINS(
        errorWith([](FilmFileParts& file) {
            file.place = ImagePlace{3, 2, 64, 48};
        }),
        "b.exr: has 5 x 4 pixels at 3,2 of 64 x 48, a.exr has 5 x 4 pixels at 0,0 of 5 x 4");
}

TEST_F(MergeFaults, otherLayers_areRefused)
{
    const ImageChannel depth = {"depth.Z", std::vector<float>(20)};
    EXPECT_CONTAINS(
        errorWith([&](FilmFileParts& file) { file.layers.push_back(depth); }),
        "b.exr: has the channel depth.Z, a.exr has not; render all parts with --aovs, or none");
    EXPECT_CONTAINS(errorOf({"b.exr", "a.exr"}), "b.exr: has the channel depth.Z, a.exr has not");
    EXPECT_CONTAINS(
        errorWith([&](FilmFileParts& file) {
            file.layers.push_back({"mask.Y", depth.values});
        }),
        "b.exr: channel \"mask.Y\" cannot be merged; it is none that sahl render writes");
}

TEST_F(MergeFaults, samplesThatTwoFilesHave_areRefused)
{
    write("a.exr", filmFileOf({{0, 32}}).encode());
    write("b.exr", filmFileOf({{24, 64}}).encode());
    write("c.exr", filmFileOf({{8, 16}, {40, 64}}).encode());
    write("d.exr", filmFileOf({{0, 20}}, 20).encode());
    write("e.exr", filmFileOf({{16, 64}}).encode());
    EXPECT_EQ(errorOf({"a.exr", "b.exr"}),
              "a.exr and b.exr both have the samples 24:32; each sample may be there once");
    EXPECT_CONTAINS(errorOf({"b.exr", "a.exr"}), "a.exr and b.exr both have the samples 24:32");
    EXPECT_CONTAINS(errorOf({"c.exr", "a.exr"}), "a.exr and c.exr both have the samples 8:16");
    EXPECT_CONTAINS(errorOf({"a.exr", "a.exr"}), "a.exr and a.exr both have the samples 0:32");
    EXPECT_CONTAINS(errorOf({"d.exr", "e.exr"}), "d.exr and e.exr both have the samples 16:20");
    EXPECT_CONTAINS(errorOf({"a.exr", "b.exr"}, true), "both have the samples") << "gaps or not";
}

TEST_F(MergeFaults, missingSamples_areRefusedUnlessAllowed)
{
    write("a.exr", filmFileOf({{0, 8}, {24, 32}}).encode());
    write("b.exr", filmFileOf({{16, 24}}).encode());
    EXPECT_EQ(errorOf({"b.exr", "a.exr"}), "samples 8:16,32:64 of 64 are missing; render them with "
                                           "--sample-range 8:16, or do without them by "
                                           "--allow-gaps");
    EXPECT_TRUE(merge({"b.exr", "a.exr"}, true).film == filmOfRanges(5, 4, {{0, 8}, {16, 32}}));
    // The whole is what the file with the most samples says.
    write("c.exr", filmFileOf({{32, 64}}).encode());
    write("d.exr", filmFileOf({{0, 32}}, 128).encode());
    EXPECT_CONTAINS(errorOf({"c.exr", "d.exr"}), "samples 64:128 of 128 are missing");
}

TEST_F(MergeFaults, adaptivePictures_areRefusedWithTheReason)
{
    for (const char* rule : {"report", "joint", "crossed"}) {
        const std::string error = errorWithAttribute("sahl.adaptive", rule);
        EXPECT_CONTAINS(error, std::string("b.exr: attribute sahl.adaptive is \"") + rule +
                                   "\": adaptive sampling decides");
        EXPECT_CONTAINS(error, "render the parts with --adaptive none");
    }
}

TEST_F(MergeFaults, filesWithoutAFilm_areRefused)
{
    EXPECT_CONTAINS(errorWith([](FilmFileParts& file) { file.metadata.erase("sahl.version"); }),
                    "b.exr: is no picture by sahl render");
    EXPECT_CONTAINS(errorWith([](FilmFileParts& file) { file.metadata.erase("sahl.film"); }),
                    "b.exr: has no exact film in it; render it with --shard");
    EXPECT_CONTAINS(errorWithAttribute("sahl.film", "2"),
                    "attribute sahl.film is \"2\"; it should be \"1\"");
    write("b.exr", {'P', 'F', '\n', '1', ' ', '1', '\n'});
    EXPECT_EQ(errorOf({"a.exr", "b.exr"}), "b.exr: is not an EXR file");
    write("b.exr", {});
    EXPECT_EQ(errorOf({"a.exr", "b.exr"}), "b.exr: the file is empty");
    EXPECT_CONTAINS(errorOf({"a.exr", "none.exr"}), "none.exr: ");
}

TEST_F(MergeFaults, rangesThatMakeNoSense_areRefused)
{
    for (const char* text : {"",
                             "32",
                             "32:",
                             ":64",
                             "32:64,",
                             ",32:64",
                             "32:64 ",
                             " 32:64",
                             "64:32",
                             "32:32",
                             "33:64",
                             "-8:64",
                             "32:99999999",
                             "32:4294967360",
                             "32:18446744073709551680",
                             "32:48,40:64",
                             "32:48,48:64",
                             "40:64,32:40",
                             "0x20:64",
                             "32:64,64:64",
                             "all"}) {
        EXPECT_CONTAINS(errorWithAttribute("sahl.sampleRanges", text),
                        "b.exr: attribute sahl.sampleRanges is \"")
            << text;
    }
    EXPECT_CONTAINS(
        errorWith([](FilmFileParts& file) { file.metadata.erase("sahl.sampleRanges"); }),
        "b.exr: attribute sahl.sampleRanges is missing; it should be ascending ranges");
    for (const char* text :
         {"", "63", "0", "-1", "16777217", "4294967296", "99999999999999999999", "64 ", "x"}) {
        EXPECT_CONTAINS(errorWithAttribute("sahl.totalSamples", text),
                        std::string("b.exr: attribute sahl.totalSamples is \"") + text +
                            "\"; it should be a number from 64 to 16777216");
    }
}

TEST_F(MergeFaults, countsThatDoNotFitTheRange_areRefused)
{
    EXPECT_CONTAINS(
        errorWithAttribute("sahl.sampleRanges", "32:56"),
        "b.exr: attribute sahl.filmCounters has 640 camera rays, but 5 x 4 pixels with the samples "
        "32:56 have 480");
    auto miscount = [](size_t channel, size_t pixel, uint32_t count) {
        return [=](FilmFileParts& file) {
            file.words[channel][pixel] = count;
            file.rehash();
        };
    };
    EXPECT_CONTAINS(errorWith(miscount(16, 7, 17)),
                    "b.exr: pixel 2, 1 has not the 16 and 16 samples in halves A and B that "
                    "the range 32:64 means");
    EXPECT_CONTAINS(errorWith(miscount(33, 19, 0)),
                    "b.exr: pixel 4, 3 has not the 16 and 16 samples");
    EXPECT_CONTAINS(errorWith(miscount(16, 0, 0xffffffff)), "b.exr: pixel 0, 0 has not");
    // The same number of samples, but of other blocks: 8 of A and 24 of B, say.
    EXPECT_CONTAINS(errorWith([](FilmFileParts& file) {
                        file.film = filmOfRanges(5, 4, {{40, 48}, {56, 64}, {72, 80}, {32, 40}});
                        file.fromFilm({{{32, 64}}, 64});
                    }),
                    "b.exr: pixel 0, 0 has not the 16 and 16 samples");
}

TEST_F(MergeFaults, countersThatMakeNoSense_areRefused)
{
    const std::string rest =
        " indirectRays=0 shadowRays=0 boxTests=0 primitiveTests=0 bounces=0 badSamples=0 clamped=0";
    for (const std::string& text :
         {std::string(), std::string("cameraRays=640"), "cameraRays=640" + rest + " ",
          "cameraRays=640" + rest + " more=1", "cameraRays=-640" + rest,
          "cameraRays=18446744073709551616" + rest, "cameraRays= 640" + rest,
          "cameraRay=640" + rest, "cameraRays=640 " + rest}) {
        EXPECT_CONTAINS(errorWithAttribute("sahl.filmCounters", text),
                        "b.exr: attribute sahl.filmCounters is \"")
            << text;
    }
    EXPECT_CONTAINS(
        errorWithAttribute("sahl.filmCounters", "cameraRays=18446744073709551615" + rest),
        "has 18446744073709551615 camera rays, but");
    EXPECT_EQ(errorWithAttribute("sahl.filmCounters", "cameraRays=640" + rest), "");
}

TEST_F(MergeFaults, alteredFilms_areRefusedByTheirHash)
{
    for (size_t channel = 0; channel < filmChannelNames().size(); channel++) {
        EXPECT_CONTAINS(errorWith([&](FilmFileParts& file) { file.words[channel][11] ^= 0x10000; }),
                        "b.exr: the hash of its film is ");
    }
    for (const char* text : {"", "0", "0123456789ABCDEF", "0123456789abcdef0", "x123456789abcdef",
                             "-123456789abcdef"}) {
        EXPECT_CONTAINS(errorWithAttribute("sahl.filmHash", text),
                        std::string("b.exr: attribute sahl.filmHash is \"") + text +
                            "\"; it should be 16 hexadecimal digits");
    }
}

TEST_F(MergeFaults, missingOrConvertedChannels_areRefused)
{
    for (size_t channel = 0; channel < filmChannelNames().size(); channel++) {
        const std::string name = filmChannelNames()[channel];
        EXPECT_EQ(errorWith([&](FilmFileParts& file) {
                      file.words.erase(file.words.begin() + static_cast<std::ptrdiff_t>(channel));
                      file.names.erase(file.names.begin() + static_cast<std::ptrdiff_t>(channel));
                  }),
                  "b.exr: channel " + name +
                      " is missing: the film is not complete; render it again");
        EXPECT_EQ(errorWith([&](FilmFileParts& file) {
                      file.words.erase(file.words.begin() + static_cast<std::ptrdiff_t>(channel));
                      file.names.erase(file.names.begin() + static_cast<std::ptrdiff_t>(channel));
                      file.layers.push_back({name, std::vector<float>(20)});
                  }),
                  "b.exr: channel " + name +
                      " is of type float, not uint: the file was converted; render it again");
    }
}

TEST_F(MergeFaults, truncatedFiles_areRefusedWhereverTheyEnd)
{
    write("a.exr", filmFileOf({{0, 32}}).encode());
    const std::vector<uint8_t> whole = filmFileOf({{32, 64}}).encode();
    for (size_t length = 0; length < whole.size(); length += 1 + length / 200) {
        write("b.exr", {whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)});
        EXPECT_TRUE(errorOf({"a.exr", "b.exr"}).starts_with("b.exr: ")) << length;
    }
    write("b.exr", {whole.begin(), whole.end() - 1});
    EXPECT_TRUE(errorOf({"a.exr", "b.exr"}).starts_with("b.exr: "));
}

TEST_F(MergeFaults, flippedBytes_areRefusedOrChangeNothingOfTheFilm)
{
    write("a.exr", filmFileOf({{0, 32}}).encode());
    const std::vector<uint8_t> whole = filmFileOf({{32, 64}}).encode();
    const Film expected = filmOfRanges(5, 4, {{0, 64}});
    std::mt19937 random(2026);
    int refused = 0;
    for (int i = 0; i < 400; i++) {
        std::vector<uint8_t> bytes = whole;
        bytes[random() % bytes.size()] ^= static_cast<uint8_t>(1 + random() % 255);
        write("b.exr", bytes);
        try {
            const MergedFilm merged = merge({"a.exr", "b.exr"}, true);
            EXPECT_TRUE(merged.film.half[0] == expected.half[0] &&
                        merged.film.half[1] == expected.half[1]);
            EXPECT_TRUE(merged.film.digest == expected.digest && merged.film.work == expected.work);
        } catch (const Error& error) {
            EXPECT_EQ(error.kind, ErrorKind::badInput) << error.what();
            refused++;
        }
    }
    EXPECT_GT(refused, 300);
}

TEST_F(MergeFaults, filesThatChangeMeanwhile_areRefused)
{
    write("a.exr", filmFileOf({{0, 32}}).encode());
    write("b.exr", filmFileOf({{32, 64}}).encode());
    std::vector<FilmFile> files = {openFilmFile(folder_.path / "a.exr"),
                                   openFilmFile(folder_.path / "b.exr")};
    write("b.exr", filmFileOf({{32, 56}}).encode());
    try {
        mergeFilms(std::move(files), false);
        ADD_FAILURE() << "merged";
    } catch (const Error& error) {
        EXPECT_CONTAINS(error.what(), "b.exr: is another file than a moment ago; try again");
    }
}

}  // namespace
}  // namespace sahl::testing
