// --passes and --time-limit: pictures of fewer samples than the scene asks for.
#pragma once

#include "image/image.h"
#include "render/render.h"

#include <CLI/CLI.hpp>

#include <optional>

namespace sahl {

struct StopOptions {
    std::optional<uint32_t> passes;
    std::optional<double> timeLimit;  ///< [s]
};

/// Adds both, in the group "Picture".
void addStopOptions(CLI::App& command, StopOptions& options);

void applyStopOptions(const StopOptions& options, RenderPlan& plan);

/// A line for the summary of a run: what ended it before all samples were there, and what makes the
/// same picture again; empty where nothing did.
std::string stopSummary(const RenderResult& result);

/// "sahl.stopped": no, passes or time.
ImageMetadata stopMetadata(const RenderResult& result);

}  // namespace sahl
