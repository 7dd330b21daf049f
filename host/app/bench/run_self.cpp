#include "app/bench/run_self.h"

#include "util/error.h"

#include <fmt/ranges.h>

#include <cerrno>
#include <chrono>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace sahl {

namespace {

std::vector<char*> pointersTo(std::vector<std::string>& texts)
{
    std::vector<char*> pointers;
    for (std::string& text : texts) pointers.push_back(text.data());
    pointers.push_back(nullptr);
    return pointers;
}

/// Ours, with some variables replaced.
std::vector<std::string> environmentWith(const std::vector<std::pair<std::string, std::string>>& changes)
{
    std::vector<std::string> all;
    for (char** variable = environ; *variable != nullptr; variable++) {
        const std::string text = *variable;
        bool kept = true;
        for (const auto& [name, value] : changes) kept = kept && !text.starts_with(name + "=");
        if (kept) all.push_back(text);
    }
    for (const auto& [name, value] : changes) all.push_back(name + "=" + value);
    return all;
}

}  // namespace

double runSelf(const std::vector<std::string>& arguments,
               const std::vector<std::pair<std::string, std::string>>& environment)
{
    std::vector<std::string> texts = {"sahl"};
    texts.insert(texts.end(), arguments.begin(), arguments.end());
    std::vector<std::string> variables = environmentWith(environment);
    posix_spawn_file_actions_t streams;
    posix_spawn_file_actions_init(&streams);
    posix_spawn_file_actions_addopen(&streams, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    const auto start = std::chrono::steady_clock::now();
    pid_t child = 0;
    int status = posix_spawn(&child, "/proc/self/exe", &streams, nullptr, pointersTo(texts).data(),
                             pointersTo(variables).data());
    posix_spawn_file_actions_destroy(&streams);
    if (status == 0) {
        while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    if (status != 0)
        throw Error(ErrorKind::noDevice, fmt::format("'{}' failed; run it alone to see why", fmt::join(texts, " ")));
    return seconds.count();
}

}  // namespace sahl
