// sahl render: from a scene file to pictures.

#include "app/commands.h"
#include "app/options.h"
#include "app/outputs.h"
#include "app/progress.h"
#include "app/stats.h"
#include "render/prepare.h"
#include "render/render.h"
#include "sahl_version.h"
#include "util/error.h"
#include "util/interrupt.h"

#include <memory>

namespace sahl {

namespace {

struct RenderOptions {
    CommonOptions common;
    OutputOptions output;
    std::string statsPath;
};

void addOutputOptions(CLI::App& command, RenderOptions& options)
{
    command.add_option("-o,--output", options.output.paths,
                       "picture to write: .exr or .pfm (linear), .png (tone mapped); may be repeated; "
                       "default SCENE.exr and SCENE.png here")
        ->type_name("FILE")->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->group("Output");
    static const std::map<std::string, ToneMap> operators = {
        {"percentile", ToneMap::percentile}, {"naive", ToneMap::naive}, {"srgb", ToneMap::srgb}};
    command.add_option("--tone-map", options.output.toneMap,
                       "percentile (5-95), naive (min-max) or srgb (exposure, sRGB)")
        ->transform(CLI::CheckedTransformer(operators))->type_name("NAME")->group("Output");
    command.add_option("--exposure", options.output.exposure, "for --tone-map srgb [stops]")
        ->check(CLI::Range(-100.0, 100.0))->type_name("X")->group("Output");
    command.add_option("--stats", options.statsPath, "write statistics as JSON (docs/stats.md)")
        ->type_name("FILE")->group("Output");
}

void chooseDefaultOutputs(RenderOptions& options)
{
    if (!options.output.paths.empty()) return;
    fs::path stem = fs::path(options.common.scenePath).stem();
    if (stem.empty()) throw usageError("name an output with -o");
    options.output.paths = {stem.string() + ".exr", stem.string() + ".png"};
}

void checkStatsPath(const RenderOptions& options)
{
    if (options.statsPath.empty()) return;
    std::error_code ignored;
    if (fs::equivalent(options.statsPath, options.common.scenePath, ignored)) {
        throw usageError("{}: is an input; writing it would destroy it", options.statsPath);
    }
    requireWritable(options.statsPath);
}

ImageMetadata metadataOf(const Scene& scene, const RenderResult& result, uint32_t samplesTaken,
                         const Device& device)
{
    DeviceInfo info = device.info();
    return {{"sahl.version", SAHL_VERSION},
            {"sahl.scene", fs::path(scene.name).filename().string()},
            {"sahl.integrator", "path"},
            {"sahl.sampler", "independent"},
            {"sahl.varianceOver", "samples"},
            {"sahl.seed", std::to_string(scene.settings.seed)},
            {"sahl.maxBounces", std::to_string(scene.settings.maxBounces)},
            {"sahl.firstSample", "0"},
            {"sahl.sampleCount", std::to_string(samplesTaken)},
            {"sahl.passes", std::to_string(result.passes)},
            {"sahl.interrupted", result.interrupted ? "yes" : "no"},
            {"sahl.device", info.name},
            {"sahl.driver", info.driver}};
}

void printSummary(const RenderOptions& options, const PreparedScene& prepared, const RenderResult& result)
{
    if (options.common.quiet) return;
    const Counters& counters = result.film.counters;
    uint64_t rays = counters.cameraRays + counters.indirectRays + counters.shadowRays;
    fmt::print(stderr, "{} triangles, {} samples, {} rays in {:.1f} s ({:.2f} Msamples/s, {:.2f} Mrays/s)\n",
               prepared.bvh.primitives.size(), counters.cameraRays, rays, result.seconds,
               double(counters.cameraRays) / std::max(result.seconds, 1e-9) * 1e-6,
               double(rays) / std::max(result.seconds, 1e-9) * 1e-6);
    if (counters.badSamples > 0) {
        warn(fmt::format("{} samples were negative or not finite and count as black", counters.badSamples));
    }
}

/// What the tree looks like and how the device was used, under --verbose.
void printDetails(const PreparedScene& prepared, const Device& device)
{
    const BvhStatistics& tree = prepared.bvh.statistics;
    DeviceStatistics work = device.statistics();
    fmt::print(stderr, "tree: {} inner nodes, {} leaves, depth {}, SAH cost {:.2f}, {:.2f} s\n", tree.innerNodes,
               tree.leaves, tree.depth, tree.sahCost, tree.seconds);
    fmt::print(stderr, "device work: {} bytes of scene, {} dispatches, {} resumptions, {} retries, {} steps each\n",
               work.sceneBytes, work.dispatches, work.resumptions, work.retries, work.stepBudget);
}

int runRender(RenderOptions& options)
{
    setQuiet(options.common.quiet);
    chooseDefaultOutputs(options);
    std::vector<fs::path> inputs = {options.common.scenePath};
    if (options.common.scene.probe) inputs.push_back(*options.common.scene.probe);
    checkOutputs(options.output.paths, inputs);
    checkStatsPath(options);

    Stopwatch watch;
    StageSeconds seconds;
    Scene scene = loadSceneFor(options.common);
    seconds.load = watch.lap();
    PreparedScene prepared = prepareScene(std::move(scene), options.common.bvhBuild, threadsFor(options.common));
    seconds.build = watch.lap();
    std::unique_ptr<Device> device = openDeviceFor(options.common);
    device->setScene(prepared.deviceScene());
    seconds.upload = watch.lap();

    const RenderSettings& settings = prepared.scene.settings;
    ProgressPrinter printer(options.common.progress, options.common.quiet, settings.spp);
    RenderPlan plan = {settings.width, settings.height, 0, settings.spp, options.common.tileSize};
    RenderResult result =
        renderPicture(*device, plan, [&](const RenderProgress& progress) { printer.update(progress); });
    printer.finish();
    seconds.render = watch.lap();

    uint32_t samplesTaken = std::min(settings.spp, result.passes * BLOCK_SIZE);
    writeOutputs(result.film, options.output, metadataOf(prepared.scene, result, samplesTaken, *device));
    seconds.write = watch.lap();
    seconds.total = watch.total();
    if (!options.statsPath.empty()) {
        auto statistics = statisticsJson(prepared, result.film, *device, seconds);
        writeFileAtomically(options.statsPath, statistics.dump(2) + "\n");
    }

    printSummary(options, prepared, result);
    if (options.common.verbose) printDetails(prepared, *device);
    for (const fs::path& path : options.output.paths) fmt::print("{}\n", path.string());
    if (!result.interrupted) return 0;
    fmt::print(stderr, "sahl: interrupted; saved {} of {} samples per pixel\n", samplesTaken, settings.spp);
    return interruptedExitCode();
}

}  // namespace

Command addRenderCommand(CLI::App& app)
{
    auto options = std::make_shared<RenderOptions>();
    CLI::App* command = app.add_subcommand("render", "render a scene into pictures");
    command->add_option("scene", options->common.scenePath, "scene (.json) or mesh (.obj)")
        ->required()->type_name("SCENE");
    addOutputOptions(*command, *options);
    addSceneOptions(*command, options->common);
    addDeviceOptions(*command, options->common);
    addMessageOptions(*command, options->common);
    command->footer("Examples:\n"
                    "  sahl render scenes/default/default.json -o teapot.png\n"
                    "  sahl render bunny.obj --probe uffizi.hdr --spp 256 --device cpu");
    return [options] { return runRender(*options); };
}

}  // namespace sahl
