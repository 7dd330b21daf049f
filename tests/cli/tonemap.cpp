// `sahl tonemap`: linear pictures into .png, and what it refuses.
#include "cli/sahl_program.h"
#include "image/image.h"
#include "support/png_files.h"

#include <cmath>
#include <limits>

namespace sahl::testing {
namespace {

using Names = std::vector<std::string>;

class Tonemap : public SceneFolderTest {
protected:
    RunResult tonemap(const Arguments& more) const
    {
        Arguments arguments = {"tonemap"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return sahl(arguments, here());
    }

    /// A picture of one row.
    void writePicture(const std::string& name, std::vector<float> values) const
    {
        const Image image = {static_cast<uint32_t>(values.size() / 3), 1, std::move(values)};
        writeFileAtomically(folder / name,
                            name.ends_with(".exr") ? encodeExr(image, {}) : encodePfm(image));
    }

    std::vector<uint8_t> mapped(const Arguments& options) const
    {
        Arguments arguments = {"in.pfm", "-o", "out.png"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        RunResult result = tonemap(arguments);
        EXPECT_EQ(result.exitCode, 0) << result.err;
        EXPECT_EQ(result.out, "out.png\n");
        EXPECT_EQ(result.err, "");
        return readPng(folder / "out.png").rgb;
    }
};

TEST_F(Tonemap, givesWhatRenderGives)
{
    for (const char* op : {"percentile", "naive", "exposure", "filmic"}) {
        ASSERT_EQ(render({"-o", "a.exr", "-o", "a.png", "--tone-map", op}).exitCode, 0);
        ASSERT_EQ(tonemap({"a.exr", "-o", "b.png", "--operator", op}).exitCode, 0);
        EXPECT_EQ(readPng(folder / "a.png").rgb, readPng(folder / "b.png").rgb) << op;
        EXPECT_HAS(textOf(folder / "b.png"), op);
    }
}

TEST_F(Tonemap, operators_mapKnownValues)
{
    writePicture("in.pfm", {0, 0.5f, 2});
    using Bytes = std::vector<uint8_t>;
    EXPECT_EQ(mapped({"--operator", "naive"}), (Bytes{0, 64, 255}));
    EXPECT_EQ(mapped({"--operator", "naive", "--gamma", "2"}), (Bytes{0, 128, 255}));
    // Ranks 0.1 and 1.9: 0.05 to 1.85; (0.5 - 0.05) / 1.8 = 1/4
    EXPECT_EQ(mapped({}), (Bytes{0, 64, 255}));
    EXPECT_EQ(mapped({"--operator", "exposure"}), (Bytes{0, 188, 255}));
    EXPECT_EQ(mapped({"--operator", "exposure", "--exposure", "-1", "--gamma", "1"}),
              (Bytes{0, 64, 255}));
    // 0.6163 and 0.9149
    EXPECT_EQ(mapped({"--operator", "filmic", "--gamma", "1"}), (Bytes{0, 157, 233}));
    EXPECT_EQ(mapped({"--operator", "filmic", "--gamma", "1", "--exposure", "1"}),
              (Bytes{0, 205, 248}));
    EXPECT_EQ(mapped({"--operator", "naive", "--gamma", "srgb"}), (Bytes{0, 137, 255}));
}

TEST_F(Tonemap, readsExrHdrAndPfm)
{
    writePicture("a.exr", {0, 1, 2});
    writePicture("b.pfm", {0, 1, 2});
    std::string hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n";
    writeText(folder / "c.hdr", hdr + std::string({0, 64, char(128), char(130)}));  // 0, 1, 2
    for (std::string input : {"a.exr", "b.pfm", "c.hdr"}) {
        RunResult result = tonemap({input, "--operator", "naive"});
        EXPECT_EQ(result.exitCode, 0) << result.err;
        const std::string output = input.substr(0, 1) + ".png";
        EXPECT_EQ(result.out, output + "\n");
        EXPECT_EQ(readPng(folder / output).rgb, (std::vector<uint8_t>{0, 128, 255})) << input;
    }
}

TEST_F(Tonemap, histogram_isAPictureToo)
{
    writePicture("in.pfm", {0, 0.5f, 2});
    RunResult result = tonemap({"in.pfm", "--histogram", "h.png"});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(result.out, "in.png\nh.png\n");
    EXPECT_GT(readPng(folder / "h.png").width, 500u);
}

TEST_F(Tonemap, valuesThatAreNotFinite_countAsZeroAndAreTold)
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float inf = std::numeric_limits<float>::infinity();
    writePicture("in.exr", {nan, 1, inf, 2, -inf, 0});
    RunResult result =
        tonemap({"in.exr", "-o", "out.png", "--operator", "naive", "--histogram", "h.png"});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ(result.err, "sahl: warning: in.exr: 3 of 6 values are not finite and count as 0\n");
    EXPECT_EQ(readPng(folder / "out.png").rgb, (std::vector<uint8_t>{0, 128, 0, 255, 0, 0}));
    EXPECT_EQ(tonemap({"in.exr", "-o", "out.png", "-q"}).err, "");
}

TEST_F(Tonemap, extremeValues_giveAPicture)
{
    const float most = std::numeric_limits<float>::max();
    writePicture("in.exr", {most, -most, 1e-45f, most, 0, 1});
    for (const char* op : {"percentile", "naive", "exposure", "filmic"}) {
        RunResult result =
            tonemap({"in.exr", "-o", "out.png", "--operator", op, "--histogram", "h.png"});
        EXPECT_EQ(result.exitCode, 0) << op << result.err;
        const std::vector<uint8_t> rgb = readPng(folder / "out.png").rgb;
        EXPECT_EQ(rgb[0], 255) << op;
        EXPECT_EQ(rgb[1], 0) << op;
    }
}

TEST_F(Tonemap, inputsThatAreNoPictures_areRefused)
{
    writeText(folder / "empty.exr", "");
    writeText(folder / "text.exr", "no picture");
    writeText(folder / "cut.pfm", "PF\n2 2\n-1.0\nabc");
    fs::create_directory(folder / "folder.exr");
    ASSERT_EQ(render({"-o", "a.png", "-o", "a.exr"}).exitCode, 0);
    expectRefused(tonemap({"empty.exr"}), 3, "empty.exr: the file is empty");
    expectRefused(tonemap({"text.exr"}), 3,
                  "text.exr: is of unknown kind, not EXR, PFM or Radiance HDR");
    expectRefused(tonemap({"cut.pfm"}), 3, "cut.pfm: ");
    expectRefused(tonemap({"folder.exr"}), 3, "folder.exr: is a directory, not a file");
    expectRefused(tonemap({"a.png", "-o", "b.png"}), 3,
                  "a.png: is PNG, not EXR, PFM or Radiance HDR");
    expectRefused(tonemap({"missing.exr"}), 3, "missing.exr: cannot read: No such file");
    std::string exr = textOf(folder / "a.exr");
    writeText(folder / "half.exr", exr.substr(0, exr.size() / 2));
    expectRefused(tonemap({"half.exr"}), 3, "half.exr: ");
    EXPECT_FALSE(fs::exists(folder / "empty.png") || fs::exists(folder / "half.png"));
}

TEST_F(Tonemap, outputsThatCannotBeWritten_areRefused)
{
    writePicture("in.pfm", {0, 0.5f, 2});
    expectRefused(tonemap({"in.pfm", "-o", "out.exr"}), 2,
                  "-o 'out.exr': the name must end in .png");
    expectRefused(tonemap({"in.pfm", "-o", "missing/out.png"}), 4, "missing/out.png: cannot write");
    expectRefused(tonemap({"in.pfm", "--histogram", "in.png"}), 2,
                  "in.png: is written already; name another file for --histogram");
    expectRefused(tonemap({"in.pfm", "--histogram", "h.jpg"}), 2,
                  "--histogram 'h.jpg': the name must end in .png");
    fs::create_symlink("in.pfm", folder / "link.png");
    std::string before = textOf(folder / "in.pfm");
    expectRefused(tonemap({"in.pfm", "-o", "link.png"}), 2,
                  "link.png: is an input; writing it would destroy it");
    EXPECT_EQ(textOf(folder / "in.pfm"), before);
    fs::create_symlink("/dev/full", folder / "full.png");
    expectRefused(tonemap({"in.pfm", "-o", "full.png"}), 4,
                  "full.png: cannot write: No space left");
    EXPECT_EQ(files(), (Names{"full.png", "in.pfm", "link.png"}));
}

TEST_F(Tonemap, nonsense_isRefusedInWords)
{
    for (const char* gamma : {"0", "-2.2", "0.05", "11"}) {
        expectRefused(tonemap({"in.pfm", "--gamma", gamma}), 2,
                      std::string("--gamma ") + gamma +
                          " is out of range; give a number from 0.1 to 10, or srgb");
    }
    for (const char* gamma : {"nan", "inf", "sRGB", "", "2,2"}) {
        expectRefused(tonemap({"in.pfm", "--gamma", gamma}), 2,
                      std::string("--gamma '") + gamma +
                          "' is not a number; give one from 0.1 to 10, or srgb");
    }
    expectRefused(tonemap({"in.pfm", "--operator", "aces"}), 2,
                  "--operator 'aces' is not known; choose percentile, naive, exposure or filmic");
    expectRefused(tonemap({"in.pfm", "--exposure", "much"}), 2,
                  "--exposure 'much' is not a number");
    expectRefused(
        tonemap({"in.pfm", "--exposure", "1"}), 2,
        "--exposure changes nothing with percentile, which fits the picture's range; choose "
        "exposure or filmic");
    expectRefused(render({"--exposure", "0"}), 2, "--exposure changes nothing with percentile");
}

}  // namespace
}  // namespace sahl::testing
