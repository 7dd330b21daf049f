// --partial: pictures that are written before they are finished.
#include "cli/sahl_program.h"
#include "image/image.h"

#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfStringAttribute.h>

#include <csignal>
#include <regex>

namespace sahl::testing {
namespace {

std::string exrText(const fs::path& path, const char* name)
{
    Imf::InputFile file(path.c_str());
    auto* attribute = file.header().findTypedAttribute<Imf::StringAttribute>(name);
    return attribute ? attribute->value() : "(none)";
}

size_t timesIn(const std::string& text, const std::string& part)
{
    size_t count = 0;
    for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        count++;
    return count;
}

/// Whether a bar has shown that a pass is done, which is after its picture was written.
bool passDone(const std::string& text)
{
    return std::regex_search(text, std::regex(" [1-9][0-9]*/16777216 spp"));
}

class Partial : public SceneFolderTest {
protected:
    /// Renders into a.exr without end, until a pass is done; then kills the program.
    void killAfterAPass(const char* seconds) const
    {
        RunningProgram program(SAHL_PROGRAM,
                               {"render", "ball.json", "--device", "cpu", "--threads", "1", "--spp",
                                "16777216", "--progress", "bar", "-o", "a.exr", "--partial",
                                seconds},
                               here());
        EXPECT_TRUE(program.waitForError(passDone));
        program.signal(SIGKILL);
        program.finish();
    }
};

TEST_F(Partial, killedProgram_leavesThePictureOfWholePasses)
{
    killAfterAPass("0");
    ASSERT_TRUE(fs::exists(folder / "a.exr"));
    EXPECT_EQ(exrText(folder / "a.exr", "sahl.partial"), "yes");
    const std::string count = exrText(folder / "a.exr", "sahl.sampleCount");
    EXPECT_EQ(std::stoi(count), 8 * std::stoi(exrText(folder / "a.exr", "sahl.passes")));
    ASSERT_EQ(render({"--spp", count, "-o", "b.exr"}).exitCode, 0);
    EXPECT_EQ(readImage(folder / "a.exr").rgb, readImage(folder / "b.exr").rgb);
}

TEST_F(Partial, beforeItsTime_nothingIsWritten)
{
    killAfterAPass("1000000");
    EXPECT_FALSE(fs::exists(folder / "a.exr"));
}

TEST_F(Partial, finishedPicture_isTheSameFileAsWithout)
{
    for (const char* spp : {"4", "8", "20"}) {
        const Arguments common = {"--spp", spp, "--aovs", "--crop", "2,3,9,6"};
        auto rendered = [&](const char* name, const Arguments& more) {
            Arguments arguments = common;
            arguments.insert(arguments.end(), {"-o", name});
            arguments.insert(arguments.end(), more.begin(), more.end());
            EXPECT_EQ(render(arguments).exitCode, 0);
            return textOf(folder / name);
        };
        EXPECT_EQ(rendered("a.exr", {}), rendered("b.exr", {"--partial", "0"}));
        EXPECT_EQ(rendered("a.png", {}), rendered("b.png", {"--partial", "0"}));
    }
}

TEST_F(Partial, failure_isToldOnceAndRenderingGoesOn)
{
    fs::create_symlink("/dev/full", folder / "full.exr");
    RunResult result =
        render({"--spp", "48", "--partial", "0", "-o", "full.exr", "-o", "good.exr"});
    EXPECT_EQ(result.exitCode, 4) << "the finished picture could not be written there either";
    const std::string warning = "warning: full.exr: cannot write: No space left on device; the "
                                "picture so far could not be written; rendering goes on\n";
    EXPECT_EQ(timesIn(result.err, warning), 1u) << result.err;
    EXPECT_EQ(timesIn(result.err, "cannot write"), 2u) << result.err;
    EXPECT_EQ(exrText(folder / "good.exr", "sahl.sampleCount"), "48");
    EXPECT_EQ(exrText(folder / "good.exr", "sahl.partial"), "(none)");
}

TEST_F(Partial, failure_savesOnlyTheFinishedPictureElsewhere)
{
    fs::create_directory(folder / "elsewhere");
    fs::create_symlink("/dev/full", folder / "full.exr");
    RunOptions options = here();
    options.environment["TMPDIR"] = folder / "elsewhere";
    EXPECT_EQ(render({"--spp", "48", "--partial", "0", "-o", "full.exr"}, options).exitCode, 4);
    std::vector<fs::path> rescued;
    for (const auto& entry : fs::directory_iterator(folder / "elsewhere")) {
        rescued.push_back(entry.path());
    }
    ASSERT_EQ(rescued.size(), 1u);
    EXPECT_EQ(exrText(rescued[0], "sahl.sampleCount"), "48");
}

TEST_F(Partial, negativeTimes_areUsageErrors)
{
    expectRefused(render({"--partial", "-1"}), 2, "--partial -1 is out of range");
    expectRefused(render({"--partial", "soon"}), 2, "--partial 'soon' is not a number");
}

}  // namespace
}  // namespace sahl::testing
