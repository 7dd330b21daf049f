// Progress on stderr: a bar on a terminal, a plain line every 10 seconds elsewhere.
#pragma once

#include "render/render.h"

#include <string>

namespace sahl {

class ProgressPrinter {
public:
    /// mode: "auto" (a bar where stderr is a terminal that can redraw a line), "bar", "plain",
    /// "none".
    ProgressPrinter(const std::string& mode, bool quiet, uint32_t samplesPerPixel);

    void update(const RenderProgress& progress);

    /// Ends the bar's line.
    void finish();

private:
    enum class Mode { none, plain, bar };
    Mode mode_;
    uint32_t samplesPerPixel_;
    double lastSeconds_ = 0;
    bool barShown_ = false;
};

}  // namespace sahl
