// sahl merge, and the parts of pictures that it puts together: the file of one run, byte for byte.
#include "cli/sahl_program.h"
#include "image/exr_layers.h"
#include "image/image.h"

#include <csignal>
#include <random>
#include <regex>

namespace sahl::testing {
namespace {

/// Whether a bar has shown that a pass is done.
bool passDone(const std::string& text)
{
    return std::regex_search(text, std::regex(" [1-9][0-9]*/8388608 spp"));
}

class Merge : public SceneFolderTest {
protected:
    /// `sahl merge` and more, in the folder.
    RunResult merge(const Arguments& more) const
    {
        Arguments arguments = {"merge"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return sahl(arguments, here());
    }

    /// Renders one.exr in one run and the shards 0.exr, 1.exr ... with the same options.
    void renderShards(const Arguments& options, int count) const
    {
        Arguments one = options;
        one.insert(one.end(), {"-o", "one.exr"});
        ASSERT_EQ(render(one).exitCode, 0);
        for (int i = 0; i < count; i++) {
            Arguments shard = options;
            const std::string index = std::to_string(i);
            shard.insert(shard.end(),
                         {"--shard", index + "/" + std::to_string(count), "-o", index + ".exr"});
            const RunResult result = render(shard);
            ASSERT_EQ(result.exitCode, 0) << result.err;
        }
    }

    /// Merges the shards in that order; the file that comes out.
    std::string mergedFile(const std::vector<int>& order) const
    {
        Arguments arguments;
        for (int i : order) arguments.push_back(std::to_string(i) + ".exr");
        arguments.insert(arguments.end(), {"-o", "merged.exr"});
        const RunResult result = merge(arguments);
        EXPECT_EQ(result.exitCode, 0) << result.err;
        EXPECT_EQ(result.out, "merged.exr\n");
        return textOf(folder / "merged.exr");
    }

    std::string attribute(const std::string& file, const std::string& name) const
    {
        return describeExr(folder / file).metadata[name];
    }

    static std::vector<int> inOrder(int count)
    {
        std::vector<int> order;
        for (int i = 0; i < count; i++) order.push_back(i);
        return order;
    }
};

TEST_F(Merge, shardsInAnyOrder_areTheFileOfOneRun)
{
    std::mt19937 random(5);
    for (int count : {1, 2, 3, 7, 16}) {
        // 125 samples: 15 blocks of 8, and one of 5.
        renderShards({"--spp", "125", "--aovs", "--seed", "3"}, count);
        const std::string one = textOf(folder / "one.exr");
        std::vector<int> order = inOrder(count);
        EXPECT_TRUE(mergedFile(order) == one) << count;
        std::reverse(order.begin(), order.end());
        EXPECT_TRUE(mergedFile(order) == one) << count << " reversed";
        for (int i = 0; i < 3; i++) {
            std::shuffle(order.begin(), order.end(), random);
            EXPECT_TRUE(mergedFile(order) == one) << count << " shuffled";
        }
    }
}

TEST_F(Merge, shardsOfOtherKindsOfPictures_areTheFileOfOneRun)
{
    const Arguments kinds[] = {{"--spp", "30", "--crop", "5,3,7,6", "--aovs"},
                               {"--spp", "17", "--integrator", "phong", "--shadows", "on",
                                "--terms", "diffuse", "--normals", "flat"},
                               {"--spp", "24", "--max-bounces", "0", "--tile", "5"},
                               {"--spp", "20", "--sampler", "sobol", "--roulette-depth", "1",
                                "--clamp-indirect", "0.05"},
                               {"--spp", "150", "--sampler", "sobol64"},
                               {"--spp", "24", "--keep-film"}};
    for (const Arguments& kind : kinds) {
        renderShards(kind, 3);
        Arguments more = {"2.exr", "0.exr", "1.exr", "-o", "merged.exr"};
        if (kind.back() == "--keep-film") more.push_back("--keep-film");
        ASSERT_EQ(merge(more).exitCode, 0);
        EXPECT_TRUE(textOf(folder / "merged.exr") == textOf(folder / "one.exr")) << kind[2];
    }
}

TEST_F(Merge, pfmAndPng_areThoseOfOneRunToo)
{
    const Arguments pictures = {"-o",         "a.pfm",  "-o",         "a.png",
                                "--tone-map", "filmic", "--exposure", "1"};
    Arguments one = pictures;
    one.insert(one.begin(), {"--spp", "40"});
    ASSERT_EQ(render(one).exitCode, 0);
    const std::string pfm = textOf(folder / "a.pfm"), png = textOf(folder / "a.png");
    renderShards({"--spp", "40"}, 2);
    Arguments parts = pictures;
    parts.insert(parts.begin(), {"0.exr", "1.exr"});
    const RunResult result = merge(parts);
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(result.out, "a.pfm\na.png\n");
    EXPECT_TRUE(textOf(folder / "a.pfm") == pfm);
    EXPECT_TRUE(textOf(folder / "a.png") == png);
}

TEST_F(Merge, savedScenesAndOtherNames_areTheSameScene)
{
    ASSERT_EQ(sahl({"bvh", "ball.json", "-o", "ball.sahl"}, here()).exitCode, 0);
    fs::copy(folder / "ball.json", folder / "other.json");
    ASSERT_EQ(render({"--spp", "16", "--shard", "0/2", "-o", "0.exr"}).exitCode, 0);
    for (const char* scene : {"ball.sahl", "other.json"}) {
        ASSERT_EQ(sahl({"render", scene, "--device", "cpu", "--spp", "16", "--shard", "1/2", "-o",
                        "1.exr"},
                       here())
                      .exitCode,
                  0);
        EXPECT_EQ(merge({"1.exr", "0.exr", "-o", "m.exr"}).exitCode, 0) << scene;
        EXPECT_EQ(attribute("m.exr", "sahl.scene"), "ball.json") << "that of the first samples";
    }
}

TEST_F(Merge, inSteps_isTheFileOfOneRun)
{
    renderShards({"--spp", "52"}, 5);
    ASSERT_EQ(merge({"4.exr", "1.exr", "-o", "a.exr", "--allow-gaps"}).exitCode, 0);
    EXPECT_EQ(attribute("a.exr", "sahl.sampleRanges"), "8:16,40:52");
    ASSERT_EQ(merge({"0.exr", "a.exr", "-o", "b.exr", "--allow-gaps"}).exitCode, 0);
    EXPECT_EQ(attribute("b.exr", "sahl.sampleRanges"), "0:16,40:52");
    ASSERT_EQ(merge({"3.exr", "b.exr", "2.exr", "-o", "c.exr"}).exitCode, 0);
    EXPECT_TRUE(textOf(folder / "c.exr") == textOf(folder / "one.exr"));
}

TEST_F(Merge, moreSamplesLater_areTheFileOfOneRun)
{
    ASSERT_EQ(render({"--spp", "16", "--keep-film", "-o", "a.exr"}).exitCode, 0);
    ASSERT_EQ(render({"--spp", "40", "--sample-range", "16:40", "-o", "b.exr"}).exitCode, 0);
    ASSERT_EQ(render({"--spp", "40", "-o", "one.exr"}).exitCode, 0);
    const RunResult result = merge({"a.exr", "b.exr", "-o", "c.exr"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_HAS(result.err, "2 files, samples 0:40 of 40 per pixel, ");
    EXPECT_TRUE(textOf(folder / "c.exr") == textOf(folder / "one.exr"));
}

TEST_F(Merge, gaps_areNamedAndTheMeanIsOverWhatIsThere)
{
    renderShards({"--spp", "64"}, 4);
    const RunResult refused = merge({"3.exr", "0.exr", "-o", "a.exr"});
    expectRefused(
        refused, 3,
        "samples 16:48 of 64 are missing; render them with --sample-range 16:48, or do without "
        "them by --allow-gaps");
    EXPECT_FALSE(fs::exists(folder / "a.exr"));

    const RunResult allowed =
        merge({"1.exr", "0.exr", "-o", "a.exr", "-o", "a.pfm", "--allow-gaps"});
    EXPECT_EQ(allowed.exitCode, 0);
    EXPECT_HAS(allowed.err,
               "warning: samples 32:64 of 64 are missing; the picture is the mean of the others");
    ASSERT_EQ(render({"--spp", "32", "-o", "half.pfm"}).exitCode, 0);
    EXPECT_TRUE(textOf(folder / "a.pfm") == textOf(folder / "half.pfm"));
    EXPECT_EQ(attribute("a.exr", "sahl.sampleCount"), "32");
    EXPECT_EQ(attribute("a.exr", "sahl.passes"), "4");
}

TEST_F(Merge, interruptedParts_areCompletedByWhatIsMissing)
{
    RunningProgram program(SAHL_PROGRAM,
                           {"render", "ball.json", "--device", "cpu", "--spp", "16777216",
                            "--shard", "0/2", "--progress", "bar", "-o", "a.exr"},
                           here());
    ASSERT_TRUE(program.waitForError(passDone));
    program.signal(SIGINT);
    EXPECT_EQ(program.finish().exitCode, 130);
    EXPECT_EQ(attribute("a.exr", "sahl.interrupted"), "yes");
    const std::string range = attribute("a.exr", "sahl.sampleRanges");
    ASSERT_TRUE(range.starts_with("0:")) << range;
    const int done = std::stoi(range.substr(2));
    ASSERT_GE(done, 8);
    ASSERT_EQ(done % 8, 0);

    const std::string total = std::to_string(done + 20),
                      missing = std::to_string(done) + ":" + total;
    ASSERT_EQ(render({"--spp", total, "--sample-range", missing, "-o", "b.exr"}).exitCode, 0);
    const RunResult result = merge({"a.exr", "b.exr", "-o", "c.exr"});
    expectRefused(result, 3, " of 16777216 are missing");
    const RunResult allowed = merge({"a.exr", "b.exr", "-o", "c.exr", "--allow-gaps"});
    ASSERT_EQ(allowed.exitCode, 0) << allowed.err;
    EXPECT_EQ(attribute("c.exr", "sahl.sampleRanges"), "0:" + total);
    EXPECT_EQ(attribute("c.exr", "sahl.interrupted"), "yes");
    if (done > 4096) return;  // a fast machine: one run would take long
    ASSERT_EQ(render({"--spp", total, "-o", "one.pfm"}).exitCode, 0);
    ASSERT_EQ(merge({"c.exr", "-o", "c.pfm", "--allow-gaps"}).exitCode, 0);
    EXPECT_TRUE(textOf(folder / "c.pfm") == textOf(folder / "one.pfm"));
}

TEST_F(Merge, unequalParts_areRefusedByFileAttributeAndBothValues)
{
    ASSERT_EQ(render({"--spp", "16", "--shard", "0/2", "-o", "a.exr"}).exitCode, 0);
    writeText(folder / "blue.json", [] {
        auto scene = nlohmann::json::parse(ballScene());
        scene["materials"]["clay"]["baseColor"] = {0.2, 0.4, 0.7};
        return scene.dump();
    }());
    const std::pair<Arguments, const char*> others[] = {
        {{"--seed", "7"},
         "b.exr: sahl.seed is \"7\", that of a.exr is \"0\"; only parts of one picture"},
        {{"--max-bounces", "3"}, "sahl.maxBounces is \"3\", that of a.exr is \"4\""},
        {{"--integrator", "phong"}, "sahl.integrator is \"phong\", that of a.exr is \"path\""},
        {{"--normals", "flat"}, "sahl.normals is \"flat\", that of a.exr is \"interpolated\""},
        {{"--width", "18"},
         "b.exr: has 18 x 12 pixels at 0,0 of 18 x 12, a.exr has 16 x 12 pixels at 0,0 of 16"},
        {{"--crop", "0,0,4,4"}, "b.exr: has 4 x 4 pixels at 0,0 of 16 x 12, a.exr has 16 x 12"},
        {{"--aovs"},
         "b.exr: has the channel albedo.B, a.exr has not; render all parts with --aovs, or none"},
    };
    for (const auto& [options, words] : others) {
        Arguments arguments = {"--spp", "16", "--shard", "1/2", "-o", "b.exr"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        ASSERT_EQ(render(arguments).exitCode, 0);
        expectRefused(merge({"a.exr", "b.exr", "-o", "c.exr"}), 3, words);
    }
    ASSERT_EQ(sahl({"render", "blue.json", "--device", "cpu", "--spp", "16", "--shard", "1/2", "-o",
                    "b.exr"},
                   here())
                  .exitCode,
              0);
    expectRefused(merge({"a.exr", "b.exr", "-o", "c.exr"}), 3,
                  " (another scene); only parts of one picture");
    expectRefused(merge({"a.exr", "a.exr", "-o", "c.exr"}), 3,
                  "a.exr and a.exr both have the samples 0:8; each sample may be there once");
    EXPECT_FALSE(fs::exists(folder / "c.exr"));
}

TEST_F(Merge, picturesWithoutAFilm_areRefused)
{
    ASSERT_EQ(render({"-o", "plain.exr", "-o", "plain.pfm"}).exitCode, 0);
    expectRefused(merge({"plain.exr", "-o", "c.exr"}), 3,
                  "plain.exr: has no exact film in it; render it with --shard, --sample-range or "
                  "--keep-film");
    expectRefused(merge({"plain.pfm", "-o", "c.exr"}), 3, "plain.pfm: is not an EXR file");
    expectRefused(merge({"missing.exr", "-o", "c.exr"}), 3, "missing.exr: ");
    expectRefused(merge({".", "-o", "c.exr"}), 3, ".: ");
    expectRefused(merge({"/dev/zero", "-o", "c.exr"}), 3, "/dev/zero: ");
}

TEST_F(Merge, adaptivePictures_areRefusedWithTheReason)
{
    expectRefused(
        render({"--adaptive", "report", "--shard", "0/2"}), 2,
        "adaptive sampling by the rule report decides how many samples a pixel gets from all of "
        "its samples together, so parts cannot be merged; render them with --adaptive none");
    expectRefused(render({"--adaptive", "report", "--sample-range", "0:8"}), 2,
                  "adaptive sampling");
    expectRefused(render({"--adaptive", "report", "--keep-film"}), 2, "adaptive sampling");
    ASSERT_EQ(render({"--adaptive", "report", "-o", "a.exr"}).exitCode, 0);
    expectRefused(merge({"a.exr", "-o", "c.exr"}), 3,
                  "a.exr: attribute sahl.adaptive is \"report\": adaptive sampling decides");
}

TEST_F(Merge, outputs_areCheckedBeforeAnythingIsRead)
{
    ASSERT_EQ(render({"--keep-film", "-o", "a.exr"}).exitCode, 0);
    const std::string before = textOf(folder / "a.exr");
    expectRefused(merge({"a.exr", "-o", "a.exr"}), 2,
                  "a.exr: is an input; writing it would destroy it");
    EXPECT_TRUE(textOf(folder / "a.exr") == before);
    expectRefused(merge({"missing.exr", "-o", "none/b.exr"}), 4, "none/b.exr: cannot write");
    expectRefused(merge({"missing.exr", "-o", "b.tif"}), 2, "the name must end in .exr, .pfm");
    expectRefused(merge({"a.exr"}), 2,
                  "'sahl merge' needs parts of a picture: .exr files by sahl render");
    expectRefused(merge({"-o", "b.exr"}), 2, "'sahl merge' needs parts of a picture");
    expectRefused(merge({"a.exr", "-o", "b.exr", "--alow-gaps"}), 2, "did you mean --allow-gaps?");
    fs::create_symlink("/dev/full", folder / "full.exr");
    EXPECT_EQ(merge({"a.exr", "-o", "full.exr", "-o", "b.pfm"}).exitCode, 4);
    EXPECT_TRUE(fs::exists(folder / "b.pfm"));
}

}  // namespace
}  // namespace sahl::testing
