#include "app/tune.h"

#include "app/options.h"
#include "device/variants.h"
#include "render/trials.h"
#include "util/error.h"
#include "util/messages.h"

#include <algorithm>

namespace sahl {

namespace {

constexpr uint32_t SIZE = 128;  // of the picture [pixels]
constexpr int ROUNDS = 5;
constexpr TileRequest TILE = {0, 0, SIZE, SIZE, 0, BLOCK_SIZE};

std::vector<Trial> makeTrials(const VulkanDeviceInfo& info, const PreparedScene& scene)
{
    std::vector<Trial> trials;
    for (const Variant& variant : allVariants()) {
        DeviceOptions options;
        options.variant = nameOf(variant);
        std::unique_ptr<Device> device = makeVulkanDevice(info.index, options);
        device->setScene(scene.deviceScene());
        // Where texel buffers hold too little, or the device lacks what waves need, the variant is another one in truth.
        if (device->statistics().variant == options.variant)
            trials.push_back({options.variant, std::move(device)});
    }
    return trials;
}

void printTrials(const std::vector<Trial>& trials, const std::string& standard, const Trial* best)
{
    for (const Trial& trial : trials) {
        const double samplesPerSecond = double(SIZE) * SIZE * BLOCK_SIZE / medianSeconds(trial);
        const std::string wrong =
            trial.isRight() ? "" : fmt::format("  DIFFERENT from the CPU, {} of {} pixels", trial.wrongPixels, SIZE * SIZE);
        answer("   {:<28} {:7.3f} Msamples/s{}{}{}\n", trial.name, samplesPerSecond * 1e-6,
               trial.name == standard ? "  standard" : "", &trial == best ? "  fastest" : "", wrong);
    }
}

struct Tuning {
    bool allRight = true;
    bool kept = false;
};

Tuning tune(const VulkanDeviceInfo& info, const PreparedScene& scene, std::span<const PixelBlock> expected)
{
    answer("{}  {} (driver {})\n", info.index, info.name, info.driver);
    std::vector<Trial> trials = makeTrials(info, scene);
    runTrials(trials, TILE, expected, ROUNDS);

    const Trial* best = fastestRight(trials);
    printTrials(trials, nameOf(standardVariant(info.driver)), best);
    if (best != nullptr) keepTunedVariant(info.name, info.driver, variantNamed(best->name));
    return {std::ranges::all_of(trials, &Trial::isRight), best != nullptr};
}

PreparedScene builtInScene()
{
    CommonOptions options;
    options.quiet = true;
    options.scene.width = SIZE;
    options.scene.height = SIZE;
    return prepareSceneFor(options, [](const Scene&) {});
}

std::vector<PixelBlock> referenceOf(const PreparedScene& scene)
{
    std::vector<PixelBlock> blocks(size_t{SIZE} * SIZE);
    const std::unique_ptr<Device> cpu = makeCpuDevice({});
    cpu->setScene(scene.deviceScene());
    cpu->render(TILE, blocks);
    return blocks;
}

}  // namespace

int tuneDevices()
{
    std::string whyNone;
    std::vector<VulkanDeviceInfo> devices = listVulkanDevices(whyNone);
    std::erase_if(devices, [](const VulkanDeviceInfo& device) { return !device.unusable.empty(); });
    if (devices.empty())
        throw Error(ErrorKind::noDevice,
                    fmt::format("nothing to tune: {}",
                                whyNone.empty() ? "no device can be used" : whyNone));
    const PreparedScene scene = builtInScene();
    const std::vector<PixelBlock> expected = referenceOf(scene);
    Tuning all;
    for (const VulkanDeviceInfo& device : devices) {
        const Tuning one = tune(device, scene, expected);
        all = {all.allRight && one.allRight, all.kept || one.kept};
    }
    if (all.kept) answer("kept in {}\n", tuningFile());
    if (all.allRight) return 0;
    say("sahl: variants that differ from the CPU were not kept; `sahl verify --all-variants` says where they differ\n");
    return static_cast<int>(ErrorKind::checkFailed);
}

}  // namespace sahl
