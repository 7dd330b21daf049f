// The command line: chooses a subcommand, and turns every failure into a message and an exit code.

#include "app/commands.h"
#include "sahl_version.h"
#include "util/error.h"
#include "util/interrupt.h"

#include <fmt/format.h>

#include <map>
#include <new>

namespace sahl {

int interruptedExitCode() { return 128 + interruptSignal(); }

namespace {

const CLI::App& activeCommand(const CLI::App& app)
{
    auto chosen = app.get_subcommands();
    return chosen.empty() ? app : *chosen.front();
}

/// "; did you mean --spp?" for the first word that looks like a mistyped option or command.
std::string hintFor(const CLI::App& app)
{
    const CLI::App& command = activeCommand(app);
    std::vector<std::string> known;
    for (const CLI::Option* option : command.get_options()) {
        for (const auto& name : option->get_lnames()) known.push_back("--" + name);
    }
    if (&command == &app) {
        for (const CLI::App* sub : app.get_subcommands(nullptr)) known.push_back(sub->get_name());
    }
    for (const std::string& word : command.remaining(true)) {
        std::string near = suggestion(word.substr(0, word.find('=')), known);
        if (!near.empty()) return "; did you mean " + near + "?";
    }
    return "";
}

int usageFailure(const CLI::App& app, const CLI::ParseError& error)
{
    std::string name = activeCommand(app).get_name();
    std::string help = name.empty() || &activeCommand(app) == &app ? "sahl --help" : "sahl " + name + " --help";
    fmt::print(stderr, "sahl: {}{}\ntry: {}\n", error.what(), hintFor(app), help);
    return static_cast<int>(ErrorKind::usage);
}

int run(int argc, char** argv)
{
    CLI::App app("Sahl: a path tracer in GLSL compute for any Vulkan device, checked bit for bit against "
                 "a CPU reference",
                 "sahl");
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    app.set_version_flag("--version", "sahl " SAHL_VERSION);
    app.get_formatter()->column_width(34);
    app.footer("Exit codes: 0 fine, 1 a check failed, 2 usage, 3 bad input, 4 cannot write, 5 no suitable\n"
               "device, 6 device lost or out of memory, 130/143 interrupted after saving.\n\n"
               "Examples:\n"
               "  sahl render scenes/default/default.json -o teapot.png -o teapot.exr\n"
               "  sahl verify                     # does this machine's driver compute the right bits?");
    std::map<std::string, Command> commands = {{"render", addRenderCommand(app)},
                                               {"verify", addVerifyCommand(app)},
                                               {"devices", addDevicesCommand(app)}};
    if (argc < 2) {
        fmt::print(stderr, "usage: sahl render|verify|devices ...\ntry: sahl --help\n");
        return static_cast<int>(ErrorKind::usage);
    }
    app.require_subcommand(1);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() != 0) return usageFailure(app, error);
        app.exit(error);  // --help and --version, on stdout
        return std::fflush(stdout) == 0 ? 0 : static_cast<int>(ErrorKind::cannotWrite);
    }
    int exitCode = commands.at(app.get_subcommands().front()->get_name())();
    if (std::fflush(stdout) != 0) {
        throw Error(ErrorKind::cannotWrite, "stdout: cannot write");
    }
    return exitCode;
}

}  // namespace

}  // namespace sahl

int main(int argc, char** argv)
{
    sahl::watchInterrupts();
    try {
        return sahl::run(argc, argv);
    } catch (const sahl::Error& error) {
        fmt::print(stderr, "sahl: {}\n", error.what());
        return static_cast<int>(error.kind);
    } catch (const std::bad_alloc&) {
        fmt::print(stderr, "sahl: out of memory; try a smaller picture or scene\n");
        return static_cast<int>(sahl::ErrorKind::deviceLost);
    } catch (const std::exception& error) {
        fmt::print(stderr, "sahl: {}\n", error.what());
        return static_cast<int>(sahl::ErrorKind::badInput);
    }
}
