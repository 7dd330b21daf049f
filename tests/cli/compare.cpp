// `sahl compare`: verdicts, gates and exit codes as scripts meet them, and what it refuses.
#include "cli/sahl_program.h"
#include "image/image.h"

#include <cmath>
#include <limits>

namespace sahl::testing {
namespace {

constexpr float NOT_A_NUMBER = std::numeric_limits<float>::quiet_NaN();

class Compare : public SceneFolderTest {
protected:
    RunResult compare(const Arguments& more) const
    {
        Arguments arguments = {"compare"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return sahl(arguments, here());
    }

    nlohmann::json compareJson(const Arguments& more, int exitCode) const
    {
        Arguments arguments = more;
        arguments.push_back("--json");
        const RunResult result = compare(arguments);
        EXPECT_EQ(result.exitCode, exitCode) << result.out << result.err;
        const nlohmann::json json = nlohmann::json::parse(result.out, nullptr, false);
        EXPECT_TRUE(json.is_object()) << result.out;
        EXPECT_EQ(json.value("exitCode", -1), exitCode);
        return json;
    }

    /// A picture of one row, .exr or .pfm.
    void writePicture(const std::string& name, std::vector<float> values) const
    {
        const Image image = {static_cast<uint32_t>(values.size() / 3), 1, std::move(values)};
        writeFileAtomically(folder / name,
                            name.ends_with(".exr") ? encodeExr(image, {}) : encodePfm(image));
    }

    /// 16 x 16 grey pixels, half of them above the mean and half below, with a variance each.
    void writeNoisy(const std::string& name, float mean, float noise, const std::string& seed) const
    {
        Image image = {16, 16, {}};
        ImageChannel variance = {"variance.Y", std::vector<float>(256, noise * noise)};
        ImageChannel samples = {"samples.Y", std::vector<float>(256, 64)};
        for (int i = 0; i < 768; i++) image.rgb.push_back(mean + (i / 3 % 2 ? noise : -noise));
        const std::vector<ImageChannel> channels = {variance, samples};
        writeFileAtomically(folder / name, encodeExr(image,
                                                     {{"sahl.seed", seed},
                                                      {"sahl.sampler", "independent"},
                                                      {"sahl.scene", "grey.json"},
                                                      {"sahl.firstSample", "0"},
                                                      {"sahl.sampleCount", "64"}},
                                                     channels));
    }
};

TEST_F(Compare, aPictureAndItself_areTheSame)
{
    ASSERT_EQ(render({"-o", "a.exr", "-o", "a.png", "-o", "a.pfm"}).exitCode, 0);
    for (const char* name : {"a.exr", "a.png", "a.pfm"}) {
        const RunResult result = compare({name, name});
        EXPECT_EQ(result.exitCode, 0) << result.out;
        EXPECT_HAS(result.out, "verdict   SAME: all values are the same, bit for bit\n");
        EXPECT_EQ(result.err, "");
        EXPECT_EQ(compareJson({name, name}, 0)["verdict"], "same");
    }
    EXPECT_EQ(compareJson({"a.exr", "a.pfm"}, 0)["sameBits"], true);
}

TEST_F(Compare, rendersOfOneSceneWithTwoSeeds_areUndecidedAndSayWhatWouldHaveBeenSeen)
{
    ASSERT_EQ(render({"-o", "a.exr", "--seed", "1"}).exitCode, 0);
    ASSERT_EQ(render({"-o", "b.exr", "--seed", "2"}).exitCode, 0);
    const RunResult result = compare({"a.exr", "b.exr"});
    EXPECT_EQ(result.exitCode, 1) << result.out;
    EXPECT_HAS(result.out, "verdict   UNDECIDED: no difference found, but one of 0.1 %");
    EXPECT_HAS(result.out, "times as many samples would decide");
    EXPECT_HAS(result.out, "detectable     a bias of ");
    EXPECT_HAS(result.out, "A         a.exr: EXR, 16 x 12, ball.json, samples 4, seed 1");

    const nlohmann::json json = compareJson({"a.exr", "b.exr"}, 1);
    EXPECT_EQ(json["version"], 1);
    EXPECT_EQ(json["statistics"]["testedBlocks"], 4);
    EXPECT_GT(json["statistics"]["detectableBias"], 0);
    EXPECT_GT(json["statistics"]["moreSamples"], 1);
    EXPECT_EQ(json["a"]["metadata"]["sahl.seed"], "1");
    EXPECT_EQ(json["paired"], nullptr);
}

TEST_F(Compare, rendersWithOneSeed_areSaidToBeCorrelatedAndGetNoVerdict)
{
    ASSERT_EQ(render({"-o", "a.exr"}).exitCode, 0);
    ASSERT_EQ(render({"-o", "b.exr", "--max-bounces", "0"}).exitCode, 0);
    const RunResult result = compare({"a.exr", "b.exr"});
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_HAS(result.out, "UNDECIDED: both files have equal seed, sampler and scene");
    EXPECT_HAS(result.out, "paired    A - B +");
    const nlohmann::json json = compareJson({"a.exr", "b.exr", "--equivalent", "0.5"}, 1);
    EXPECT_EQ(json["statistics"], nullptr);
    EXPECT_GT(json["paired"]["mean"], 0);  // less light with fewer bounces
}

TEST_F(Compare, verdictAndGateOfEquivalence_followFromNoiseAndDifference)
{
    writeNoisy("a.exr", 1.0f, 0.01f, "1");
    writeNoisy("same.exr", 1.00001f, 0.01f, "2");
    writeNoisy("off.exr", 1.01f, 0.01f, "3");
    // The standard error of the frame is 0.01 * sqrt(2) / 16 = 0.088 %.
    EXPECT_EQ(compareJson({"a.exr", "same.exr"}, 1)["verdict"], "undecided");
    EXPECT_EQ(compareJson({"a.exr", "same.exr", "--equivalent", "0.002"}, 0)["verdict"],
              "equivalent");
    EXPECT_EQ(compareJson({"a.exr", "off.exr"}, 2)["verdict"], "differ");
    EXPECT_EQ(compareJson({"a.exr", "off.exr", "--equivalent", "0.002"}, 2)["verdict"], "differ");
    EXPECT_EQ(compareJson({"a.exr", "off.exr", "--equivalent", "0.02"}, 0)["verdict"],
              "equivalent");
    EXPECT_EQ(compareJson({"a.exr", "off.exr", "--equivalent", "0.01"}, 1)["verdict"], "undecided");
}

TEST_F(Compare, gates_decideAloneWhereThereAreSome)
{
    writePicture("a.pfm", {0.5f, 0.5f, 0.5f});
    writePicture("b.pfm", {0.6f, 0.6f, 0.6f});
    EXPECT_EQ(compare({"a.pfm", "b.pfm"}).exitCode, 2);
    // relMSE = 0.01 / (0.36 + 0.01) = 0.0270
    EXPECT_EQ(compare({"a.pfm", "b.pfm", "--max-relmse", "0.028"}).exitCode, 0);
    EXPECT_EQ(compare({"a.pfm", "b.pfm", "--max-relmse", "0.026"}).exitCode, 2);
    EXPECT_EQ(compare({"a.pfm", "b.pfm", "--max-flip", "1"}).exitCode, 0);
    EXPECT_EQ(compare({"a.pfm", "b.pfm", "--max-flip", "0.001"}).exitCode, 2);
    EXPECT_EQ(compare({"a.pfm", "b.pfm", "--max-flip", "1", "--bitwise"}).exitCode, 2);
    EXPECT_EQ(compare({"a.pfm", "a.pfm", "--max-flip", "0", "--bitwise"}).exitCode, 0);
    const RunResult result = compare({"a.pfm", "b.pfm", "--max-relmse", "0.026"});
    EXPECT_HAS(result.out, "gate      --max-relmse failed: relMSE is 0.0270");
    EXPECT_HAS(result.out, "at most 0.026 is allowed");
}

TEST_F(Compare, valuesThatAreNotFinite_areCountedAndNeverPass)
{
    writePicture("a.exr", {1, 1, 1, 1, NOT_A_NUMBER, 1, -2, 1, 1});
    writePicture("b.exr", {1, 1, 1, 1, 1, 1, -2, 1, 1});
    const RunResult result = compare({"a.exr", "b.exr"});
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_HAS(result.out, "values    A  R: 0 NaN, 0 infinite, 1 negative; G: 1 NaN, 0 infinite, 0 "
                           "negative\n");
    EXPECT_HAS(result.out, "values    B  R: 0 NaN, 0 infinite, 1 negative\n");
    EXPECT_HAS(result.out, "1 pixels are not finite in a file: metrics and tests leave them out");
    EXPECT_EQ(compareJson({"a.exr", "b.exr", "--max-flip", "1", "--max-relmse", "1"},
                          2)["metrics"]["excludedPixels"],
              1);
    EXPECT_EQ(compare({"a.exr", "a.exr"}).exitCode, 0);
}

TEST_F(Compare, picturesOfOtherSizes_giveExitCode3)
{
    writePicture("a.exr", {1, 1, 1, 1, 1, 1});
    writePicture("b.pfm", {1, 1, 1});
    expectRefused(compare({"a.exr", "b.pfm"}), 3, "a.exr is 2 x 1 pixels, b.pfm is 1 x 1");
}

TEST_F(Compare, filesThatCannotBeRead_giveExitCode4)
{
    ASSERT_EQ(render({"-o", "a.png", "-o", "a.exr"}).exitCode, 0);
    writeText(folder / "empty.exr", "");
    writeText(folder / "text.exr", "no picture");
    writeText(folder / "cut.pfm", "PF\n2 2\n-1.0\nabc");
    const std::string exr = textOf(folder / "a.exr"), png = textOf(folder / "a.png");
    writeText(folder / "half.exr", exr.substr(0, exr.size() / 2));
    writeText(folder / "half.png", png.substr(0, png.size() / 2));
    expectRefused(compare({"empty.exr", "a.exr"}), 4, "empty.exr: the file is empty");
    expectRefused(compare({"a.exr", "text.exr"}), 4, "text.exr: is of unknown kind");
    expectRefused(compare({"a.exr", "cut.pfm"}), 4, "cut.pfm: ");
    expectRefused(compare({"half.exr", "a.exr"}), 4, "half.exr: ");
    expectRefused(compare({"half.png", "a.png"}), 4, "half.png: damaged PNG: is truncated");
    expectRefused(compare({"a.exr", "missing.exr"}), 4, "missing.exr: cannot read: No such file");
    expectRefused(compare({"a.exr", "."}), 4, ".: is a directory, not a file");
    expectRefused(compare({"a.exr", "/dev/zero"}), 4, "/dev/zero: ");
}

TEST_F(Compare, commandLinesThatMakeNoSense_giveExitCode4)
{
    ASSERT_EQ(render({"-o", "a.png", "-o", "a.exr"}).exitCode, 0);
    expectRefused(compare({"a.exr"}), 4, "'sahl compare' needs two pictures");
    expectRefused(compare({"a.exr", "a.exr", "--max-flop", "1"}), 4, "did you mean --max-flip?");
    expectRefused(compare({"a.exr", "a.exr", "--level", "0"}), 4, "--level 0 is out of range");
    expectRefused(compare({"a.exr", "a.exr", "--max-flip", "2"}), 4,
                  "--max-flip 2 is out of range");
    expectRefused(
        compare({"a.exr", "a.png", "--equivalent", "0.01"}), 4,
        "--equivalent needs the variance of both pictures; a.png has no layer variance.Y");
    RunOptions options = here();
    options.standardOutput = Stream::full;
    EXPECT_EQ(sahl({"compare", "a.exr", "a.exr"}, options).exitCode, 4);
}

TEST_F(Compare, quiet_saysNothingButTheExitCode)
{
    writePicture("a.pfm", {1, 1, 1});
    writePicture("b.pfm", {2, 2, 2});
    const RunResult result = compare({"a.pfm", "b.pfm", "-q"});
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_EQ(result.out + result.err, "");
}

TEST_F(Compare, pngPictures_areComparedAsDisplayed)
{
    ASSERT_EQ(render({"-o", "a.png", "--tone-map", "exposure"}).exitCode, 0);
    ASSERT_EQ(
        render({"-o", "a.exr", "-o", "b.png", "--tone-map", "exposure", "--seed", "3"}).exitCode,
        0);
    const nlohmann::json json = compareJson({"a.png", "b.png"}, 2);
    EXPECT_EQ(json["metrics"]["hdrFlip"], nullptr);
    EXPECT_GT(json["metrics"]["ldrFlip"]["mean"]["all"], 0);
    EXPECT_EQ(json["statistics"], nullptr);
    EXPECT_EQ(json["a"]["metadata"]["sahl.seed"], "0");
    // Clipped and rounded to 8 bits, the linear picture is the displayed one.
    const nlohmann::json both = compareJson({"a.exr", "b.png"}, 2);
    EXPECT_GT(both["metrics"]["psnr"]["all"], 50);
    EXPECT_LT(both["metrics"]["ldrFlip"]["mean"]["all"], 0.02);
}

}  // namespace
}  // namespace sahl::testing
