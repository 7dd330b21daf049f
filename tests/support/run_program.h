// Runs a program as a user would: with arguments, an environment, a working folder, a terminal or
// not, limits; and gives back what it said and how it ended.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace sahl::testing {

struct RunOptions {
    enum class Stream { captured, closed, full, terminal };

    /// Added to ours; a variable without a value is taken out.
    std::map<std::string, std::optional<std::string>> environment;
    std::filesystem::path folder;  ///< to run in; ours when empty
    Stream standardOutput = Stream::captured;
    Stream standardError = Stream::captured;
    std::optional<uint64_t> largestFile;   ///< [bytes]
    std::optional<uint64_t> addressSpace;  ///< [bytes]
    bool obeysPermissions = false;         ///< also when we are root, who need not
    double timeLimit = 60;                 ///< [s]; then the program is killed
};

struct RunResult {
    int exitCode = -1;  ///< -1 when a signal ended the program
    int killedBy = 0;   ///< that signal
    bool timedOut = false;
    std::string out, err;  ///< all that came on stdout and stderr
    double seconds = 0;    ///< from start to end
};

/// A program under way. Ended and waited for by the destructor at the latest.
class RunningProgram {
public:
    RunningProgram(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                   const RunOptions& options = {});
    ~RunningProgram();
    RunningProgram(const RunningProgram&) = delete;
    RunningProgram& operator=(const RunningProgram&) = delete;

    /// Waits until stderr has shown something that `accepted` takes. False when the program ends or
    /// its time is over before.
    bool waitForError(const std::function<bool(const std::string& text)>& accepted);

    /// Waits until the program handles a signal itself. False when it ends before.
    bool waitForHandler(int number);

    void signal(int number);
    bool ended() { return !pump(0); }

    /// Waits for the end.
    RunResult finish();

private:
    bool pump(int milliseconds);

    pid_t child_ = -1;
    int out_ = -1, err_ = -1;  // our ends of the pipes or of the terminal
    RunResult result_;
    double started_ = 0, timeLimit_ = 0;  // [s]
    bool waited_ = false;
};

RunResult runProgram(const std::filesystem::path& program,
                     const std::vector<std::string>& arguments, const RunOptions& options = {});

}  // namespace sahl::testing
