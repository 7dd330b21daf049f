#include "app/options.h"

#include "app/adaptive.h"
#include "app/option_kinds.h"
#include "app/sampling_options.h"
#include "app/shading_options.h"
#include "app/tree_options.h"
#include "device/variants.h"
#include "film/film.h"
#include "film/replicates.h"
#include "saved/saved_scene.h"
#include "util/error.h"
#include "util/memory.h"
#include "util/messages.h"
#include "util/parallel.h"

namespace sahl {

namespace {

const char* const SCENES = "the scene's";

CLI::Option* addPath(CLI::App& command, const std::string& name, std::optional<fs::path>& target,
                     const std::string& help, const std::string& standard)
{
    return command.add_option(name, target, withDefault(help, standard))->type_name("FILE");
}

void addGroupShape(CLI::App& command, DeviceOptions& device)
{
    auto set = [&device](const std::string& text) {
        size_t cross = text.find('x');
        if (cross == std::string::npos) {
            throw CLI::ValidationError(fmt::format("--group '{}' is no shape; give WxH", text));
        }
        device.groupWidth = parseNumber("--group", text.substr(0, cross), {1, 1024});
        device.groupHeight = parseNumber("--group", text.substr(cross + 1), {1, 1024});
    };
    command
        .add_option_function<std::string>(
            "--group", set,
            withDefault("workgroup shape [invocations], each side 1 to 1024", "by device"))
        ->type_name("WxH")
        ->group("Testing");
}

void addVariant(CLI::App& command, DeviceOptions& device)
{
    auto set = [&device](const std::string& text) {
        std::vector<std::string> names;
        for (const Variant& variant : allVariants()) names.push_back(nameOf(variant));
        device.variant = names[parseChoice("--variant", text, names)];
    };
    command
        .add_option_function<std::string>(
            "--variant", set,
            withDefault("way in which a Vulkan device runs the kernels, by name\n(docs/variants.md)",
                        "as sahl devices --tune found, else by device"))
        ->type_name("NAME")
        ->group("Device");
}

/// What was chosen, and why.
void sayDevice(const CommonOptions& options, const Device& device, const std::string& note)
{
    if (options.quiet) return;
    const DeviceInfo info = device.info();
    say("device: {} ({})\n", info.name, info.driver);
    if (!note.empty()) say("{}\n", note);
}

}  // namespace

void addSceneOptions(CLI::App& command, CommonOptions& options)
{
    SceneOptions& scene = options.scene;
    addNumber(command, "--width", scene.width, {1, 32768}, "picture width [pixels]", SCENES)
        ->group("Picture");
    addNumber(command, "--height", scene.height, {1, 32768}, "picture height [pixels]", SCENES)
        ->group("Picture");
    addNumber(command, "--spp,--samples", scene.spp, {1, 1 << 24}, "samples per pixel", SCENES)
        ->group("Picture");
    addNumber(command, "--seed", scene.seed, {0, 0xffffffff}, "seed of the random numbers", SCENES)
        ->group("Picture");
    addNumber(command, "--max-bounces", scene.maxBounces, {0, 65535}, "scatterings of a path",
              SCENES)
        ->group("Picture");
    addSamplingOptions(command, scene);
    addAdaptiveOptions(command, scene);

    addShadingOptions(command, scene);

    addPath(command, "--probe", scene.probe, "light probe: EXR, HDR or PFM", SCENES)
        ->group("Scene");
    addWord(command, "--probe-mapping", scene.probeMapping, {"latlong", "angular"},
            "latlong or angular", "the scene's, else latlong")
        ->group("Scene");
    addWord(command, "--probe-filter", scene.probeFilter, {"nearest", "bilinear"},
            "nearest or bilinear", "the scene's, else bilinear")
        ->group("Scene");
    command
        .add_flag("--smooth-normals", scene.smoothNormals,
                  "interpolated normals for meshes that have none")
        ->group("Scene");
    command
        .add_option("--allow-path", scene.allowedPaths,
                    withDefault("another folder that files may lie in; repeatable", "none"))
        ->type_name("DIR")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->group("Scene");
    addTreeOptions(command, options);
}

void addDeviceOptions(CLI::App& command, CommonOptions& options)
{
    DeviceOptions& device = options.deviceOptions;
    command
        .add_option("--device", options.device,
                    withDefault("auto, cpu, discrete, integrated, software, an index, a UUID or\n"
                                "part of a name; see sahl devices",
                                options.device))
        ->type_name("DEVICE")
        ->group("Device");
    addNumber(command, "--threads", device.threads, {1, 1024}, "threads of the host", "all cores")
        ->group("Device");

    addChoice(command, "--math", device.math,
              {{"auto", DeviceOptions::Math::automatic},
               {"native", DeviceOptions::Math::native},
               {"exact", DeviceOptions::Math::exact}},
              "native division and root, exact ones, or (auto) exact\nwhere the device's own are not")
        ->group("Device");

    addVariant(command, device);
    addNumber(command, "--tile", options.tileSize, {1, 65536}, "largest side of a tile [pixels]",
              "by device")
        ->group("Testing");
    addGroupShape(command, device);
    addChoice(command, "--buffers", device.buffers,
              {{"auto", DeviceOptions::Buffers::automatic},
               {"texel", DeviceOptions::Buffers::texel},
               {"storage", DeviceOptions::Buffers::storage}},
              "auto, texel or storage: how the device reads the scene")
        ->group("Testing");
    addNumber(command, "--steps", device.stepBudget, {1, 1 << 30}, "steps of a path in a dispatch",
              "by device")
        ->group("Testing");
    command
        .add_flag("--validation", device.validation,
                  "any message of the validation layer is an error")
        ->group("Testing");
}

void addMessageOptions(CLI::App& command, CommonOptions& options)
{
    addWord(command, "--progress", options.progress, {"auto", "bar", "plain", "none"},
            "auto, bar, plain (a line every 10 s) or none", options.progress)
        ->group("Messages");
    addFlag(command, "-q,--quiet", options.quiet, "only errors, and what another option asks for")
        ->group("Messages");
    addFlag(command, "-v,--verbose", options.verbose, "more about scene, tree and device")
        ->group("Messages");
}

Scene loadSceneFor(const CommonOptions& options)
{
    if (options.scenePath.empty()) return builtInScene(options.scene);
    return loadScene(options.scenePath, options.scene);
}

PreparedScene prepareSceneFor(const CommonOptions& options, const std::function<void(const Scene&)>& onceRead,
                              const std::function<void()>& onceThreadsMayStart)
{
    const SavedForm form = savedFormOf(options.scenePath);
    if (form == SavedForm::none) {
        CommonOptions read = options;
        read.scene.onceThreadsMayStart = onceThreadsMayStart;
        Scene scene = loadSceneFor(read);
        onceRead(scene);
        returnFreedMemory();  // of reading, before the tree needs most
        return prepareScene(std::move(scene), options.bvhBuild, threadsFor(options));
    }
    if (options.bvhBuild != BvhBuild::automatic) {
        throw usageError("{}: has its tree with it; --bvh-build and --bvh-quality need the scene that "
                         "it was saved from",
                         options.scenePath);
    }
    const bool splitsOff = options.scene.probe.has_value();
    if (onceThreadsMayStart && !splitsOff) onceThreadsMayStart();
    PreparedScene prepared = loadSaved(form, options.scenePath, options.scene);
    if (onceThreadsMayStart && splitsOff) onceThreadsMayStart();
    onceRead(prepared.scene);
    return prepared;
}

std::unique_ptr<Device> openDeviceFor(const CommonOptions& options)
{
    std::string note;
    auto device = openDevice(options.device, options.deviceOptions, note);
    sayDevice(options, *device, note);
    return device;
}

DeviceAhead::DeviceAhead(const CommonOptions& options)
    : options_(options), opened_(std::async(std::launch::async, [&options, outline = outline_.get_future()]() mutable {
          Opened opened;
          opened.device = openDevice(options.device, options.deviceOptions, opened.note);
          if (const std::optional<SceneOutline> expected = outline.get()) opened.device->expectScene(*expected);
          return opened;
      }))
{
}

DeviceAhead::~DeviceAhead() { expect({}); }

void DeviceAhead::expectScene(const SceneOutline& outline) { expect(outline); }

void DeviceAhead::expect(const std::optional<SceneOutline>& outline)
{
    if (!std::exchange(expected_, true)) outline_.set_value(outline);
}

std::unique_ptr<Device> DeviceAhead::get()
{
    expect({});
    Opened opened = opened_.get();
    sayDevice(options_, *opened.device, opened.note);
    return std::move(opened.device);
}

void requireFilmMemory(const RenderSettings& settings, unsigned films)
{
    // The film, the blocks of a pass; and at last two pictures, the four layers of
    // statistics, and their files.
    const uint64_t film = filmBytes(1, 1, replicateSizeOf(settings.samplerKind)) + sizeof(PixelBlock);
    constexpr uint64_t PICTURES = (4 * 3 + 4) * sizeof(float);
    uint64_t pixels = uint64_t{settings.width} * settings.height;
    requireMemory(pixels * (film * films + PICTURES),
                  fmt::format("a picture of {} x {} pixels", settings.width, settings.height),
                  "render a smaller one");
}

unsigned threadsFor(const CommonOptions& options)
{
    return options.deviceOptions.threads != 0 ? options.deviceOptions.threads
                                              : defaultThreadCount();
}

}  // namespace sahl
