// The command line: chooses a subcommand, and turns every failure into a message and an exit code.

#include "app/commands.h"
#include "app/usage.h"
#include "sahl_version.h"
#include "util/error.h"
#include "util/interrupt.h"
#include "util/memory.h"
#include "util/messages.h"

#include <map>
#include <memory>
#include <new>
#include <sstream>

namespace sahl {

int interruptedExitCode()
{
    return 128 + interruptSignal();
}

namespace {

int usageFailure(const CLI::App& app, const CLI::ParseError& error)
{
    const CLI::App& command = activeCommand(app);
    std::string name = &command == &app ? "" : command.get_name() + " ";
    say("sahl: {}\ntry: sahl {}--help\n", usageMessage(app, error), name);
    // Exit codes of compare are those of idiff.
    return command.get_name() == "compare" ? 4 : static_cast<int>(ErrorKind::usage);
}

int run(int argc, char** argv)
{
    CLI::App app(
        "Sahl: a path tracer in GLSL compute for any Vulkan device, checked bit for bit against "
        "a CPU reference",
        "sahl");
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    app.set_version_flag("--version", "sahl " SAHL_VERSION, "the version");
    app.formatter(std::make_shared<HelpFormatter>());
    app.get_formatter()->label("Positionals", "Input");
    app.set_help_flag("-h,--help", "this text");
    app.footer(
        "sahl COMMAND --help tells a command's options. Of an option given twice the last one\n"
        "counts, unless it says that it is repeatable.\n\n"
        "Exit codes: 0 fine, 1 a check failed, 2 usage, 3 bad input, 4 cannot write, 5 no "
        "suitable\n"
        "device, 6 device lost or out of memory, 129, 130 or 143 interrupted, after saving;\n"
        "those of compare are its own.\n\n"
        "Examples:\n"
        "  sahl render scenes/default/default.json -o teapot.png -o teapot.exr\n"
        "  sahl verify                     # does this machine's driver compute the right bits?");
    std::map<std::string, Command> commands = {{"render", addRenderCommand(app)},
                                               {"tonemap", addTonemapCommand(app)},
                                               {"compare", addCompareCommand(app)},
                                               {"merge", addMergeCommand(app)},
                                               {"verify", addVerifyCommand(app)},
                                               {"bvh", addBvhCommand(app)},
                                               {"devices", addDevicesCommand(app)},
                                               {"bench", addBenchCommand(app)}};
    if (argc < 2) {
        say("usage: sahl render|tonemap|compare|merge|verify|bvh|devices|bench [options]\ntry: sahl --help\n");
        return static_cast<int>(ErrorKind::usage);
    }
    app.require_subcommand(1);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() != 0) return usageFailure(app, error);
        std::ostringstream text;  // of --help or --version
        app.exit(error, text, text);
        answerText(text.str());
        flushAnswers();
        return 0;
    }
    int exitCode = commands.at(app.get_subcommands().front()->get_name())();
    flushAnswers();
    return exitCode;
}

}  // namespace

}  // namespace sahl

int main(int argc, char** argv)
{
    sahl::openStandardStreams();
    sahl::watchInterrupts();
    sahl::returnLargeBlocks();
    try {
        return sahl::run(argc, argv);
    } catch (const sahl::Error& error) {
        sahl::say("sahl: {}\n", error.what());
        return static_cast<int>(error.kind);
    } catch (const std::bad_alloc&) {
        sahl::say("sahl: out of memory; try a smaller picture or scene\n");
        return static_cast<int>(sahl::ErrorKind::deviceLost);
    } catch (const std::exception& error) {
        sahl::say("sahl: {}\n", error.what());
        return static_cast<int>(sahl::ErrorKind::badInput);
    }
}
