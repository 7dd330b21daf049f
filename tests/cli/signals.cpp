// Stopping: by Ctrl-C, by a service manager, twice.
#include "cli/sahl_program.h"
#include "image/image.h"

#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfStringAttribute.h>

#include <csignal>
#include <regex>

namespace sahl::testing {
namespace {

constexpr const char* ENDLESS = "16777216";  // samples per pixel: more than anyone waits for

std::string sampleCountIn(const fs::path& exr)
{
    Imf::InputFile file(exr.c_str());
    return file.header().typedAttribute<Imf::StringAttribute>("sahl.sampleCount").value();
}

/// Whether a bar has shown that a pass is done.
bool passDone(const std::string& text)
{
    return std::regex_search(text, std::regex(" [1-9][0-9]*/16777216 spp"));
}

class Signals : public SceneFolderTest {
protected:
    /// Renders into a.exr without end.
    std::unique_ptr<RunningProgram> startEndless(Arguments more = {}) const
    {
        Arguments arguments = {"render", "ball.json", "--device",   "cpu", "--threads", "1",
                               "--spp",  ENDLESS,     "--progress", "bar", "-o",        "a.exr"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return std::make_unique<RunningProgram>(SAHL_PROGRAM, arguments, here());
    }
};

/// The picture is not darker than one that was never interrupted: it is the very same.
TEST_F(Signals, interruptedPicture_isThatOfItsWholePasses)
{
    auto program = startEndless({"--tile", "5"});
    ASSERT_TRUE(program->waitForError(passDone));
    program->signal(SIGINT);
    RunResult result = program->finish();
    EXPECT_EQ(result.exitCode, 130);
    EXPECT_EQ(result.out, "a.exr\n");
    std::string count = sampleCountIn(folder / "a.exr");
    EXPECT_HAS(result.err,
               "sahl: interrupted; saving " + count + " of 16777216 samples per pixel\n");

    ASSERT_EQ(render({"--spp", count, "-o", "b.exr"}).exitCode, 0);
    EXPECT_EQ(readImage(folder / "a.exr").rgb, readImage(folder / "b.exr").rgb);
}

TEST_F(Signals, everyKindOfStop_savesAndHasItsExitCode)
{
    const std::pair<int, int> expected[] = {{SIGINT, 130}, {SIGTERM, 143}, {SIGHUP, 129}};
    for (const auto& [number, exitCode] : expected) {
        auto program = startEndless({"--stats", "stats.json"});
        ASSERT_TRUE(program->waitForError(passDone));
        program->signal(number);
        RunResult result = program->finish();
        EXPECT_EQ(result.exitCode, exitCode);
        EXPECT_EQ(files(), (std::vector<std::string>{"a.exr", "stats.json"}));
        EXPECT_EQ(readImage(folder / "a.exr").width, 16u);
        fs::remove(folder / "a.exr");
        fs::remove(folder / "stats.json");
    }
}

/// A closed room with white walls, in which paths take minutes.
std::string whiteRoom()
{
    auto scene = nlohmann::json::parse(ballScene(128, 128));
    scene["camera"]["eye"] = {0, 0, 0.5};
    scene["materials"]["clay"]["baseColor"] = {1, 1, 1};
    scene["integrator"]["maxBounces"] = 65535;
    return scene.dump();
}

TEST_F(Signals, secondInterrupt_endsAtOnceAndWritesNothing)
{
    writeText(folder / "ball.json", whiteRoom());
    writeText(folder / "a.exr", "old");
    auto program = startEndless();
    ASSERT_TRUE(
        program->waitForError([](const std::string& text) { return has(text, "device: "); }));
    ::usleep(200'000);
    program->signal(SIGINT);
    ::usleep(200'000);
    EXPECT_FALSE(program->ended()) << "the first one waits for the tile";
    auto before = std::chrono::steady_clock::now();
    program->signal(SIGINT);
    EXPECT_EQ(program->finish().exitCode, 130);
    EXPECT_LT(std::chrono::steady_clock::now() - before, std::chrono::seconds(5));
    EXPECT_EQ(textOf(folder / "a.exr"), "old");
    EXPECT_EQ(files(), std::vector<std::string>{"a.exr"});
}

TEST_F(Signals, interruptInTheFirstPass_saysSo)
{
    // Tiles of one pixel: the first pass is long, its tiles are short.
    auto program = startEndless({"--tile", "1", "--width", "1024", "--height", "1024"});
    ASSERT_TRUE(program->waitForError([](const std::string& text) { return has(text, " spp"); }));
    program->signal(SIGINT);
    RunResult result = program->finish();
    EXPECT_EQ(result.exitCode, 130);
    EXPECT_HAS(result.err,
               "interrupted in the first pass; saving its finished tiles, the rest is black");
    EXPECT_EQ(readImage(folder / "a.exr").width, 1024u);
}

TEST_F(Signals, interruptBeforeTheFirstSample_keepsTheOldPicture)
{
    auto scene = nlohmann::json::parse(ballScene());
    scene["shapes"][0]["level"] = 8;  // a tree that takes a while
    writeText(folder / "ball.json", scene.dump());
    writeText(folder / "a.exr", "old");
    auto program = startEndless();
    ASSERT_TRUE(program->waitForHandler(SIGINT));
    program->signal(SIGINT);
    RunResult result = program->finish();
    EXPECT_EQ(result.exitCode, 130);
    EXPECT_HAS(result.err, "sahl: interrupted before the first sample; nothing is saved\n");
    EXPECT_EQ(textOf(folder / "a.exr"), "old");
}

TEST_F(Signals, interruptedVerification_decidesNothing)
{
    RunningProgram program(
        SAHL_PROGRAM,
        {"verify", "ball.json", "--device", "cpu", "--spp", ENDLESS, "--progress", "bar"}, here());
    ASSERT_TRUE(program.waitForError([](const std::string& text) { return has(text, " %"); }));
    program.signal(SIGINT);
    RunResult result = program.finish();
    EXPECT_EQ(result.exitCode, 130);
    EXPECT_EQ(result.out, "");
    EXPECT_HAS(result.err, "sahl: interrupted; nothing is decided\n");
}

}  // namespace
}  // namespace sahl::testing
