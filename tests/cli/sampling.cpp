// --sampler, --roulette-depth and --clamp-indirect as users meet them.
#include "cli/sahl_program.h"
#include "image/exr_layers.h"
#include "image/image.h"
#include "support/pictures.h"

namespace sahl::testing {
namespace {

class Sampling : public SceneFolderTest {
protected:
    /// With a floor, so that light is scattered more than once.
    Sampling() { writeText(folder / "ball.json", sceneOnAFloor().dump()); }

    static nlohmann::json sceneOnAFloor()
    {
        nlohmann::json scene = nlohmann::json::parse(ballScene());
        scene["shapes"].push_back({{"type", "rectangle"},
                                   {"corner", {-4, -1, 4}},
                                   {"edgeU", {8, 0, 0}},
                                   {"edgeV", {0, 0, -8}},
                                   {"material", "clay"}});
        return scene;
    }

    ImageMetadata metadataAfter(const Arguments& more)
    {
        Arguments arguments = {"--spp", "16", "-o", "ball.exr", "--stats", "ball-stats.json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const RunResult result = render(arguments);
        EXPECT_EQ(result.exitCode, 0) << result.err;
        words_ = result.err;
        return describeExr(folder / "ball.exr").metadata;
    }

    nlohmann::json counters() const
    {
        return nlohmann::json::parse(textOf(folder / "ball-stats.json"))["counters"];
    }

    std::string words_;  // of the last render
};

TEST_F(Sampling, isToldByFileSummaryAndStatistics)
{
    ImageMetadata plain = metadataAfter({});
    EXPECT_EQ(plain["sahl.sampler"], "independent");
    EXPECT_EQ(plain["sahl.varianceOver"], "samples");
    EXPECT_EQ(plain["sahl.rouletteDepth"], "off");
    EXPECT_EQ(plain["sahl.clampIndirect"], "off");
    EXPECT_FALSE(plain.contains("sahl.biased"));
    const uint64_t rays = counters()["indirectRays"];
    EXPECT_EQ(counters()["clamped"], 0);
    EXPECT_FALSE(has(words_, "clamped"));

    ImageMetadata all =
        metadataAfter({"--sampler", "sobol", "--roulette-depth", "0", "--clamp-indirect", "0.05"});
    EXPECT_EQ(all["sahl.sampler"], "sobol");
    EXPECT_EQ(all["sahl.varianceOver"], "blocks");
    EXPECT_EQ(all["sahl.rouletteDepth"], "0");
    EXPECT_EQ(all["sahl.clampIndirect"], "0.05");
    EXPECT_EQ(all["sahl.biased"], "yes");
    EXPECT_LT(counters()["indirectRays"], rays);
    EXPECT_GT(counters()["clamped"], 0);
    EXPECT_HAS(words_, "indirect light clamped to 0.05 (biased): ");
}

TEST_F(Sampling, isReadFromTheSceneAndCanBeSwitchedOff)
{
    nlohmann::json scene = sceneOnAFloor();
    scene["integrator"].update(
        {{"sampler", "sobol"}, {"rouletteDepth", 2}, {"clampIndirect", 0.5}});
    writeText(folder / "ball.json", scene.dump());
    ImageMetadata read = metadataAfter({});
    EXPECT_EQ(read["sahl.sampler"], "sobol");
    EXPECT_EQ(read["sahl.rouletteDepth"], "2");
    EXPECT_EQ(read["sahl.clampIndirect"], "0.5");
    ImageMetadata off = metadataAfter(
        {"--sampler", "independent", "--roulette-depth", "off", "--clamp-indirect", "off"});
    EXPECT_EQ(off["sahl.sampler"], "independent");
    EXPECT_EQ(off["sahl.rouletteDepth"], "off");
    EXPECT_EQ(off["sahl.clampIndirect"], "off");

    // Saved with its tree, the scene keeps them.
    ASSERT_EQ(sahl({"bvh", "ball.json", "-o", "ball.sahl"}, here()).exitCode, 0);
    ASSERT_EQ(
        sahl({"render", "ball.sahl", "--device", "cpu", "--spp", "16", "-o", "saved.exr"}, here())
            .exitCode,
        0);
    ImageMetadata saved = describeExr(folder / "saved.exr").metadata;
    for (const char* name :
         {"sahl.sampler", "sahl.rouletteDepth", "sahl.clampIndirect", "sahl.biased"})
        EXPECT_EQ(saved[name], read[name]) << name;
}

TEST_F(Sampling, lightsAreLookedForAsSceneAndOptionSay)
{
    EXPECT_EQ(metadataAfter({})["sahl.lightSampling"], "mis");
    EXPECT_EQ(metadataAfter({"--light-sampling", "bsdf"})["sahl.lightSampling"], "bsdf");
    nlohmann::json scene = nlohmann::json::parse(ballScene());
    scene["integrator"].update({{"lightSampling", "lights"}});
    writeText(folder / "ball.json", scene.dump());
    EXPECT_EQ(metadataAfter({})["sahl.lightSampling"], "lights");
    ASSERT_EQ(sahl({"bvh", "ball.json", "-o", "ball.sahl"}, here()).exitCode, 0);
    ASSERT_EQ(sahl({"render", "ball.sahl", "--device", "cpu", "-o", "saved.exr"}, here()).exitCode, 0);
    EXPECT_EQ(describeExr(folder / "saved.exr").metadata["sahl.lightSampling"], "lights");
}

TEST_F(Sampling, mistakesAreRefusedWithTheReason)
{
    expectRefused(render({"--sampler", "sobel"}), 2,
                  "--sampler 'sobel' is not known; did you mean sobol?");
    expectRefused(render({"--light-sampling", "light"}), 2,
                  "--light-sampling 'light' is not known; did you mean lights?");
    expectRefused(render({"--roulette-depth", "never"}), 2,
                  "--roulette-depth 'never' is not a whole number");
    expectRefused(render({"--clamp-indirect", "0"}), 2, "--clamp-indirect 0 is out of range");
    expectRefused(render({"--sampler", "sobol", "--adaptive", "report"}), 2,
                  "looks at single samples");
    expectRefused(render({"--sampler", "sobol", "--adaptive", "crossed", "--min-spp", "16"}), 2,
                  "--min-spp is 16, and by the sampler sobol crossed needs 2 blocks of 8 samples "
                  "in each half");
    expectRefused(render({"--sampler", "sobol", "--adaptive", "joint", "--min-spp", "8"}), 2,
                  "give 16 at least");
    EXPECT_EQ(
        render({"--sampler", "sobol", "--adaptive", "joint", "--min-spp", "16", "--max-spp", "32"})
            .exitCode,
        0);
}

TEST_F(Sampling, bySobol64IsKeptByASavedScene)
{
    nlohmann::json scene = sceneOnAFloor();
    scene["integrator"].update({{"sampler", "sobol64"}, {"rouletteDepth", 1}});
    writeText(folder / "ball.json", scene.dump());
    EXPECT_EQ(metadataAfter({})["sahl.sampler"], "sobol64");
    ASSERT_EQ(sahl({"bvh", "ball.json", "-o", "ball.sahl"}, here()).exitCode, 0);
    ASSERT_EQ(
        sahl({"render", "ball.sahl", "--device", "cpu", "--spp", "16", "-o", "saved.exr"}, here()).exitCode, 0);
    EXPECT_EQ(describeExr(folder / "saved.exr").metadata["sahl.sampler"], "sobol64");
    expectSameBits(readImage(folder / "saved.exr"), readImage(folder / "ball.exr"));
}

TEST_F(Sampling, bySobol64TiesBlocksOf64AndSaysSo)
{
    EXPECT_EQ(metadataAfter({"--sampler", "sobol64"})["sahl.varianceOver"], "blocks of 64");
    EXPECT_EQ(metadataAfter({"--sampler", "sobol64"})["sahl.sampler"], "sobol64");
    expectRefused(render({"--sampler", "sobol64", "--adaptive", "crossed"}), 2,
                  "the rule crossed takes 8 samples at a time, and the sampler sobol64 ties 64 of them together");
    const Arguments film = {"--sampler", "sobol64", "--spp", "128", "--keep-film"};
    auto with = [&film](Arguments more) {
        more.insert(more.begin(), film.begin(), film.end());
        return more;
    };
    expectRefused(render(with({"--sample-range", "8:64"})), 2, "8 is inside a block of 64 samples, which cannot be torn apart");
    expectRefused(render(with({"--shard", "0/3"})), 2, "128 samples are 2 blocks of 64, so there are at most 2 shards");
    // Of one block nothing tells how noisy it is.
    ASSERT_EQ(render({"--spp", "64", "--sampler", "sobol64", "-o", "a.exr"}).exitCode, 0);
    ASSERT_EQ(render({"--spp", "64", "--sampler", "sobol64", "--seed", "1", "-o", "b.exr"}).exitCode, 0);
    EXPECT_HAS(sahl({"compare", "a.exr", "b.exr"}, here()).out, "more than 64 by sobol64");
}

TEST_F(Sampling, whatIsStoppedInABlockOf64KeepsTheFilmOfWholeOnes)
{
    const Arguments picture = {"--sampler", "sobol64", "--spp", "192", "--keep-film", "-o"};
    auto rendered = [&](const std::string& file, Arguments more) {
        more.insert(more.begin(), picture.begin(), picture.end());
        more.insert(more.begin() + std::ptrdiff_t(picture.size()), file);
        const RunResult result = render(more);
        EXPECT_EQ(result.exitCode, 0) << result.err;
        return result.err;
    };
    rendered("one.exr", {});
    EXPECT_HAS(rendered("some.exr", {"--passes", "19"}), "--passes 16 makes the same picture again");
    EXPECT_EQ(describeExr(folder / "some.exr").metadata["sahl.sampleRanges"], "0:128");
    EXPECT_EQ(describeExr(folder / "some.exr").metadata["sahl.stopped"], "passes");
    rendered("rest.exr", {"--sample-range", "128:192"});
    ASSERT_EQ(sahl({"merge", "rest.exr", "some.exr", "--keep-film", "-o", "merged.exr"}, here()).exitCode, 0);
    EXPECT_TRUE(textOf(folder / "merged.exr") == textOf(folder / "one.exr"));

    EXPECT_HAS(rendered("few.exr", {"--passes", "3"}), "the 24 samples end inside a block of 64");
    EXPECT_EQ(describeExr(folder / "few.exr").metadata["sahl.sampleCount"], "24");
    EXPECT_FALSE(describeExr(folder / "few.exr").metadata.contains("sahl.sampleRanges"));
}

TEST_F(Sampling, partsOfOtherSamplersAreNotMerged)
{
    ASSERT_EQ(render({"--spp", "16", "--sample-range", "0:8", "-o", "a.exr"}).exitCode, 0);
    ASSERT_EQ(render({"--spp", "16", "--sample-range", "8:16", "--sampler", "sobol", "-o", "b.exr"})
                  .exitCode,
              0);
    const RunResult result = sahl({"merge", "a.exr", "b.exr", "-o", "c.exr"}, here());
    EXPECT_EQ(result.exitCode, 3);
    EXPECT_HAS(result.err, "sahl.sampler is \"sobol\", that of a.exr is \"independent\"");
}

TEST_F(Sampling, aPartThatWasClampedIsNotTakenForOneThatWasNot)
{
    const Arguments part = {"--spp", "16", "--shard", "0/2", "-o", "part.exr", "--skip-existing"};
    Arguments clamped = part;
    clamped.insert(clamped.end(), {"--clamp-indirect", "0.1"});
    ASSERT_EQ(render(clamped).exitCode, 0);
    EXPECT_HAS(render(part).err, "sahl.clampIndirect is \"0.1\", not \"off\"; rendering it");
    EXPECT_HAS(render(part).err, "is finished already");
}

TEST_F(Sampling, compareKnowsWhatTheVarianceIsOver)
{
    ASSERT_EQ(render({"--spp", "8", "--sampler", "sobol", "-o", "a.exr"}).exitCode, 0);
    ASSERT_EQ(render({"--spp", "8", "--sampler", "sobol", "--seed", "1", "-o", "b.exr"}).exitCode,
              0);
    const RunResult oneBlock = sahl({"compare", "a.exr", "b.exr"}, here());
    EXPECT_EQ(oneBlock.exitCode, 1);
    EXPECT_HAS(oneBlock.out, "more than 8 by the sampler sobol");
    // Of the same seed, but by another sampler: other random numbers.
    ASSERT_EQ(render({"--spp", "32", "--sampler", "sobol", "-o", "a.exr"}).exitCode, 0);
    ASSERT_EQ(render({"--spp", "32", "-o", "b.exr"}).exitCode, 0);
    const RunResult result = sahl({"compare", "a.exr", "b.exr", "--json"}, here());
    const nlohmann::json json = nlohmann::json::parse(result.out);
    EXPECT_FALSE(json["statistics"].is_null());
    EXPECT_NE(json["verdict"], "differ");
}

}  // namespace
}  // namespace sahl::testing
