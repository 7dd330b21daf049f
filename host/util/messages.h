// What the program says: messages on stderr, results on stdout.
#pragma once

#include <fmt/format.h>

#include <string>

namespace sahl {

/// Gives descriptors 0 to 2 a meaning where the parent closed them, so that no file that is opened
/// later gets their number and with it our messages: stdin and stderr become /dev/null, and writing
/// to stdout fails. To be called first of all.
void openStandardStreams();

void sayText(const std::string& text);
void answerText(const std::string& text);

/// Prints to stderr, at once. That nobody can read it is no error.
template <class... Args>
void say(fmt::format_string<Args...> text, Args&&... args)
{
    sayText(fmt::format(text, std::forward<Args>(args)...));
}

/// Prints results to stdout. Throws cannotWrite when that fails, at the latest in flushAnswers().
template <class... Args>
void answer(fmt::format_string<Args...> text, Args&&... args)
{
    answerText(fmt::format(text, std::forward<Args>(args)...));
}

void flushAnswers();

}  // namespace sahl
