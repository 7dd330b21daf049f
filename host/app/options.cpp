#include "app/options.h"

#include "util/error.h"
#include "util/parallel.h"

namespace sahl {

namespace {

/// An option for a whole number in [lo, hi]; out of range is a usage error that names the range.
template <class Target>
CLI::Option* addNumber(CLI::App& command, const std::string& name, Target& target, int64_t lo, int64_t hi,
                       const std::string& help)
{
    auto set = [&target](const int64_t& value) { target = static_cast<uint32_t>(value); };
    return command.add_option_function<int64_t>(name, set, help)->check(CLI::Range(lo, hi))->type_name("N");
}

}  // namespace

void addSceneOptions(CLI::App& command, CommonOptions& options)
{
    SceneOptions& scene = options.scene;
    addNumber(command, "--width", scene.width, 1, 65536, "picture width [pixels]")->group("Picture");
    addNumber(command, "--height", scene.height, 1, 65536, "picture height [pixels]")->group("Picture");
    addNumber(command, "--spp,--samples", scene.spp, 1, 1 << 24, "samples per pixel")->group("Picture");
    addNumber(command, "--seed", scene.seed, 0, 0xffffffffll, "seed of all random numbers")->group("Picture");
    addNumber(command, "--max-bounces", scene.maxBounces, 0, 65535,
              "scatterings after which a path ends")->group("Picture");

    command.add_option("--probe", scene.probe, "light probe instead of the scene's: EXR, HDR or PFM")
        ->type_name("FILE")->group("Scene");
    command.add_option("--probe-mapping", scene.probeMapping, "latlong or angular")
        ->check(CLI::IsMember({"latlong", "angular"}))->type_name("NAME")->group("Scene");
    command.add_option("--probe-filter", scene.probeFilter, "nearest or bilinear")
        ->check(CLI::IsMember({"nearest", "bilinear"}))->type_name("NAME")->group("Scene");
    command.add_flag("--smooth-normals", scene.smoothNormals,
                     "interpolated normals for meshes that have none")->group("Scene");
    command.add_option("--allow-path", scene.allowedPaths, "folder outside the scene's own to read files from")
        ->type_name("DIR")->group("Scene");

    static const std::map<std::string, BvhBuild> builds = {
        {"auto", BvhBuild::automatic}, {"sweep", BvhBuild::sweep}, {"binned", BvhBuild::binned}};
    command.add_option("--bvh-build", options.bvhBuild, "auto, sweep (best tree) or binned (fast)")
        ->transform(CLI::CheckedTransformer(builds))->type_name("NAME")->group("Scene");
}

void addDeviceOptions(CLI::App& command, CommonOptions& options)
{
    DeviceOptions& device = options.deviceOptions;
    command.add_option("--device", options.device,
                       "auto, cpu, discrete, integrated, software, an index, a UUID or part of a name")
        ->type_name("DEVICE")->group("Device");
    addNumber(command, "--threads", device.threads, 1, 1024, "threads of the host and of --device cpu")
        ->group("Device");

    addNumber(command, "--tile", options.tileSize, 1, 65536, "largest side of a tile [pixels]")->group("Testing");
    command.add_option_function<std::vector<uint32_t>>(
               "--group",
               [&device](const std::vector<uint32_t>& shape) {
                   device.groupWidth = shape[0];
                   device.groupHeight = shape[1];
               },
               "workgroup shape [invocations]")
        ->expected(2)->check(CLI::Range(1u, 1024u))->type_name("W H")->group("Testing");
    static const std::map<std::string, DeviceOptions::Buffers> buffers = {
        {"auto", DeviceOptions::Buffers::automatic},
        {"texel", DeviceOptions::Buffers::texel},
        {"storage", DeviceOptions::Buffers::storage}};
    command.add_option("--buffers", device.buffers, "auto, texel or storage: how the device reads the scene")
        ->transform(CLI::CheckedTransformer(buffers))->type_name("NAME")->group("Testing");
    addNumber(command, "--steps", device.stepBudget, 1, 1 << 30, "steps of traversal a dispatch may take")
        ->group("Testing");
    command.add_flag("--validation", device.validation, "Vulkan validation layer; any message is an error")
        ->group("Testing");
}

void addMessageOptions(CLI::App& command, CommonOptions& options)
{
    command.add_option("--progress", options.progress, "auto, bar, plain or none")
        ->check(CLI::IsMember({"auto", "bar", "plain", "none"}))->type_name("NAME")->group("Messages");
    command.add_flag("-q,--quiet", options.quiet, "only errors")->group("Messages");
    command.add_flag("-v,--verbose", options.verbose, "more about scene, tree and device")->group("Messages");
}

Scene loadSceneFor(const CommonOptions& options)
{
    if (options.scenePath.empty()) return builtInScene(options.scene);
    return loadScene(options.scenePath, options.scene);
}

std::unique_ptr<Device> openDeviceFor(const CommonOptions& options)
{
    std::string note;
    auto device = openDevice(options.device, options.deviceOptions, note);
    if (!options.quiet) {
        DeviceInfo info = device->info();
        fmt::print(stderr, "device: {} ({})\n", info.name, info.driver);
        if (!note.empty()) fmt::print(stderr, "{}\n", note);
    }
    return device;
}

unsigned threadsFor(const CommonOptions& options)
{
    return options.deviceOptions.threads != 0 ? options.deviceOptions.threads : defaultThreadCount();
}

}  // namespace sahl
