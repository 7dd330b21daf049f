// --partial: the picture so far, written now and then while it is rendered.
#pragma once

#include "render/render.h"

#include <CLI/CLI.hpp>

#include <chrono>
#include <optional>

namespace sahl {

/// --partial SECONDS, in the group "Output".
void addPartialOption(CLI::App& command, std::optional<double>& seconds);

class PartialPictures {
public:
    /// `write` writes a result of whole passes to the outputs. A failure is told once, as a
    /// warning: what it costs is known only when the picture is finished.
    PartialPictures(double seconds, std::function<void(const RenderResult&)> write);

    /// Whether the last time lies `seconds` back.
    bool isDue() const;

    /// Writes when the last time lies `seconds` back: since the end of writing, so that slow files
    /// do not take all the time.
    void passDone(const RenderResult& result);

private:
    using Clock = std::chrono::steady_clock;
    double seconds_;
    std::function<void(const RenderResult&)> write_;
    Clock::time_point last_ = Clock::now();
    bool warned_ = false;
};

}  // namespace sahl
