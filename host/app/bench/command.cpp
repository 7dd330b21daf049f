// sahl bench: its options, and which benchmark runs.

#include "app/bench/bench.h"
#include "app/bench/rounds.h"
#include "app/commands.h"
#include "app/option_kinds.h"
#include "app/tree_options.h"
#include "sahl_version.h"
#include "util/error.h"
#include "util/interrupt.h"
#include "util/messages.h"

#include <memory>

namespace sahl {

using Json = nlohmann::ordered_json;

namespace {

struct Benchmark {
    const char* name;
    Json (*run)(const BenchOptions&);
};

constexpr Benchmark BENCHMARKS[] = {{"report", benchReport}, {"traversal", benchTraversal},
                                    {"render", benchRender}, {"build", benchBuild},
                                    {"start", benchStart},   {"scale", benchScale},
                                    {"ceiling", benchCeiling}};

const Benchmark& benchmarkCalled(const std::string& name)
{
    std::vector<std::string> names;
    for (const Benchmark& benchmark : BENCHMARKS) {
        if (name == benchmark.name) return benchmark;
        names.emplace_back(benchmark.name);
    }
    if (name.empty()) throw usageError("name a benchmark: {}", enumeration(names));
    throw usageError("benchmark '{}' is not known: {}", name, enumeration(names));
}

int runBench(const BenchOptions& options)
{
    setQuiet(options.common.quiet);
    const Benchmark& benchmark = benchmarkCalled(options.benchmark);
    const bool takesScenes =
        options.benchmark != "report" && options.benchmark != "scale" && options.benchmark != "ceiling";
    if (!takesScenes && !options.scenes.empty())
        throw usageError("sahl bench {} measures no scenes but its own, not '{}'", options.benchmark,
                         options.scenes.front());
    if (!options.plotPath.empty() && options.benchmark != "scale")
        throw usageError("--plot: there is a plot of sahl bench scale alone");
    if (!options.jsonPath.empty()) requireWritable(options.jsonPath);
    if (!options.plotPath.empty()) requireWritable(options.plotPath);

    Json json = {{"version", 1}, {"sahl", SAHL_VERSION}, {"benchmark", options.benchmark}};
    const double loadBefore = loadAverage();
    json.update(benchmark.run(options));
    json["load"] = {{"before", loadBefore}, {"after", loadAverage()}};
    if (interruptSignal() != 0) return interruptedExitCode();
    if (!options.jsonPath.empty())
        writeFileAtomically(fs::path(options.jsonPath), json.dump(2) + "\n");
    return 0;
}

}  // namespace

Command addBenchCommand(CLI::App& app)
{
    auto options = std::make_shared<BenchOptions>();
    CLI::App* command =
        app.add_subcommand("bench", "measure speed: rays, pictures, trees, starting")->group("Commands");
    command
        ->add_option("benchmark", options->benchmark,
                     "report: its figure 11; traversal: rays by kind; render: the common work;\n"
                     "build: trees, how long they take and how good they are; start: to the first\n"
                     "sample; scale: growth with triangles, threads, pixels, samples and bounces;\n"
                     "ceiling: what the device can do at most")
        ->type_name("NAME");
    command->add_option("scenes", options->scenes,
                        withDefault("meshes or scene files without instances", "two that are generated"))
        ->type_name("SCENE");
    command
        ->add_option("--assets", options->assets,
                     withDefault("report: folder of meshes", "$SAHL_ASSETS, then .assets"))
        ->type_name("DIR")
        ->group("Scene");
    addNumber(*command, "--triangles", options->triangles, {100, 50'000'000},
              "of a generated scene; scale: the most", "70000; scale: 10000000")
        ->group("Scene");
    addNumber(*command, "--size", options->size, {1, 8192}, "width and height [pixels]", "512")
        ->group("Picture");
    addNumber(*command, "--spp", options->spp, {1, 1 << 20}, "render: samples per pixel", "16")
        ->group("Picture");
    addNumber(*command, "--repeat", options->repeat, {1, 1000},
              "rounds; the median counts, of report the fastest", "5; report: 3")
        ->group("Picture");
    command
        ->add_option("--json", options->jsonPath,
                     withDefault("write the table as JSON (docs/bench.md)", "none"))
        ->type_name("FILE")
        ->group("Output");
    command->add_option("--plot", options->plotPath, withDefault("scale: write plots as PNG", "none"))
        ->type_name("FILE")
        ->group("Output");
    addFlag(*command, "--alone", options->alone,
            "traversal, render, scale: the device without the CPU and\nEmbree beside it")
        ->group("Device");
    addTreeOptions(*command, options->common);
    addDeviceOptions(*command, options->common);
    addMessageOptions(*command, options->common);
    command->footer("Examples:\n"
                    "  sahl bench report\n"
                    "  sahl bench traversal bunny.obj --device cpu --json bench.json");
    return [options] { return runBench(*options); };
}

}  // namespace sahl
