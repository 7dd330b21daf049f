// Outputs that cannot be written: found out before rendering where possible, and never half a file.
#include "cli/sahl_program.h"
#include "image/image.h"

#include <csignal>

#include <poll.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

namespace sahl::testing {
namespace {

using Names = std::vector<std::string>;

class Outputs : public SceneFolderTest {
protected:
    /// Refused before anything was rendered, and nothing was left behind.
    void expectRefusedEarly(const std::string& output, int exitCode, const std::string& words) const
    {
        RunOptions options = here();
        options.obeysPermissions = true;
        Names before = files();
        RunResult result = render({"-o", output, "--spp", "16777216"}, options);
        expectRefused(result, exitCode, words);
        EXPECT_FALSE(has(result.err, "device:")) << result.err;
        EXPECT_EQ(files(), before);
    }
};

TEST_F(Outputs, foldersThatCannotBeWrittenTo_areFoundBeforeRendering)
{
    fs::create_directory(folder / "locked");
    fs::permissions(folder / "locked", fs::perms::owner_read | fs::perms::owner_exec);
    fs::create_directory(folder / "folder.exr");
    writeText(folder / "file", "");
    writeText(folder / "locked.exr", "old");
    fs::permissions(folder / "locked.exr", fs::perms::owner_read);

    expectRefusedEarly("missing/a.exr", 4,
                       "missing/a.exr: cannot write: No such file or directory (folder missing)");
    expectRefusedEarly("locked/a.exr", 4, "locked/a.exr: cannot write: Permission denied");
    expectRefusedEarly("locked.exr", 4, "locked.exr: cannot write: Permission denied");
    expectRefusedEarly("folder.exr", 4, "folder.exr: cannot write: it is a directory");
    expectRefusedEarly("file/a.exr", 4, "file/a.exr: cannot write: Not a directory");
    expectRefusedEarly(std::string(300, 'x') + ".exr", 4, "cannot write: File name too long");
    EXPECT_EQ(textOf(folder / "locked.exr"), "old");
    fs::permissions(folder / "locked", fs::perms::owner_all);
}

TEST_F(Outputs, unknownExtensions_areFoundBeforeRendering)
{
    for (const char* name : {"a.jpg", "a", ".exr", "a.exr.bak", ""}) {
        expectRefusedEarly(name, 2,
                           "the name must end in .exr, .pfm (linear) or .png (tone mapped)");
    }
}

TEST_F(Outputs, oneBadOutput_keepsTheOthersFromBeingRendered)
{
    expectRefused(render({"-o", "good.exr", "-o", "missing/a.exr"}), 4, "missing/a.exr");
    expectRefused(render({"-o", "good.exr", "--stats", "missing/a.json"}), 4, "missing/a.json");
    EXPECT_EQ(files(), Names{});
}

TEST_F(Outputs, extensionsInCapitals_areKnown)
{
    EXPECT_EQ(render({"-o", "A.EXR", "-o", "B.Png"}).exitCode, 0);
    EXPECT_EQ(textOf(folder / "A.EXR").substr(0, 4), "\x76\x2f\x31\x01");
}

TEST_F(Outputs, diskThatIsFull_keepsTheOldFileAndSavesThePictureElsewhere)
{
    fs::create_directory(folder / "elsewhere");
    fs::create_symlink("/dev/full", folder / "a.exr");
    RunOptions options = here();
    options.environment["TMPDIR"] = folder / "elsewhere";
    RunResult result = render({"-o", "a.exr"}, options);
    EXPECT_EQ(result.exitCode, 4);
    EXPECT_EQ(result.out, "");
    EXPECT_HAS(result.err,
               "a.exr: cannot write: No space left on device; the picture was saved as " +
                   (folder / "elsewhere").string());
    ASSERT_NE(fs::directory_iterator(folder / "elsewhere"), fs::directory_iterator());
    fs::path rescued = fs::directory_iterator(folder / "elsewhere")->path();
    ASSERT_EQ(render({"-o", "b.exr"}).exitCode, 0);
    EXPECT_EQ(readImage(rescued).rgb, readImage(folder / "b.exr").rgb);
}

TEST_F(Outputs, oneFailedOutput_doesNotCostTheOthers)
{
    fs::create_symlink("/dev/full", folder / "a.exr");
    RunResult result = render({"-o", "a.exr", "-o", "b.exr"});
    EXPECT_EQ(result.exitCode, 4);
    EXPECT_TRUE(has(result.err, "a.exr: cannot write: No space left on device\n")) << result.err;
    EXPECT_EQ(readImage(folder / "b.exr").width, 16u);
}

TEST_F(Outputs, limitOfFileSize_isLikeAFullDisk)
{
    writeText(folder / "a.exr", "old");
    RunOptions options = here();
    options.largestFile = 600;
    RunResult result = render({"-o", "a.exr", "-q"}, options);
    EXPECT_EQ(result.exitCode, 4);
    EXPECT_EQ(result.err, "sahl: a.exr: cannot write: File too large\n");
    EXPECT_EQ(textOf(folder / "a.exr"), "old");
    EXPECT_EQ(files(), Names{"a.exr"});
}

TEST_F(Outputs, symbolicLink_staysAndItsFileIsReplaced)
{
    fs::create_directory(folder / "results");
    writeText(folder / "results/real.exr", "old");
    fs::create_symlink("results/real.exr", folder / "a.exr");
    ASSERT_EQ(render({"-o", "a.exr"}).exitCode, 0);
    EXPECT_TRUE(fs::is_symlink(folder / "a.exr"));
    EXPECT_EQ(readImage(folder / "results/real.exr").width, 16u);
}

TEST_F(Outputs, temporaryFilesOfAKilledRun_areNotInTheWay)
{
    for (int id = 1; id < 200; id++) {
        writeText(folder / ("a.exr." + std::to_string(id) + ".0.tmp"), "left");
    }
    EXPECT_EQ(render({"-o", "a.exr"}).exitCode, 0);
}

/// Sees what happens to the files of a folder, while it happens.
class Watch {
public:
    explicit Watch(const fs::path& folder) : fd_(::inotify_init1(IN_CLOEXEC))
    {
        ::inotify_add_watch(fd_, folder.c_str(),
                            IN_CREATE | IN_MODIFY | IN_CLOSE_WRITE | IN_MOVED_TO);
    }
    ~Watch() { ::close(fd_); }

    /// Waits for the `count`-th event of the kind `mask`. False when none comes for long.
    bool waitFor(uint32_t mask, int count)
    {
        alignas(inotify_event) char buffer[4096];
        pollfd events = {fd_, POLLIN, 0};
        while (::poll(&events, 1, 30'000) > 0) {
            ssize_t got = ::read(fd_, buffer, sizeof(buffer));
            for (ssize_t at = 0; at < got;) {
                auto* event = reinterpret_cast<const inotify_event*>(buffer + at);
                if ((event->mask & mask) != 0 && --count == 0) return true;
                at += static_cast<ssize_t>(sizeof(inotify_event) + event->len);
            }
        }
        return false;
    }

private:
    int fd_;
};

TEST_F(Outputs, killWhileSaving_leavesTheOldOrTheNewFile)
{
    ASSERT_EQ(render({"-o", "new.pfm", "--width", "300", "--height", "300", "--spp", "1"}).exitCode,
              0);
    std::string complete = textOf(folder / "new.pfm");
    // The first file that is created only tests whether one can be; the second is the picture.
    struct {
        uint32_t event;
        int count;
    } moments[] = {
        {IN_CREATE, 1}, {IN_CREATE, 2}, {IN_MODIFY, 1}, {IN_CLOSE_WRITE, 2}, {IN_MOVED_TO, 1}};
    for (const auto& moment : moments) {
        writeText(folder / "a.pfm", "old");
        Watch watch(folder);
        RunningProgram program(SAHL_PROGRAM,
                               {"render", "ball.json", "--device", "cpu", "-o", "a.pfm", "--width",
                                "300", "--height", "300", "--spp", "1"},
                               here());
        EXPECT_TRUE(watch.waitFor(moment.event, moment.count));
        program.signal(SIGKILL);
        program.finish();
        std::string left = textOf(folder / "a.pfm");
        EXPECT_TRUE(left == "old" || left == complete) << left.size() << " bytes";
    }
}

TEST_F(Outputs, twoProcessesWithOneOutput_leaveOneOfThePictures)
{
    ASSERT_EQ(render({"-o", "seed1.exr", "--seed", "1"}).exitCode, 0);
    ASSERT_EQ(render({"-o", "seed2.exr", "--seed", "2"}).exitCode, 0);
    Names before = files();
    for (int i = 0; i < 3; i++) {
        auto start = [&](const char* seed) {
            return std::make_unique<RunningProgram>(
                SAHL_PROGRAM,
                Arguments{"render", "ball.json", "--device", "cpu", "-o", "a.exr", "--seed", seed},
                here());
        };
        auto first = start("1");
        auto second = start("2");
        EXPECT_EQ(first->finish().exitCode, 0);
        EXPECT_EQ(second->finish().exitCode, 0);
        std::string left = textOf(folder / "a.exr");
        EXPECT_TRUE(left == textOf(folder / "seed1.exr") || left == textOf(folder / "seed2.exr"));
        fs::remove(folder / "a.exr");
        EXPECT_EQ(files(), before);
    }
}

}  // namespace
}  // namespace sahl::testing
