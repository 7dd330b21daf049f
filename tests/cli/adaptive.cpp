// --adaptive as users meet it: its options, what it says, and what an interruption leaves.
#include "cli/sahl_program.h"
#include "image/image.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfStringAttribute.h>

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
