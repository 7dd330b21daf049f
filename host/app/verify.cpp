// sahl verify: does the device compute what the text says?

#include "app/verify.h"

#include "app/adaptive.h"
#include "app/commands.h"
#include "app/option_kinds.h"
#include "app/outputs.h"
#include "app/progress.h"
#include "app/stats.h"
#include "render/prepare.h"
#include "util/error.h"
#include "util/interrupt.h"
#include "util/messages.h"

#include <memory>

namespace sahl {

namespace {

nlohmann::ordered_json blockJson(const PixelBlock& block)
{
    return {{"sum", {block.sum.x, block.sum.y, block.sum.z}}, {"sumY2", block.sumY2},
            {"digest", fmt::format("{:08x}", block.digest)},  {"boxTests", block.boxTests},
            {"primitiveTests", block.primitiveTests},         {"bounces", block.bounces}};
}

nlohmann::ordered_json verifyJson(const Scene& scene, const Device& device, const Device& reference,
                                  const VerifyResult& result)
{
    auto side = [](const Device& d, double seconds) {
        DeviceInfo info = d.info();
        return nlohmann::ordered_json{
            {"name", info.name}, {"driver", info.driver}, {"seconds", seconds}};
    };
    nlohmann::ordered_json json = {{"version", 1},
                                   {"scene", scene.name},
                                   {"device", side(device, result.deviceSeconds)},
                                   {"reference", side(reference, result.referenceSeconds)}};
    json.update(resultJson(result));
    return json;
}

void printBlock(const char* who, const PixelBlock& block)
{
    answer("  {:9}  radiance ({:a}, {:a}, {:a})  digest {:08x}  {} box tests, {} primitive tests\n",
           who, block.sum.x, block.sum.y, block.sum.z, block.digest, block.boxTests,
           block.primitiveTests);
}

void printVerdict(const Scene& scene, const Device& device, const Device& reference,
                  const VerifyResult& result)
{
    answer("scene      {}\n", sceneText(scene));
    for (const auto& [who, d] :
         {std::pair{"device   ", &device}, std::pair{"reference", &reference}}) {
        answer("{}  {} ({})\n", who, d->info().name, d->info().driver);
    }
    const Counters& c = result.deviceFilm.counters;
    answer("compared   {} pixels: film integers, path digests, counters ({} rays, {} box tests, {} "
           "primitive "
           "tests)\n",
           result.deviceFilm.digest.size(), c.cameraRays + c.indirectRays + c.shadowRays,
           c.boxTests, c.primitiveTests);
    if (result.equal()) {
        answer("EQUAL      0 differing bits\n");
        return;
    }
    answer("DIFFERENT  {} pixels, {} bits of the film\n", result.differingPixels,
           result.differingFilmBits);
    if (!result.first) return;
    answer("first at pixel {}\n", placeText(*result.first));
    printBlock("device", result.first->device);
    printBlock("reference", result.first->reference);
}

/// What of the options cannot go together.
void checkOptions(const VerifyOptions& options)
{
    if (options.allDevices && options.common.device != "auto") {
        throw usageError("--device names one device, --all-devices takes every one; leave one out");
    }
    if (options.allDevices && !options.differencePath.empty()) {
        throw usageError("--difference is for one device; name it with --device instead of "
                         "--all-devices");
    }
    if (!options.allVariants) return;
    if (options.allDevices) {
        throw usageError("--all-variants is for one device; name it with --device instead of "
                         "--all-devices");
    }
    if (!options.common.deviceOptions.variant.empty()) {
        throw usageError("--variant names one variant, --all-variants takes every one; leave one out");
    }
    if (!options.differencePath.empty()) {
        throw usageError("--difference is for one variant; name it with --variant instead of "
                         "--all-variants");
    }
}

int runVerify(VerifyOptions& options)
{
    setQuiet(options.common.quiet);
    checkOptions(options);
    std::vector<fs::path> outputs;
    if (!options.differencePath.empty()) outputs.push_back(options.differencePath);
    checkPicturePaths(outputs);
    PreparedScene prepared = prepareSceneFor(options.common, [&](const Scene& scene) {
        refuseToReplaceInputs(outputs);
        requireFilmMemory(scene.settings, 2);
    });
    if (options.allDevices) return verifyAllDevices(options, prepared);
    if (options.allVariants) return verifyAllVariants(options, prepared);
    std::unique_ptr<Device> device = openDeviceFor(options.common);
    std::unique_ptr<Device> reference = makeCpuDevice(options.common.deviceOptions);

    VerifyResult result = verifyWithProgress(*device, *reference, prepared, options);
    if (result.interrupted) {
        say("sahl: interrupted; nothing is decided\n");
        return interruptedExitCode();
    }

    if (options.json) {
        answer("{}\n", verifyJson(prepared.scene, *device, *reference, result).dump(2));
    } else if (!options.common.quiet || !result.equal()) {
        printVerdict(prepared.scene, *device, *reference, result);
    }
    if (!result.equal() && !options.differencePath.empty()) {
        Image difference = differenceImage(result.deviceFilm, result.referenceFilm);
        writeImage(difference, {}, options.differencePath, {});
        if (!options.json) answer("difference picture: {}\n", options.differencePath);
    }
    return result.equal() ? 0 : static_cast<int>(ErrorKind::checkFailed);
}

}  // namespace

std::string sceneText(const Scene& scene)
{
    const RenderSettings& s = scene.settings;
    return fmt::format("{}, {}x{}, {}, {} bounces", scene.name, s.width, s.height, samplesText(s),
                       s.maxBounces);
}

std::string placeText(const Divergence& divergence)
{
    return fmt::format("({}, {}), sample {}, bounce {}: {}", divergence.x, divergence.y,
                       divergence.sample, divergence.bounce, divergence.stage);
}

std::string verdictText(const VerifyResult& result)
{
    if (result.equal()) return "EQUAL, 0 differing bits";
    std::string text = fmt::format("DIFFERENT, {} pixels, {} bits", result.differingPixels,
                                   result.differingFilmBits);
    if (result.first) text += "; first at pixel " + placeText(*result.first);
    return text;
}

nlohmann::ordered_json resultJson(const VerifyResult& result)
{
    nlohmann::ordered_json json = {{"equal", result.equal()},
                                   {"differingPixels", result.differingPixels},
                                   {"differingFilmBits", result.differingFilmBits},
                                   {"counters", countersJson(result.deviceFilm.counters)}};
    if (result.first) {
        const Divergence& first = *result.first;
        json["first"] = {{"x", first.x},
                         {"y", first.y},
                         {"sample", first.sample},
                         {"bounce", first.bounce},
                         {"stage", first.stage},
                         {"device", blockJson(first.device)},
                         {"reference", blockJson(first.reference)}};
    }
    return json;
}

VerifyResult verifyWithProgress(Device& device, Device& reference, const PreparedScene& prepared,
                                const VerifyOptions& options)
{
    const RenderSettings& settings = prepared.scene.settings;
    const uint32_t samples = mostSamples(settings);
    const uint32_t tileSize = options.common.tileSize;
    ProgressPrinter printer(options.common.progress, options.common.quiet || options.json, samples);
    Stopwatch watch;
    auto report = [&](double fraction) {
        RenderProgress progress;
        progress.fraction = fraction;
        progress.samplesDone = static_cast<uint32_t>(fraction * samples);
        progress.seconds = watch.total();
        printer.update(progress);
    };
    VerifyResult result = isAdaptive(settings)
                              ? verifyAdaptive(device, reference, prepared.deviceScene(),
                                               settings.adaptive, tileSize, report)
                              : verifyDevice(device, reference, prepared.deviceScene(),
                                             settings.spp, tileSize, report);
    printer.finish();
    return result;
}

Command addVerifyCommand(CLI::App& app)
{
    auto options = std::make_shared<VerifyOptions>();
    CLI::App* command =
        app.add_subcommand("verify", "compare a device with the CPU reference, bit for bit")
            ->group("Commands");
    command
        ->add_option(
            "scene", options->common.scenePath,
            "scene (.json, .gltf, .glb), mesh (.obj, .ply) or saved scene (.sahl);\n"
            "without one a small "
            "built-in scene")
        ->type_name("SCENE");
    command
        ->add_option("--difference", options->differencePath,
                     withDefault("picture of |device - reference| if they differ", "none"))
        ->type_name("FILE")
        ->group("Output");
    addFlag(*command, "--json", options->json, "the result as JSON on stdout")->group("Output");
    addFlag(*command, "--all-devices", options->allDevices,
            "every Vulkan device of this machine, as a table")
        ->group("Device");
    addFlag(*command, "--all-variants", options->allVariants,
            "every way in which the device can run the kernels, as a\ntable (docs/variants.md)")
        ->group("Device");
    addSceneOptions(*command, options->common);
    addDeviceOptions(*command, options->common);
    addMessageOptions(*command, options->common);
    command->footer("Exit code 0: equal; 1: different, with the first pixel, sample and bounce "
                    "that are.\n\nExamples:\n"
                    "  sahl verify\n"
                    "  sahl verify scene.json --device 0 --spp 8 --difference where.exr\n"
                    "  sahl verify scene.json --all-devices\n"
                    "  sahl verify scene.json --device 0 --all-variants");
    return [options] { return runVerify(*options); };
}

}  // namespace sahl
