// --adaptive as users meet it: its options, what it says, and what an interruption leaves.
#include "cli/sahl_program.h"
#include "image/image.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfStringAttribute.h>

#include <algorithm>
#include <csignal>
#include <regex>

namespace sahl::testing {
namespace {

std::string attributeOf(const fs::path& exr, const char* name)
{
    Imf::InputFile file(exr.c_str());
    auto* attribute = file.header().findTypedAttribute<Imf::StringAttribute>(name);
    return attribute ? attribute->value() : "(none)";
}

std::vector<float> channelOf(const fs::path& exr, const char* name)
{
    Imf::InputFile file(exr.c_str());
    const auto window = file.header().dataWindow();
    const auto width = static_cast<size_t>(window.max.x + 1);
    std::vector<float> values(width * static_cast<size_t>(window.max.y + 1));
    Imf::FrameBuffer frame;
    frame.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), sizeof(float),
                                  width * sizeof(float)));
    file.setFrameBuffer(frame);
    file.readPixels(window.min.y, window.max.y);
    return values;
}

class AdaptiveProgram : public SceneFolderTest {};

TEST_F(AdaptiveProgram, saysWhatTheRuleDidInSummaryFileAndStatistics)
{
    RunResult result =
        render({"--adaptive", "report", "--epsilon", "0.003", "--min-spp", "5", "--max-spp", "40",
                "-o", "a.exr", "--stats", "a.json"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_HAS(result.err, "adaptive: rule report (biased), epsilon 0.003, 5 to 40 samples per pixel: ");

    std::vector<float> counts = channelOf(folder / "a.exr", "samples.Y");
    auto statistics = nlohmann::json::parse(textOf(folder / "a.json"));
    const auto& adaptive = statistics["adaptive"];
    double sum = 0;
    for (float count : counts) {
        EXPECT_GE(count, 5);
        EXPECT_LE(count, 40);
        sum += count;
    }
    double mean = sum / double(counts.size());
    EXPECT_GT(mean, 5) << "all alike";
    EXPECT_LT(mean, 40) << "all alike";
    EXPECT_EQ(statistics["counters"]["cameraRays"], sum);
    EXPECT_DOUBLE_EQ(adaptive["meanSamples"], mean);
    EXPECT_DOUBLE_EQ(adaptive["savedShare"], 1 - mean / 40);
    EXPECT_EQ(adaptive["epsilon"], 0.003);
    EXPECT_EQ(adaptive["convergedPixels"].get<int>() + adaptive["pixelsAtMaximum"].get<int>(), 16 * 12);

    const std::pair<const char*, const char*> expected[] = {
        {"sahl.adaptive", "report"}, {"sahl.biased", "yes"},    {"sahl.epsilon", "0.003"},
        {"sahl.minSamples", "5"},    {"sahl.maxSamples", "40"}, {"sahl.interrupted", "no"}};
    for (const auto& [name, value] : expected) EXPECT_EQ(attributeOf(folder / "a.exr", name), value) << name;
}

TEST_F(AdaptiveProgram, saysHowNearTheTargetItCame)
{
    for (const char* rule : {"crossed", "joint"}) {
        const bool unbiased = rule == std::string("crossed");
        RunResult result = render({"--adaptive", rule, "--target-error", "0.1", "--min-spp", "32", "--max-spp", "160",
                                   "-o", "a.exr", "--stats", "a.json", "--error-map", "error.png"});
        ASSERT_EQ(result.exitCode, 0) << result.err;
        EXPECT_HAS(result.err, std::string("adaptive: rule ") + rule + (unbiased ? " (unbiased)" : " (biased)") +
                                   ", target error 0.1, 32 to 160 samples per pixel: ");
        EXPECT_HAS(result.out, "error.png");

        const std::vector<float> errors = channelOf(folder / "a.exr", "error.Y");
        const double reached =
            double(std::count_if(errors.begin(), errors.end(), [](float e) { return e <= 0.1f; })) /
            double(errors.size());
        const auto adaptive = nlohmann::json::parse(textOf(folder / "a.json"))["adaptive"];
        EXPECT_DOUBLE_EQ(adaptive["reachedShare"], reached);
        EXPECT_GT(reached, 0.3);
        EXPECT_EQ(adaptive["biased"], !unbiased);
        EXPECT_EQ(adaptive["targetError"], 0.1);
        EXPECT_GT(adaptive["frameError"], 0.0);
        EXPECT_LT(adaptive["frameError"], 0.1);
        EXPECT_EQ(attributeOf(folder / "a.exr", "sahl.adaptive"), rule);
        EXPECT_EQ(attributeOf(folder / "a.exr", "sahl.biased"), unbiased ? "no" : "yes");
        EXPECT_EQ(attributeOf(folder / "a.exr", "sahl.targetError"), "0.1");
        EXPECT_EQ(attributeOf(folder / "a.exr", "sahl.stopped"), "no");
    }
}

TEST_F(AdaptiveProgram, passesMakeThePictureOfATimeLimitAgain)
{
    const std::vector<Arguments> ways = {{"--spp", "4096"},
                                         {"--adaptive", "crossed", "--target-error", "1e-6", "--max-spp", "4096"}};
    for (const Arguments& way : ways) {
        auto with = [&](Arguments more) {
            more.insert(more.end(), way.begin(), way.end());
            return render(more);
        };
        RunResult limited = with({"--time-limit", "0", "-o", "a.exr"});
        ASSERT_EQ(limited.exitCode, 0) << limited.err;
        EXPECT_EQ(attributeOf(folder / "a.exr", "sahl.stopped"), "time");
        EXPECT_EQ(attributeOf(folder / "a.exr", "sahl.passes"), "1");
        EXPECT_EQ(attributeOf(folder / "a.exr", "sahl.sampleCount"), "8");
        EXPECT_HAS(limited.err, "stopped by the time limit after 1 passes; --passes 1 makes the same picture again");

        ASSERT_EQ(with({"--passes", "1", "-o", "b.exr"}).exitCode, 0);
        EXPECT_EQ(attributeOf(folder / "b.exr", "sahl.stopped"), "passes");
        EXPECT_EQ(readImage(folder / "a.exr").rgb, readImage(folder / "b.exr").rgb);
        ASSERT_EQ(with({"--passes", "3", "-o", "c.exr"}).exitCode, 0);
        EXPECT_EQ(attributeOf(folder / "c.exr", "sahl.sampleCount"), "24");
        EXPECT_NE(readImage(folder / "c.exr").rgb, readImage(folder / "b.exr").rgb);
    }
    // More passes than there are change nothing.
    ASSERT_EQ(render({"--spp", "9", "--passes", "7", "-o", "d.exr"}).exitCode, 0);
    EXPECT_EQ(attributeOf(folder / "d.exr", "sahl.stopped"), "no");
    EXPECT_EQ(attributeOf(folder / "d.exr", "sahl.sampleCount"), "9");
}

TEST_F(AdaptiveProgram, cropAndPartialGoWithEveryRule)
{
    for (const char* rule : {"crossed", "joint", "report"}) {
        RunResult result = render({"--adaptive", rule, "--max-spp", "64", "--crop", "3,2,7,5", "--partial", "0", "-o",
                                   "a.exr"});
        ASSERT_EQ(result.exitCode, 0) << result.err;
        EXPECT_EQ(readImage(folder / "a.exr").width, 7u);
        EXPECT_EQ(attributeOf(folder / "a.exr", "sahl.partial"), "(none)");
        EXPECT_EQ(attributeOf(folder / "a.exr", "sahl.crop"), "3,2,7,5");
    }
}

TEST_F(AdaptiveProgram, withoutARuleNothingIsSaidOfIt)
{
    RunResult result = render({"-o", "a.exr"});
    EXPECT_FALSE(has(result.err, "adaptive")) << result.err;
    EXPECT_EQ(attributeOf(folder / "a.exr", "sahl.adaptive"), "(none)");
}

TEST_F(AdaptiveProgram, sceneFileAndCommandLineAskForTheSame)
{
    auto scene = nlohmann::json::parse(ballScene());
    scene["integrator"]["adaptive"] = {
        {"rule", "report"}, {"epsilon", 0.003}, {"minSamples", 5}, {"maxSamples", 40}};
    writeText(folder / "adaptive.json", scene.dump());
    ASSERT_EQ(sahl({"render", "adaptive.json", "--device", "cpu", "-o", "a.pfm"}, here()).exitCode, 0);
    ASSERT_EQ(render({"--adaptive", "report", "--epsilon", "3e-3", "--min-spp", "5", "--max-spp",
                      "40", "-o", "b.pfm"})
                  .exitCode,
              0);
    EXPECT_EQ(textOf(folder / "a.pfm"), textOf(folder / "b.pfm"));

    // The command line turns the scene's rule off.
    ASSERT_EQ(sahl({"render", "adaptive.json", "--device", "cpu", "--adaptive", "none", "-o", "c.pfm"},
                   here())
                  .exitCode,
              0);
    ASSERT_EQ(render({"-o", "d.pfm"}).exitCode, 0);
    EXPECT_EQ(textOf(folder / "c.pfm"), textOf(folder / "d.pfm"));
}

TEST_F(AdaptiveProgram, optionsWithoutEffectAndContradictionsAreRefused)
{
    expectRefused(render({"--adaptive", "reprot"}), 2, "did you mean report?");
    expectRefused(render({"--epsilon", "0.1"}), 2,
                  "--epsilon says nothing without adaptive sampling; add --adaptive report");
    expectRefused(render({"--max-spp", "100"}), 2, "--max-spp says nothing");
    expectRefused(render({"--adaptive", "report", "--spp", "8"}), 2, "--spp says nothing under adaptive");
    expectRefused(render({"--adaptive", "report", "--max-spp", "8"}), 2,
                  "--min-spp is 20, above --max-spp, which is 8");
    expectRefused(render({"--target-error", "0.1"}), 2, "--target-error says nothing under the rule none");
    expectRefused(render({"--adaptive", "joint", "--epsilon", "0.1"}), 2, "--epsilon says nothing under the rule joint");
    expectRefused(render({"--adaptive", "crossed", "--max-spp", "1000"}), 2,
                  "--max-spp is 1000, and crossed takes samples in blocks of 8, as many in each half; give a "
                  "multiple of 16, such as 992");
    expectRefused(render({"--adaptive", "report", "--epsilon", "0"}), 2, "--epsilon 0 is out of range");
}

TEST_F(AdaptiveProgram, interruptedPictureIsThatOfItsWholePasses)
{
    RunningProgram program(SAHL_PROGRAM,
                           {"render", "ball.json", "--device", "cpu", "--threads", "1", "--adaptive",
                            "report", "--epsilon", "1e-30", "--max-spp", "16777216", "--progress",
                            "bar", "--tile", "5", "-o", "a.exr"},
                           here());
    ASSERT_TRUE(program.waitForError([](const std::string& text) {
        return std::regex_search(text, std::regex(" [1-9][0-9]*/16777216 spp"));
    }));
    program.signal(SIGINT);
    RunResult result = program.finish();
    EXPECT_EQ(result.exitCode, 130);
    std::string count = attributeOf(folder / "a.exr", "sahl.sampleCount");
    EXPECT_HAS(result.err,
               "sahl: interrupted; saving up to " + count + " of 16777216 samples per pixel\n");

    ASSERT_EQ(render({"--adaptive", "report", "--epsilon", "1e-30", "--min-spp", count, "--max-spp",
                      count, "-o", "b.exr"})
                  .exitCode,
              0);
    EXPECT_EQ(readImage(folder / "a.exr").rgb, readImage(folder / "b.exr").rgb);
}

TEST_F(AdaptiveProgram, verifyComparesAdaptiveFilms)
{
    RunResult result = sahl({"verify", "ball.json", "--device", "cpu", "--adaptive", "report",
                             "--epsilon", "0.003", "--max-spp", "50"},
                            here());
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_HAS(result.out, "20 to 50 spp by the rule report");
    EXPECT_HAS(result.out, "EQUAL      0 differing bits");
}

}  // namespace
}  // namespace sahl::testing
