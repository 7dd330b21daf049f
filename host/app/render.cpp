// sahl render: from a scene file to pictures.

#include "render/render.h"
#include "app/adaptive.h"
#include "app/commands.h"
#include "app/crop.h"
#include "app/map_options.h"
#include "app/option_kinds.h"
#include "app/options.h"
#include "app/outputs.h"
#include "app/partial.h"
#include "app/progress.h"
#include "app/sample_range.h"
#include "app/sampling_options.h"
#include "app/shading_options.h"
#include "app/skip_existing.h"
#include "app/stats.h"
#include "app/stop_options.h"
#include "film/fireflies.h"
#include "film/layers.h"
#include "film/replicates.h"
#include "render/outline.h"
#include "render/prepare.h"
#include "render/scene_hash.h"
#include "sahl_version.h"
#include "util/error.h"
#include "util/gzip.h"
#include "util/hash.h"
#include "util/interrupt.h"
#include "util/memory.h"
#include "util/messages.h"

#include <algorithm>
#include <memory>
#include <optional>

namespace sahl {

namespace {

struct RenderOptions {
    CommonOptions common;
    OutputOptions output;
    MapOptions maps;
    std::string statsPath;
    std::optional<CropWindow> crop;
    std::optional<double> partialSeconds;
    StopOptions stop;
    RangeOptions range;
    SampleRange samples;  ///< to render of every pixel; known with the scene, as are:
    SceneHashes hashes;
};

void addOutputOptions(CLI::App& command, RenderOptions& options)
{
    OutputOptions& output = options.output;
    command
        .add_option("-o,--output", output.paths,
                    withDefault("picture to write: .exr or .pfm (linear), .png (tone mapped);\n"
                                "repeatable",
                                "SCENE.exr and SCENE.png here"))
        ->type_name("FILE")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->group("Output");
    addToneOptions(command, "--tone-map", output.tone);
    addFlag(command, "--aovs", output.firstHits,
            "albedo, normals, depth, position and ids as layers of\nevery .exr (docs/exr.md)")
        ->group("Output");
    addPartialOption(command, options.partialSeconds);
    command
        .add_option("--stats", options.statsPath,
                    withDefault("write statistics as JSON (docs/stats.md)", "none"))
        ->type_name("FILE")
        ->group("Output");
}

void chooseDefaultOutputs(RenderOptions& options)
{
    if (!options.output.paths.empty()) return;
    fs::path stem = withoutGz(options.common.scenePath).stem();
    if (stem.empty()) throw usageError("name an output with -o");
    if (options.range.isPart()) {
        options.output.paths = {stem.string() + partSuffix(options.range) + ".exr"};
        return;
    }
    options.output.paths = {stem.string() + ".exr", stem.string() + ".png"};
}

/// Refuses outputs that cannot be written, before anything is read. Returns all of them.
std::vector<fs::path> checkOutputs(const RenderOptions& options)
{
    checkToneOptions(options.output.tone);
    checkMapOptions(options.maps);
    std::vector<fs::path> outputs = options.output.paths;
    checkRangeOptions(options.range, outputs);
    checkPicturePaths(outputs);
    for (const MapOptions::Request& map : options.maps.maps) {
        checkPngPath("--map", map.path, outputs);
        outputs.push_back(map.path);
    }
    if (!options.output.tone.histogram.empty()) {
        checkPngPath("--histogram", options.output.tone.histogram, outputs);
        outputs.push_back(options.output.tone.histogram);
    }
    if (options.statsPath.empty()) return outputs;
    if (std::find(outputs.begin(), outputs.end(), options.statsPath) != outputs.end()) {
        throw usageError("{}: is a picture to write; name another file for --stats",
                         options.statsPath);
    }
    requireWritable(options.statsPath);
    outputs.push_back(options.statsPath);
    return outputs;
}

/// What camera rays meet, as channels of the EXR. Made before the light, so that a picture that gets
/// interrupted has them too.
std::vector<ImageChannel> firstHitLayers(const RenderOptions& options, const PreparedScene& prepared,
                                         const RenderPlan& plan, Device& device)
{
    if (!options.output.firstHits && !needFirstHits(options.maps)) return {};
    // Of the whole picture, so that every part of it has the same.
    uint32_t samples = std::min(BLOCK_SIZE, mostSamples(prepared.scene.settings));
    return firstHitChannels(renderFirstHits(device, plan, samples), samples,
                            prepared.scene.objectStarts);
}

AdaptiveReport reportOf(const RenderSettings& settings, const RenderResult& result)
{
    return {settings.adaptive, result.adaptive, result.film.counters.cameraRays,
            filmError(result.film, settings.adaptive.targetError)};
}

/// What is rendered, whatever part of it.
ImageMetadata settingsMetadata(const Scene& scene, const SceneHashes& hashes)
{
    ImageMetadata metadata = describeShading(scene.settings);
    metadata.merge(describeSampling(scene.settings));
    metadata.merge(ImageMetadata{{"sahl.version", SAHL_VERSION},
                                 {"sahl.integrator", integratorName(scene.settings)},
                                 {"sahl.seed", std::to_string(scene.settings.seed)},
                                 {"sahl.maxBounces", std::to_string(scene.settings.maxBounces)},
                                 {"sahl.sceneHash", hashText(hashes.scene)},
                                 {"sahl.treeHash", hashText(hashes.tree)}});
    return metadata;
}

ImageMetadata metadataOf(const Scene& scene, const RenderResult& result, const SampleRange& taken,
                         const SceneHashes& hashes, const Device& device)
{
    DeviceInfo info = device.info();
    ImageMetadata metadata = settingsMetadata(scene, hashes);
    metadata.merge(ImageMetadata{{"sahl.scene", fs::path(scene.name).filename().string()},
                                 {"sahl.firstSample", std::to_string(taken.first)},
                                 {"sahl.sampleCount", std::to_string(taken.end - taken.first)},
                                 {"sahl.passes", std::to_string(result.passes)},
                                 {"sahl.interrupted", result.interrupted ? "yes" : "no"},
                                 {"sahl.device", info.name},
                                 {"sahl.driver", info.driver}});
    metadata.merge(stopMetadata(result));
    if (isAdaptive(scene.settings)) metadata.merge(adaptiveMetadata(reportOf(scene.settings, result)));
    return metadata;
}

/// The part of the range that so many whole passes have rendered.
SampleRange takenOf(const SampleRange& range, uint32_t passes)
{
    return {range.first, std::min(range.end, range.first + passes * BLOCK_SIZE)};
}

/// The file that this run would write, when nothing interrupts it.
ExpectedPart expectedPart(const RenderOptions& options, const Scene& scene, const RenderSettings& film)
{
    const ImagePlace all = {0, 0, film.width, film.height};
    return {settingsMetadata(scene, options.hashes),
            {{options.samples}, mostSamples(scene.settings)},
            film.width,
            film.height,
            options.output.place.value_or(all),
            options.output.firstHits};
}

/// Looks at --crop now that the size of the picture is known. Returns the size of the film.
RenderSettings applyCrop(RenderOptions& options, RenderSettings settings)
{
    const CropWindow window = clipCrop(options.crop, settings.width, settings.height);
    if (options.crop) {
        options.crop = window;
        options.output.place = {window.x, window.y, settings.width, settings.height};
    }
    settings.width = window.width;
    settings.height = window.height;
    return settings;
}

void printSummary(const RenderOptions& options, const PreparedScene& prepared,
                  const RenderResult& result)
{
    if (options.common.quiet) return;
    const Counters& counters = result.film.counters;
    uint64_t rays = counters.cameraRays + counters.indirectRays + counters.shadowRays;
    say("{} primitives, {} samples, {} rays in {:.1f} s ({:.2f} Msamples/s, {:.2f} Mrays/s)\n",
        prepared.deviceScene().primitives.size(), counters.cameraRays, rays, result.seconds,
        double(counters.cameraRays) / std::max(result.seconds, 1e-9) * 1e-6,
        double(rays) / std::max(result.seconds, 1e-9) * 1e-6);
    if (counters.badSamples > 0) {
        warn(fmt::format("{} samples were negative or not finite and count as black",
                         counters.badSamples));
    }
    const std::string clamped = clampSummary(prepared.scene.settings, counters);
    if (!clamped.empty()) say("{}\n", clamped);
}

/// Writes all but the statistics; of a picture that is not finished the outputs alone.
void writeAll(const RenderOptions& options, const Film& film, std::vector<ImageChannel> firstHits,
              const ImageMetadata& metadata, bool partial)
{
    std::vector<ImageChannel> channels = statisticsChannels(film);
    const size_t always = channels.size();
    std::move(firstHits.begin(), firstHits.end(), std::back_inserter(channels));
    std::span<const ImageChannel> layers = channels;
    if (!options.output.firstHits) layers = layers.first(always);  // the rest is for the maps
    if (partial) return writePartialOutputs(film, options.output, metadata, layers);
    writeOutputs(film, options.output, metadata, layers);
    if (needFireflies(options.maps)) channels.push_back(fireflyChannel(film, firefliesOf(film)));
    writeMaps(options.maps, channels, film.width, film.height, metadata);
    if (!options.output.tone.histogram.empty()) {
        writeHistogram(meanImage(film), options.output.tone, metadata);
    }
}

/// Writes the finished picture, or what there is of it after some of the passes.
void writePictures(const RenderOptions& options, const Scene& scene, const RenderResult& result,
                   const Device& device, std::vector<ImageChannel> firstHits, bool partial)
{
    const SampleRange taken = takenOf(options.samples, result.passes);
    ImageMetadata metadata = metadataOf(scene, result, taken, options.hashes, device);
    if (options.output.film)
        metadata.merge(filmMetadata(result.film, {{taken}, mostSamples(scene.settings)}));
    if (options.range.shard) metadata["sahl.shard"] = shardText(*options.range.shard);
    if (options.crop) metadata["sahl.crop"] = cropText(*options.crop);
    if (partial) metadata["sahl.partial"] = "yes";
    writeAll(options, result.film, std::move(firstHits), metadata, partial);
}

/// Renders all samples, or as many as the scene's rule wants, with progress and partial pictures.
RenderResult renderLight(const RenderOptions& options, const Scene& scene, const RenderPlan& plan,
                         const std::vector<ImageChannel>& firstHits, Device& device,
                         const std::function<void()>& onFirstSamples)
{
    ProgressPrinter printer(options.common.progress, options.common.quiet, plan.sampleCount);
    bool first = true;
    auto report = [&](const RenderProgress& progress) {
        if (first && progress.rays > 0) onFirstSamples();
        first = first && progress.rays == 0;
        printer.update(progress);
    };
    PartialPictures partial(options.partialSeconds.value_or(0), [&](const RenderResult& soFar) {
        RenderOptions shown = options;
        shown.output.film = options.output.film && !soFar.endsInReplicate;
        writePictures(shown, scene, soFar, device, firstHits, true);
    });
    RenderResult result;
    if (isAdaptive(scene.settings)) {
        result = renderAdaptive(device, plan, scene.settings.adaptive, report,
                                [&](const std::function<RenderResult()>& soFar) {
                                    if (options.partialSeconds && partial.isDue()) partial.passDone(soFar());
                                });
    } else {
        const auto keepPartial = [&](const RenderResult& soFar) { partial.passDone(soFar); };
        result = renderPicture(device, plan, report,
                               options.partialSeconds ? std::function<void(const RenderResult&)>(keepPartial) : nullptr);
    }
    printer.finish();
    return result;
}

/// Which part of the picture this is.
void sayRange(const RenderOptions& options)
{
    if (options.common.quiet) return;
    const std::optional<ArrayTask>& shard = options.range.shard;
    std::string part = shard ? "shard " + shardText(*shard) : "range";
    if (shard && !shard->variable.empty()) part += fmt::format(" (by {})", shard->variable);
    say("{}: samples {}\n", part, rangeText(options.samples));
}

/// What a signal left of the picture. Without a single sample no file is replaced.
void sayInterrupted(const RenderOptions& options, const RenderSettings& settings,
                    const RenderResult& result)
{
    if (options.common.quiet) return;
    if (result.film.counters.cameraRays == 0) {
        say("sahl: interrupted before the first sample; nothing is saved\n");
    } else if (result.passes == 0) {
        say("sahl: interrupted in the first pass; saving its finished tiles, the rest is black{}\n",
            options.range.wantsFilm() ? ", without a film to merge" : "");
    } else {
        say("sahl: interrupted; saving {}{} of {} samples per pixel\n", isAdaptive(settings) ? "up to " : "",
            result.passes * BLOCK_SIZE, options.samples.end - options.samples.first);
    }
}

/// What the tree looks like and how the device was used, under --verbose.
void printDetails(const PreparedScene& prepared, const Device& device)
{
    const BvhStatistics& tree = prepared.bvh.statistics;
    DeviceStatistics work = device.statistics();
    say("tree: {} inner nodes, {} leaves, depth {}, SAH cost {:.2f}, {:.2f} s\n", tree.innerNodes,
        tree.leaves, tree.depth, tree.sahCost, tree.seconds);
    say("device work: {} bytes of scene, {} dispatches, {} resumptions, {} retries, {} steps "
        "each\n",
        work.sceneBytes, work.dispatches, work.resumptions, work.retries, work.stepBudget);
}

int runRender(RenderOptions& options)
{
    setQuiet(options.common.quiet);
    chooseDefaultOutputs(options);
    std::vector<fs::path> outputs = checkOutputs(options);
    options.output.film = options.range.wantsFilm();

    Stopwatch watch;
    StageSeconds seconds;
    RenderSettings filmSettings;
    std::optional<DeviceAhead> opening;
    const auto openAhead = [&] {
        // A part that is there already needs no device
        if (!options.range.skipExisting) opening.emplace(options.common);
    };
    const auto onceRead = [&](const Scene& scene) {
        refuseToReplaceInputs(outputs);
        options.samples = rangeOf(options.range, scene.settings);
        filmSettings = applyCrop(options, scene.settings);
        // The film once more as channels, and as it was after the last whole replicate
        const bool keepsWhole = options.output.film && replicateSizeOf(scene.settings.samplerKind) > BLOCK_SIZE;
        requireFilmMemory(filmSettings, 1 + (options.output.film ? 1 : 0) + (keepsWhole ? 1 : 0));
        seconds.load = watch.lap();
        const bool isSaved = scene.primitives.empty();  // with its tree, so that there is nothing to expect
        if (opening && !isSaved) {
            SceneOutline outline = outlineOf(scene);
            outline.samples = uint64_t{filmSettings.width} * filmSettings.height * (options.samples.end - options.samples.first);
            opening->expectScene(outline);
        }
    };
    PreparedScene prepared = prepareSceneFor(options.common, onceRead, openAhead);
    seconds.build = watch.lap();
    options.hashes = hashesOf(prepared.deviceScene());
    dropUnwalkedTree(prepared, options.common.deviceOptions.nodeWidth);
    returnFreedMemory();
    if (options.range.isPart()) sayRange(options);
    if (options.range.skipExisting && areFinished(options.output.paths, expectedPart(options, prepared.scene, filmSettings)))
        return 0;
    std::unique_ptr<Device> device = opening ? opening->get() : openDeviceFor(options.common);
    device->setScene(prepared.deviceScene());
    seconds.upload = watch.lap();

    const RenderSettings& settings = prepared.scene.settings;
    RenderPlan plan = {filmSettings.width, filmSettings.height, options.samples.first,
                       options.samples.end - options.samples.first, options.common.tileSize};
    plan.threads = threadsFor(options.common);
    plan.wholeReplicates = options.output.film;
    if (options.crop) {
        plan.left = options.crop->x;
        plan.top = options.crop->y;
    }
    std::vector<ImageChannel> firstHits = firstHitLayers(options, prepared, plan, *device);
    seconds.firstHits = watch.lap();
    applyStopOptions(options.stop, plan);
    RenderResult result = renderLight(options, prepared.scene, plan, firstHits, *device,
                                      [&] { seconds.firstSample = watch.total(); });
    seconds.render = watch.lap();

    if (result.passes == 0) options.output.film = false;  // its pixels have different samples
    if (options.output.film && result.endsInReplicate) {
        options.output.film = false;
        warn(fmt::format("the {} samples end inside a block of {}, which cannot be torn apart; the file has no film to merge",
                         samplesIn({takenOf(options.samples, result.passes)}), result.film.replicateSize));
    }
    if (result.interrupted) sayInterrupted(options, settings, result);
    if (result.film.counters.cameraRays == 0) return interruptedExitCode();

    writePictures(options, prepared.scene, result, *device, std::move(firstHits), false);
    seconds.write = watch.lap();
    seconds.total = watch.total();
    if (!options.statsPath.empty()) {
        auto json = statisticsJson(prepared, result.film, *device, seconds);
        if (isAdaptive(settings)) json["adaptive"] = adaptiveJson(reportOf(settings, result));
        writeFileAtomically(options.statsPath, json.dump(2) + "\n");
    }

    printSummary(options, prepared, result);
    if (isAdaptive(settings) && !options.common.quiet) {
        say("{}\n", adaptiveSummary(reportOf(settings, result)));
    }
    const std::string stopped = stopSummary(result);
    if (!stopped.empty() && !options.common.quiet) say("{}\n", stopped);
    if (options.common.verbose) printDetails(prepared, *device);
    if (!options.common.quiet) {
        for (const fs::path& path : outputs) {
            if (path != options.statsPath) answer("{}\n", path.string());
        }
    }
    return result.interrupted ? interruptedExitCode() : 0;
}

}  // namespace

Command addRenderCommand(CLI::App& app)
{
    auto options = std::make_shared<RenderOptions>();
    CLI::App* command =
        app.add_subcommand("render", "render a scene into pictures")->group("Commands");
    command
        ->add_option("scene", options->common.scenePath,
                     "scene (.json, .gltf, .glb), mesh (.obj, .ply) or saved scene (.sahl)")
        ->required()
        ->type_name("SCENE");
    addOutputOptions(*command, *options);
    addMapOptions(*command, options->maps);
    addRangeOptions(*command, options->range);
    addSceneOptions(*command, options->common);
    addStopOptions(*command, options->stop);
    addCropOption(*command, options->crop);
    addDeviceOptions(*command, options->common);
    addMessageOptions(*command, options->common);
    command->footer(
        "A scene that does not say otherwise has 512 x 512 pixels, 64 samples per pixel,\n"
        "at most 8 scatterings of a path, and the seed 0.\n\n"
        "Examples:\n"
        "  sahl render scenes/default/default.json -o teapot.png\n"
        "  sahl render bunny.obj --probe uffizi.hdr --spp 256 --device cpu");
    return [options] { return runRender(*options); };
}

}  // namespace sahl
