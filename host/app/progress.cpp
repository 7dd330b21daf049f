#include "app/progress.h"

#include "util/messages.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace sahl {

namespace {

constexpr double BAR_INTERVAL = 0.1;   // seconds between two drawings
constexpr double PLAIN_INTERVAL = 10;  // seconds between two lines

bool terminalRedraws()
{
    const char* term = std::getenv("TERM");
    return ::isatty(STDERR_FILENO) != 0 && term != nullptr && std::strcmp(term, "dumb") != 0;
}

int terminalWidth()
{
    winsize size = {};
    if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col < 20) return 80;
    return size.ws_col;
}

std::string duration(double seconds)
{
    auto whole = static_cast<int64_t>(seconds + 0.5);
    if (whole < 60) return fmt::format("{} s", whole);
    if (whole < 3600) return fmt::format("{}:{:02} min", whole / 60, whole % 60);
    return fmt::format("{}:{:02} h", whole / 3600, whole / 60 % 60);
}

std::string describe(const RenderProgress& p, uint32_t samplesPerPixel)
{
    std::string speed = p.rays > 0 ? fmt::format("  {:.2f} Mrays/s",
                                                 double(p.rays) / std::max(p.seconds, 1e-9) * 1e-6)
                                   : "";
    double left = p.fraction > 0 ? p.seconds / p.fraction - p.seconds : 0;
    const double relativeError = p.relativeError ? p.relativeError() : 0;
    std::string error = relativeError > 0 ? fmt::format("  error {:.2g} %", 100 * relativeError) : "";
    return fmt::format("{:3.0f} %  {}/{} spp{}{}  {} left", 100 * p.fraction, p.samplesDone,
                       samplesPerPixel, speed, error, duration(left));
}

}  // namespace

ProgressPrinter::ProgressPrinter(const std::string& mode, bool quiet, uint32_t samplesPerPixel)
    : samplesPerPixel_(samplesPerPixel)
{
    if (quiet || mode == "none") {
        mode_ = Mode::none;
    } else if (mode == "bar" || (mode == "auto" && terminalRedraws())) {
        mode_ = Mode::bar;
    } else {
        mode_ = Mode::plain;
    }
}

void ProgressPrinter::update(const RenderProgress& progress)
{
    double interval = mode_ == Mode::bar ? BAR_INTERVAL : PLAIN_INTERVAL;
    if (mode_ == Mode::none || progress.seconds - lastSeconds_ < interval) return;
    lastSeconds_ = progress.seconds;
    std::string text = describe(progress, samplesPerPixel_);
    if (mode_ == Mode::plain) {
        say("{}\n", text);
        return;
    }
    int room = terminalWidth() - static_cast<int>(text.size()) - 4;
    std::string bar;
    if (room >= 8) {
        int filled = static_cast<int>(progress.fraction * room);
        bar = fmt::format("[{:<{}}] ", std::string(filled, '#'), room);
    }
    say("\r{}{}\x1b[K", bar, text);
    barShown_ = true;
}

void ProgressPrinter::finish()
{
    if (barShown_) say("\r\x1b[K");
    barShown_ = false;
}

}  // namespace sahl
