// The subcommands of `sahl`. Each add function declares its options; the returned function runs the
// command and gives the exit code.
#pragma once

#include <CLI/CLI.hpp>

#include <functional>

namespace sahl {

using Command = std::function<int()>;

Command addRenderCommand(CLI::App& app);
Command addTonemapCommand(CLI::App& app);
Command addCompareCommand(CLI::App& app);
Command addMergeCommand(CLI::App& app);
Command addVerifyCommand(CLI::App& app);
Command addBvhCommand(CLI::App& app);
Command addDevicesCommand(CLI::App& app);
Command addBenchCommand(CLI::App& app);

/// Exit code after a signal stopped the work and what was there has been saved.
int interruptedExitCode();

}  // namespace sahl
