#include "util/interrupt.h"

#include <csignal>
#include <initializer_list>
#include <unistd.h>

namespace sahl {

namespace {

volatile std::sig_atomic_t arrived = 0;

void onSignal(int signal)
{
    if (arrived != 0) _exit(128 + signal);
    arrived = signal;
}

}  // namespace

void watchInterrupts()
{
    struct sigaction action = {};
    action.sa_handler = onSignal;
    sigemptyset(&action.sa_mask);
    for (int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);  // a file-size limit then shows as a failed write
}

int interruptSignal()
{
    return arrived;
}

}  // namespace sahl
