#include "support/run_program.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <utility>

#include <fcntl.h>
#include <linux/capability.h>
#include <poll.h>
#include <pty.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace sahl::testing {

namespace {

using Stream = RunOptions::Stream;

double now()
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

/// The two ends of a stream of the child: `ours` to read from, `theirs` to write to; -1 for none.
struct Ends {
    int ours = -1, theirs = -1;
};

Ends openStream(Stream kind)
{
    Ends ends;
    if (kind == Stream::captured) {
        int pipe[2];
        if (::pipe2(pipe, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
        ends = {pipe[0], pipe[1]};
    } else if (kind == Stream::terminal) {
        winsize size = {24, 80, 0, 0};
        if (::openpty(&ends.ours, &ends.theirs, nullptr, nullptr, &size) != 0) {
            throw std::runtime_error("no terminal");
        }
        ::fcntl(ends.ours, F_SETFD, FD_CLOEXEC);
        ::fcntl(ends.theirs, F_SETFD, FD_CLOEXEC);
    } else if (kind == Stream::full) {
        ends.theirs = ::open("/dev/full", O_WRONLY | O_CLOEXEC);
    }
    return ends;
}

void connect(int descriptor, const Ends& ends)
{
    if (ends.theirs >= 0) {
        ::dup2(ends.theirs, descriptor);
    } else {
        ::close(descriptor);
    }
}

void limit(decltype(RLIMIT_AS) resource, const std::optional<uint64_t>& value)
{
    if (!value) return;
    rlimit both = {*value, *value};
    ::setrlimit(resource, &both);
}

/// In the child, up to the program itself.
[[noreturn]] void become(const std::filesystem::path& program,
                         const std::vector<std::string>& arguments, const RunOptions& options,
                         const Ends& out, const Ends& err)
{
    int nothing = ::open("/dev/null", O_RDONLY);
    ::dup2(nothing, STDIN_FILENO);
    ::close(nothing);
    if (!options.folder.empty() && ::chdir(options.folder.c_str()) != 0) ::_exit(125);
    for (const auto& [name, value] : options.environment) {
        if (value) {
            ::setenv(name.c_str(), value->c_str(), 1);
        } else {
            ::unsetenv(name.c_str());
        }
    }
    std::vector<char*> words = {const_cast<char*>(program.c_str())};
    for (const std::string& argument : arguments) {
        words.push_back(const_cast<char*>(argument.c_str()));
    }
    words.push_back(nullptr);
    limit(RLIMIT_FSIZE, options.largestFile);
    limit(RLIMIT_AS, options.addressSpace);
    connect(STDOUT_FILENO, out);
    connect(STDERR_FILENO, err);
    if (options.obeysPermissions) {  // fails, and is not needed, where we are not root
        ::prctl(PR_CAPBSET_DROP, CAP_DAC_OVERRIDE);
        ::prctl(PR_CAPBSET_DROP, CAP_DAC_READ_SEARCH);
    }
    ::execv(program.c_str(), words.data());
    ::_exit(126);
}

/// Reads what there is. False at the end of the stream.
bool drain(int fd, std::string& text)
{
    char buffer[4096];
    ssize_t got = ::read(fd, buffer, sizeof(buffer));
    if (got > 0) text.append(buffer, static_cast<size_t>(got));
    return got > 0 || (got < 0 && errno == EINTR);  // a terminal ends with EIO
}

}  // namespace

RunningProgram::RunningProgram(const std::filesystem::path& program,
                               const std::vector<std::string>& arguments, const RunOptions& options)
    : started_(now()), timeLimit_(options.timeLimit)
{
    Ends out = openStream(options.standardOutput);
    Ends err = openStream(options.standardError);
    child_ = ::fork();
    if (child_ < 0) throw std::runtime_error("cannot fork");
    if (child_ == 0) become(program, arguments, options, out, err);
    if (out.theirs >= 0) ::close(out.theirs);
    if (err.theirs >= 0) ::close(err.theirs);
    out_ = out.ours;
    err_ = err.ours;
}

RunningProgram::~RunningProgram()
{
    if (!waited_) {
        signal(SIGKILL);
        finish();
    }
}

bool RunningProgram::pump(int milliseconds)
{
    if (waited_) return false;
    pollfd streams[2] = {{out_, POLLIN, 0}, {err_, POLLIN, 0}};  // poll passes over -1
    if (::poll(streams, 2, milliseconds) > 0) {
        if (streams[0].revents != 0 && !drain(out_, result_.out)) ::close(std::exchange(out_, -1));
        if (streams[1].revents != 0 && !drain(err_, result_.err)) ::close(std::exchange(err_, -1));
    }
    if (!result_.timedOut && now() - started_ > timeLimit_) {
        result_.timedOut = true;
        signal(SIGKILL);
    }
    if (out_ >= 0 || err_ >= 0) return true;
    int status = 0;
    if (::waitpid(child_, &status, WNOHANG) != child_) {
        ::usleep(1000);
        return true;
    }
    waited_ = true;
    result_.seconds = now() - started_;
    if (WIFEXITED(status)) result_.exitCode = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) result_.killedBy = WTERMSIG(status);
    return false;
}

bool RunningProgram::waitForError(const std::function<bool(const std::string&)>& accepted)
{
    while (!accepted(result_.err)) {
        if (!pump(20)) return accepted(result_.err);
    }
    return true;
}

bool RunningProgram::waitForHandler(int number)
{
    while (pump(5)) {
        std::ifstream status("/proc/" + std::to_string(child_) + "/status");
        for (std::string line; std::getline(status, line);) {
            if (!line.starts_with("SigCgt:")) continue;
            uint64_t caught = std::stoull(line.substr(7), nullptr, 16);
            if ((caught >> (number - 1) & 1) != 0) return true;
        }
    }
    return false;
}

void RunningProgram::signal(int number)
{
    if (!waited_) ::kill(child_, number);
}

RunResult RunningProgram::finish()
{
    while (pump(20)) {
    }
    return result_;
}

RunResult runProgram(const std::filesystem::path& program,
                     const std::vector<std::string>& arguments, const RunOptions& options)
{
    RunningProgram running(program, arguments, options);
    return running.finish();
}

}  // namespace sahl::testing
