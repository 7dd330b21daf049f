// Progress and streams: a bar where a terminal can redraw it, plain lines elsewhere.
#include "app/progress.h"
#include "cli/sahl_program.h"

#include <csignal>

namespace sahl::testing {
namespace {

/// Whether there is a character other than a line feed that moves or colours.
bool hasControlCharacters(const std::string& text)
{
    return std::any_of(text.begin(), text.end(),
                       [](char c) { return static_cast<unsigned char>(c) < 32 && c != '\n'; });
}

class Messages : public SceneFolderTest {
protected:
    /// Interrupts an endless rendering after a while and gives back what it wrote.
    RunResult interrupted(const Arguments& more, RunOptions options, const std::string& sign) const
    {
        Arguments arguments = {"render", "ball.json", "--device", "cpu", "--spp", "16777216"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        options.folder = folder;
        RunningProgram program(SAHL_PROGRAM, arguments, options);
        program.waitForHandler(SIGINT);
        program.waitForError([&](const std::string& text) { return has(text, sign); });
        ::usleep(300'000);
        program.signal(SIGINT);
        return program.finish();
    }
};

TEST_F(Messages, terminal_showsABarWithSamplesSpeedErrorAndTimeLeft)
{
    RunOptions options;
    options.standardError = Stream::terminal;
    options.environment = {{"TERM", "xterm"}};
    RunResult result = interrupted({}, options, " left\x1b[K");
    EXPECT_EQ(result.exitCode, 130);
    EXPECT_HAS(result.err, "\r[");
    EXPECT_HAS(result.err, "/16777216 spp");
    EXPECT_HAS(result.err, " Mrays/s");
    EXPECT_HAS(result.err, "  error ");
    EXPECT_HAS(result.err, "\r\x1b[Ksahl: interrupted") << "the bar is wiped away at the end";
    EXPECT_EQ(result.out, "ball.exr\nball.png\n");
}

TEST_F(Messages, withoutATerminal_haveNoControlCharacters)
{
    RunOptions plain;
    plain.environment = {{"TERM", "xterm"}};
    RunOptions dumb;
    dumb.standardError = Stream::terminal;
    dumb.environment = {{"TERM", "dumb"}};
    RunOptions unset;
    unset.standardError = Stream::terminal;
    unset.environment = {{"TERM", std::nullopt}};
    for (const RunOptions& options : {plain, dumb, unset}) {
        RunResult result = interrupted({}, options, "device: ");
        EXPECT_EQ(result.exitCode, 130);
        std::string text = result.err;
        std::erase(text, '\r');  // of the terminal itself, before each line feed
        EXPECT_FALSE(hasControlCharacters(text)) << text;
        EXPECT_HAS(text, "device: CPU");
    }
}

TEST_F(Messages, progressCanBeTurnedOff)
{
    RunOptions options;
    options.standardError = Stream::terminal;
    options.environment = {{"TERM", "xterm"}};
    RunResult none = interrupted({"--progress", "none"}, options, "device: ");
    EXPECT_FALSE(has(none.err, " spp")) << none.err;
    RunResult quiet = interrupted({"--quiet"}, options, "");
    EXPECT_EQ(quiet.err, "");
    EXPECT_EQ(quiet.out, "");
}

/// What a printer says of these seconds after the start, 25 % done at each.
std::string printed(const std::string& mode, bool quiet, const std::vector<double>& seconds)
{
    ::testing::internal::CaptureStderr();
    ProgressPrinter printer(mode, quiet, 64);
    for (double second : seconds) {
        RenderProgress progress;
        progress.fraction = 0.25;
        progress.samplesDone = 16;
        progress.rays = uint64_t(second * 2e6);
        progress.seconds = second;
        progress.relativeError = [] { return 0.034; };
        printer.update(progress);
    }
    printer.finish();
    return ::testing::internal::GetCapturedStderr();
}

TEST(Progress, plain_isALineEveryTenSeconds)
{
    const std::string line = " 25 %  16/64 spp  2.00 Mrays/s  error 3.4 %  ";
    EXPECT_EQ(printed("plain", false, {1, 5, 9.9, 10, 15, 19, 21, 25}),
              line + "30 s left\n" + line + "1:03 min left\n");
    EXPECT_EQ(printed("auto", false, {1, 10, 11}), line + "30 s left\n");
}

TEST(Progress, noneAndQuiet_sayNothing)
{
    EXPECT_EQ(printed("none", false, {1, 20}), "");
    EXPECT_EQ(printed("bar", true, {1, 20}), "");
    EXPECT_EQ(printed("plain", true, {1, 20}), "");
}

TEST(Progress, bar_fillsAndIsWipedAway)
{
    std::string text = printed("bar", false, {1});
    EXPECT_TRUE(text.starts_with("\r[")) << text;
    EXPECT_TRUE(text.ends_with("\x1b[K\r\x1b[K")) << text;
    EXPECT_HAS(text, "#");
}

class Streams : public SceneFolderTest {};

TEST_F(Streams, closedOrFullStderr_isNoError)
{
    ASSERT_EQ(render({"-o", "whole.exr"}).exitCode, 0);
    for (Stream stream : {Stream::closed, Stream::full}) {
        RunOptions options = here();
        options.standardError = stream;
        RunResult result = render({"-o", "a.exr", "-v", "--progress", "bar"}, options);
        EXPECT_EQ(result.exitCode, 0);
        EXPECT_EQ(textOf(folder / "a.exr"), textOf(folder / "whole.exr"))
            << "with no message inside";
        EXPECT_EQ(render({"--spp", "0"}, options).exitCode, 2);
    }
}

TEST_F(Streams, closedOrFullStdout_isAnErrorAfterThePicturesAreSaved)
{
    ASSERT_EQ(render({"-o", "whole.exr"}).exitCode, 0);
    for (Stream stream : {Stream::closed, Stream::full}) {
        RunOptions options = here();
        options.standardOutput = stream;
        RunResult result = render({"-o", "a.exr"}, options);
        EXPECT_EQ(result.exitCode, 4);
        EXPECT_HAS(result.err, "sahl: stdout: cannot write: ");
        EXPECT_EQ(textOf(folder / "a.exr"), textOf(folder / "whole.exr"));
    }
    RunOptions options = here();
    options.standardOutput = Stream::full;
    EXPECT_EQ(sahl({"verify", "ball.json", "--device", "cpu"}, options).exitCode, 4);
}

}  // namespace
}  // namespace sahl::testing
