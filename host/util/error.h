// The one exception type of the host code: a text for the user and the exit code that goes with it.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace sahl {

/// What went wrong, as the process's exit code (README, "Exit codes").
enum class ErrorKind {
    checkFailed = 1,  ///< a comparison or verification found a difference
    usage = 2,        ///< the command line is wrong
    badInput = 3,     ///< a scene, mesh or image cannot be used
    cannotWrite = 4,  ///< an output cannot be written
    noDevice = 5,     ///< no suitable device, or it lacks something that is needed
    deviceLost = 6,   ///< the device was lost or ran out of memory
};

/// Thrown by every folder of host/. The text names the place, what was found and what would help.
class Error : public std::runtime_error {
public:
    Error(ErrorKind errorKind, const std::string& text) : std::runtime_error(text), kind(errorKind)
    {
    }
    ErrorKind kind;
};

/// throw badInput("{}:{}: face index {} is out of range", file, line, index);
template <class... Args>
Error badInput(fmt::format_string<Args...> text, Args&&... args)
{
    return Error(ErrorKind::badInput, fmt::format(text, std::forward<Args>(args)...));
}

template <class... Args>
Error usageError(fmt::format_string<Args...> text, Args&&... args)
{
    return Error(ErrorKind::usage, fmt::format(text, std::forward<Args>(args)...));
}

/// The candidate nearest to `word` by edit distance, or "" when none is near enough to suggest.
/// Shared by scene keys, material names and command-line options.
template <class Range>
std::string suggestion(const std::string& word, const Range& candidates);

/// Levenshtein distance between two short words.
size_t editDistance(const std::string& a, const std::string& b);

/// Prints "sahl: warning: ..." to stderr (not under --quiet) and counts it.
void warn(const std::string& text);
void setQuiet(bool quiet);
bool isQuiet();

template <class Range>
std::string suggestion(const std::string& word, const Range& candidates)
{
    std::string best;
    size_t bestDistance = word.size() / 3 + 2;  // further away is more likely another word
    for (const auto& candidate : candidates) {
        size_t distance = editDistance(word, std::string(candidate));
        if (distance < bestDistance) {
            bestDistance = distance;
            best = candidate;
        }
    }
    return best;
}

}  // namespace sahl
