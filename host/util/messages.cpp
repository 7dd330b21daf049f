#include "util/messages.h"

#include "util/error.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace sahl {

namespace {

Error stdoutFailure()
{
    return Error(ErrorKind::cannotWrite,
                 fmt::format("stdout: cannot write: {}", std::strerror(errno)));
}

}  // namespace

void openStandardStreams()
{
    for (int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::fcntl(descriptor, F_GETFD) != -1) continue;
        // The lowest free number is taken, which is this one.
        int opened = ::open("/dev/null", descriptor == STDERR_FILENO ? O_WRONLY : O_RDONLY);
        if (opened < 0) _exit(static_cast<int>(ErrorKind::cannotWrite));
    }
}

void sayText(const std::string& text)
{
    std::fputs(text.c_str(), stderr);
}

void answerText(const std::string& text)
{
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) throw stdoutFailure();
}

void flushAnswers()
{
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) throw stdoutFailure();
}

}  // namespace sahl
