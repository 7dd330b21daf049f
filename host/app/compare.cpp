// sahl compare: how far apart two pictures are, and whether noise explains it.

#include "compare/compare.h"
#include "app/commands.h"
#include "app/compare_output.h"
#include "app/option_kinds.h"
#include "compare/gates.h"
#include "compare/report.h"
#include "util/error.h"
#include "util/files.h"
#include "util/messages.h"
#include "util/parallel.h"

#include <memory>
#include <new>

namespace sahl {

namespace {

// As of idiff; those of other commands are in util/error.h.
constexpr int EXIT_SIZE = 3;
constexpr int EXIT_UNUSABLE = 4;

struct CompareCommand {
    fs::path a, b;
    CompareOptions options;
    Gates gates;
    fs::path report;
    bool json = false;
    bool quiet = false;
};

void requireVariances(const LoadedPicture& a, const LoadedPicture& b)
{
    for (const LoadedPicture* picture : {&a, &b}) {
        if (!picture->variance.empty()) continue;
        throw usageError(
            "--equivalent needs the variance of both pictures; {} has no layer variance.Y: "
            "compare the .exr files that sahl render writes",
            picture->name);
    }
}

/// Before anything is read, so that a bad path costs nothing.
void checkReportPath(const CompareCommand& command)
{
    if (command.report.empty()) return;
    if (command.report.extension() != ".html") {
        throw usageError("--report {}: the page is a .html file", command.report.string());
    }
    requireWritable(command.report);
}

/// With replacements for what is not UTF-8 in names of files.
std::string jsonText(const ComparedPictures& compared)
{
    return comparisonJson(compared).dump(2, ' ', false,
                                         nlohmann::ordered_json::error_handler_t::replace);
}

int compareFiles(CompareCommand& command)
{
    checkReportPath(command);
    const LoadedPicture a = loadPicture(command.a);
    const LoadedPicture b = loadPicture(command.b);
    if (a.image.width != b.image.width || a.image.height != b.image.height) {
        say("sahl: {} is {} x {} pixels, {} is {} x {}: only pictures of one size can be "
            "compared\n",
            a.name, a.image.width, a.image.height, b.name, b.image.width, b.image.height);
        return EXIT_SIZE;
    }
    if (command.gates.equivalent) {
        requireVariances(a, b);
        command.options.margin = command.options.tolerated = *command.gates.equivalent;
    }
    const Comparison comparison = compare(a, b, command.options);
    const std::vector<GateResult> gates = applyGates(command.gates, comparison);
    const ComparedPictures compared = {a, b, comparison, command.options, gates};
    if (!command.report.empty()) {
        writeFileAtomically(command.report, reportPage(jsonText(compared), a, b, comparison));
    }
    if (command.json) {
        answer("{}\n", jsonText(compared));
    } else if (!command.quiet) {
        printComparison(compared);
    }
    return exitCodeOf(comparison, gates);
}

int runCompare(CompareCommand& command)
{
    setQuiet(command.quiet);
    if (command.options.threads == 0) command.options.threads = defaultThreadCount();
    try {
        const int exitCode = compareFiles(command);
        flushAnswers();
        return exitCode;
    } catch (const Error& error) {
        say("sahl: {}\n", error.what());
    } catch (const std::bad_alloc&) {
        say("sahl: out of memory; try smaller pictures\n");
    }
    return EXIT_UNUSABLE;
}

/// --name X, a number from lo to hi.
template <class Target>
CLI::Option* addReal(CLI::App& command, const std::string& name, Target& target, double lo,
                     double hi, const std::string& help, const std::string& standard)
{
    auto set = [&target, name, lo, hi](const std::string& text) {
        target = parseReal(name, text, lo, hi);
    };
    const std::string text = fmt::format("{}, {:g} to {:g}", help, lo, hi);
    return command.add_option_function<std::string>(name, set, withDefault(text, standard))
        ->type_name("X");
}

void addGateOptions(CLI::App& command, Gates& gates)
{
    const std::string group = "Gates (where there are some, they alone decide the exit code)";
    addFlag(command, "--bitwise", gates.bitwise, "R, G and B have the same bits")->group(group);
    addReal(
        command, "--equivalent", gates.equivalent, 1e-9, 1,
        "the means agree within this share of the mean\nluminance, and no block differs by more",
        "none")
        ->group(group);
    addReal(command, "--max-flip", gates.maxFlip, 0, 1,
            "mean HDR-FLIP of linear pictures, else mean\nLDR-FLIP, is at most this", "none")
        ->group(group);
    addReal(command, "--max-relmse", gates.maxRelMse, 0, 1e30, "relMSE is at most this", "none")
        ->group(group);
}

}  // namespace

Command addCompareCommand(CLI::App& app)
{
    auto options = std::make_shared<CompareCommand>();
    options->options.threads = 0;
    CLI::App* command =
        app.add_subcommand("compare", "measure how two pictures differ, and whether "
                                      "noise explains it")
            ->group("Commands");
    command->add_option("a", options->a, "picture: .exr, .hdr, .pfm or .png")
        ->required()
        ->type_name("A");
    command->add_option("b", options->b, "reference, of the same size")->required()->type_name("B");
    addReal(*command, "--level", options->options.level, 1e-9, 0.5,
            "chance to call equal scenes different", "0.01")
        ->group("Test");
    addReal(*command, "--exposure", options->options.exposure, -100, 100,
            "of linear pictures, for PSNR, SSIM and LDR-FLIP\n[stops]", "0")
        ->group("Metrics");
    addReal(*command, "--ppd", options->options.pixelsPerDegree, 1, 1000,
            "FLIP: pixels per degree of the visual field", "67.02")
        ->group("Metrics");
    addGateOptions(*command, options->gates);
    command
        ->add_option(
            "--report", options->report,
            "page (.html) to look at both and their differences,\ncomplete without a network")
        ->type_name("FILE")
        ->group("Output");
    addFlag(*command, "--json", options->json, "everything as JSON on stdout")->group("Output");
    addNumber(*command, "--threads", options->options.threads, {1, 1024}, "threads", "all cores")
        ->group("Messages");
    addFlag(*command, "-q,--quiet", options->quiet, "only the exit code, and errors")
        ->group("Messages");
    command->footer(
        "Exit codes: 0 same or equivalent, 1 undecided, 2 different, 3 of different size, "
        "4 a file\nor the command line cannot be used. docs/compare.md says what they "
        "rest on.\n\nExamples:\n"
        "  sahl compare new.exr old.exr\n"
        "  sahl compare a.exr b.exr --equivalent 0.001 --json\n"
        "  sahl compare a.png b.png --max-flip 0.05");
    return [options] { return runCompare(*options); };
}

}  // namespace sahl
