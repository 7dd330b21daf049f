// What can happen to work in a child process, and what the parent hears of it.
#include "image/isolated.h"

#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <new>
#include <stdexcept>
#include <vector>

namespace sahl {
namespace {

const IsolatedLimits LIMITS = {1, uint64_t{64} << 20};

TEST(Isolated, runIsolated_handsBackSharedMemory)
{
    SharedMemory memory(1000);
    EXPECT_EQ(runIsolated(LIMITS, [&] { memory.bytes()[999] = 42; }), "");
    EXPECT_EQ(memory.bytes()[999], 42);
    EXPECT_EQ(memory.bytes()[0], 0);
}

TEST(Isolated, runIsolated_changesNothingElse)
{
    int value = 1;
    EXPECT_EQ(runIsolated(LIMITS, [&] { value = 2; }), "");
    EXPECT_EQ(value, 1);
}

TEST(Isolated, runIsolated_reportsExceptions)
{
    EXPECT_EQ(runIsolated(LIMITS, [] { throw std::runtime_error("bad\nblock"); }), "bad?block");
    EXPECT_EQ(runIsolated(LIMITS, [] { throw 5; }), "the decoder failed");
}

TEST(Isolated, runIsolated_reportsCrashes)
{
    for (int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) {
        const std::string text = runIsolated(LIMITS, [signal] { ::raise(signal); });
        EXPECT_NE(text.find("crashed"), std::string::npos) << text;
    }
}

TEST(Isolated, runIsolated_endsWorkThatNeverEnds)
{
    const std::string text = runIsolated(LIMITS, [] {
        const volatile bool forever = true;
        while (forever) {
        }
    });
    EXPECT_NE(text.find("stopped after 1 s"), std::string::npos) << text;
}

TEST(Isolated, runIsolated_endsWorkThatTakesTooMuchMemory)
{
    const std::string text = runIsolated(LIMITS, [] {
        std::vector<std::vector<char>> all;
        for (int i = 0; i < 1000; i++) all.emplace_back(size_t{1} << 20, 'x');
    });
    EXPECT_NE(text, "");
}

TEST(Isolated, runIsolated_keepsFilesAndNetworkOutOfReach)
{
    SharedMemory memory(2);
    EXPECT_EQ(runIsolated(LIMITS,
                          [&] {
                              memory.bytes()[0] = ::open("/etc/passwd", O_RDONLY) >= 0;
                              memory.bytes()[1] = ::socket(AF_INET, SOCK_STREAM, 0) >= 0;
                          }),
              "");
    EXPECT_EQ(memory.bytes()[0], 0);
    EXPECT_EQ(memory.bytes()[1], 0);
}

}  // namespace
}  // namespace sahl
