#include "app/tune.h"

#include "app/options.h"
#include "device/variants.h"
#include "util/error.h"
#include "util/messages.h"

#include <algorithm>

namespace sahl {

namespace {

constexpr uint32_t SIZE = 128;  // of the picture [pixels]
constexpr int ROUNDS = 5;       // after one that compiles the kernels

struct Candidate {
    Variant variant;
    std::unique_ptr<Device> device;
    std::vector<double> seconds;  // of a block of samples for each pixel, by rounds
};

double medianOf(std::vector<double> values)
{
    std::nth_element(values.begin(), values.begin() + static_cast<ptrdiff_t>(values.size() / 2),
                     values.end());
    return values[values.size() / 2];
}

double samplesPerSecond(const Candidate& candidate)
{
    return double(SIZE) * SIZE * BLOCK_SIZE / medianOf(candidate.seconds);
}

std::vector<Candidate> makeCandidates(const VulkanDeviceInfo& info, const PreparedScene& scene)
{
    std::vector<Candidate> candidates;
    for (const Variant& variant : allVariants()) {
        DeviceOptions options;
        options.variant = nameOf(variant);
        std::unique_ptr<Device> device = makeVulkanDevice(info.index, options);
        device->setScene(scene.deviceScene());
        // Where texel buffers hold too little the variant is another one in truth.
        if (device->statistics().texelBuffers == variant.texelBuffers)
            candidates.push_back({variant, std::move(device), {}});
    }
    return candidates;
}

/// One block of samples of the whole picture.
void measure(Candidate& candidate)
{
    std::vector<PixelBlock> blocks(SIZE * SIZE);
    const double before = candidate.device->statistics().renderSeconds;
    candidate.device->render({0, 0, SIZE, SIZE, 0, BLOCK_SIZE}, blocks);
    candidate.seconds.push_back(candidate.device->statistics().renderSeconds - before);
}

void tune(const VulkanDeviceInfo& info, const PreparedScene& scene)
{
    answer("{}  {} (driver {})\n", info.index, info.name, info.driver);
    std::vector<Candidate> candidates = makeCandidates(info, scene);
    for (Candidate& candidate : candidates) {
        measure(candidate);
        candidate.seconds.clear();
    }
    // In turns, so that what else the machine does meets all alike.
    for (int round = 0; round < ROUNDS; round++)
        for (Candidate& candidate : candidates) measure(candidate);

    auto slower = [](const Candidate& a, const Candidate& b) {
        return samplesPerSecond(a) < samplesPerSecond(b);
    };
    const Candidate& best = *std::max_element(candidates.begin(), candidates.end(), slower);
    const Variant standard = standardVariant(info.driver);
    for (const Candidate& candidate : candidates)
        answer("   {:<28} {:7.3f} Msamples/s{}{}\n", nameOf(candidate.variant),
               samplesPerSecond(candidate) * 1e-6,
               candidate.variant == standard ? "  standard" : "",
               &candidate == &best ? "  fastest" : "");
    keepTunedVariant(info.name, info.driver, best.variant);
}

PreparedScene builtInScene()
{
    CommonOptions options;
    options.quiet = true;
    options.scene.width = SIZE;
    options.scene.height = SIZE;
    return prepareSceneFor(options, [](const Scene&) {});
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
    for (const VulkanDeviceInfo& device : devices) tune(device, scene);
    answer("kept in {}\n", tuningFile());
    return 0;
}

}  // namespace sahl
