#include "app/stop_options.h"

#include "app/option_kinds.h"

namespace sahl {

void addStopOptions(CLI::App& command, StopOptions& options)
{
    addNumber(command, "--passes", options.passes, {1, 1 << 21},
              "stop after so many passes of 8 samples", "all")
        ->group("Picture");
    auto setLimit = [&options](const std::string& text) {
        options.timeLimit = parseReal("--time-limit", text, 0, 1e9);
    };
    command
        .add_option_function<std::string>(
            "--time-limit", setLimit,
            withDefault("begin no pass after that; the file says how many there\n"
                        "were, and --passes makes the same picture again",
                        "none"))
        ->type_name("SECONDS")
        ->group("Picture");
}

void applyStopOptions(const StopOptions& options, RenderPlan& plan)
{
    plan.maxPasses = options.passes.value_or(0);
    // A limit of 0 stops after the first pass; in the plan 0 would be no limit.
    if (options.timeLimit) plan.timeLimit = std::max(*options.timeLimit, 1e-9);
}

std::string stopSummary(const RenderResult& result)
{
    if (result.stoppedBy == StoppedBy::nothing) return "";
    const char* why = result.stoppedBy == StoppedBy::time ? "the time limit" : "--passes";
    return fmt::format("stopped by {} after {} passes; --passes {} makes the same picture again",
                       why, result.passes, result.passes);
}

ImageMetadata stopMetadata(const RenderResult& result)
{
    const char* what = result.stoppedBy == StoppedBy::time     ? "time"
                       : result.stoppedBy == StoppedBy::passes ? "passes"
                                                               : "no";
    return {{"sahl.stopped", what}};
}

}  // namespace sahl
