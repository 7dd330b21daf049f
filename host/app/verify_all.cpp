// sahl verify --all-devices: one table of all that computes on this machine.

#include "app/adaptive.h"
#include "app/commands.h"
#include "app/verify.h"
#include "compare/noise.h"
#include "film/film_error.h"
#include "render/render.h"
#include "util/error.h"
#include "util/messages.h"

#include <cmath>
#include <memory>
#include <optional>

namespace sahl {

namespace {

/// What came of one device: kept as words, since films are large.
struct Row {
    VulkanDeviceInfo info;
    bool equal = false;
    bool interrupted = false;
    std::optional<ErrorKind> failure = {};  ///< that of a device where nothing could be compared
    std::string verdict = {};
    std::string noise = {};  ///< what wrong bits mean for the picture; "" when all are right
    nlohmann::ordered_json json = {};
};

/// A film as a file of it would say it.
LoadedPicture pictureOf(const Film& film)
{
    LoadedPicture picture;
    picture.image = meanImage(film);
    for (size_t i = 0; i < film.digest.size(); i++) {
        picture.variance.push_back(static_cast<float>(pixelStatistics(film, i).varianceOfMean));
    }
    return picture;
}

/// The picture of the reference with other random numbers: of the scene's seed a device that
/// differs has noise in common with the reference, and no test of means could be made.
LoadedPicture independentPicture(Device& reference, const PreparedScene& prepared)
{
    const RenderSettings& settings = prepared.scene.settings;
    DeviceScene scene = prepared.deviceScene();
    scene.frame.seed++;
    reference.setScene(scene);
    const RenderPlan plan = {settings.width, settings.height, 0, settings.spp, 0};
    return pictureOf(renderPicture(reference, plan, [](const RenderProgress&) {}).film);
}

/// What every device is compared with.
struct Reference {
    std::unique_ptr<Device> device;
    std::optional<LoadedPicture> independent = {};  ///< made for the first device that differs
};

/// Do wrong bits make a wrong picture?
Statistics testAgainstNoise(const Film& film, Reference& reference, const PreparedScene& prepared,
                            const VerifyOptions& options)
{
    if (!reference.independent) {
        reference.independent = independentPicture(*reference.device, prepared);
    }
    CompareOptions compareOptions;
    compareOptions.threads = threadsFor(options.common);
    return testDifferences(pictureOf(film), *reference.independent, compareOptions);
}

std::string noiseText(const Statistics& statistics)
{
    const double mean = 0.5 * (statistics.meanA + statistics.meanB);
    if (!(statistics.frame.standardError > 0) || !(mean > 0)) return "no spread to test it by";
    if (statistics.frameDiffers || statistics.differingBlocks > 0) {
        return fmt::format(
            "against an independent render the mean differs by {:+.3g} % (z {:.1f}), "
            "and {} of {} blocks do",
            100 * statistics.frame.difference / mean, statistics.frame.z,
            statistics.differingBlocks, statistics.testedBlocks);
    }
    return fmt::format("no difference from an independent render beyond noise; a bias of {:.3g} % "
                       "would have been seen",
                       100 * statistics.detectableBias);
}

void compareWith(Reference& reference, const PreparedScene& prepared, const VerifyOptions& options,
                 Row& row)
{
    auto device = makeVulkanDevice(row.info.index, options.common.deviceOptions);
    const VerifyResult result = verifyWithProgress(*device, *reference.device, prepared, options);
    row.equal = result.equal();
    row.interrupted = result.interrupted;
    row.verdict = verdictText(result);
    row.json["seconds"] = result.deviceSeconds;
    row.json.update(resultJson(result));
    if (row.equal || row.interrupted || isAdaptive(prepared.scene.settings)) return;
    const Statistics statistics = testAgainstNoise(result.deviceFilm, reference, prepared, options);
    row.noise = noiseText(statistics);
    row.json["againstIndependentRender"] = {
        {"difference", statistics.frame.difference},
        {"standardError", statistics.frame.standardError},
        {"frameDiffers", statistics.frameDiffers},
        {"differingBlocks", statistics.differingBlocks},
        {"testedBlocks", statistics.testedBlocks},
        {"detectableBias", std::isfinite(statistics.detectableBias)
                               ? nlohmann::ordered_json(statistics.detectableBias)
                               : nlohmann::ordered_json(nullptr)}};
}

void addFailure(Row& row, ErrorKind kind, const std::string& message)
{
    row.failure = kind;
    row.verdict = message;
    row.json["equal"] = false;
    row.json["failure"] = message;
}

/// A device that is missing something or is lost does not keep the others from being compared.
Row verifyOne(const VulkanDeviceInfo& info, Reference& reference, const PreparedScene& prepared,
              const VerifyOptions& options)
{
    Row row = {info};
    row.json = {{"index", info.index},
                {"name", info.name},
                {"driver", info.driver},
                {"kind", info.kind},
                {"uuid", info.uuid}};
    if (!info.unusable.empty()) {
        addFailure(row, ErrorKind::noDevice, "cannot be used: " + info.unusable);
        return row;
    }
    try {
        compareWith(reference, prepared, options, row);
    } catch (const Error& error) {
        if (error.kind != ErrorKind::noDevice && error.kind != ErrorKind::deviceLost) throw;
        addFailure(row, error.kind, error.what());
    }
    return row;
}

void printTable(const PreparedScene& prepared, const Device& reference,
                const std::vector<Row>& rows)
{
    const DeviceInfo cpu = reference.info();
    size_t names = cpu.name.size();
    size_t drivers = cpu.driver.size();
    for (const Row& row : rows) {
        names = std::max(names, row.info.name.size());
        drivers = std::max(drivers, row.info.driver.size());
    }
    answer("scene  {}\n", sceneText(prepared.scene));
    for (const Row& row : rows) {
        answer("{:>5}  {:{}}  {:{}}  {}\n", row.info.index, row.info.name, names, row.info.driver,
               drivers, row.verdict);
        if (!row.noise.empty()) answer("{:>{}}{}\n", "", 11 + names + drivers, row.noise);
    }
    answer("{:>5}  {:{}}  {:{}}  the reference\n", "cpu", cpu.name, names, cpu.driver, drivers);
}

/// The worst that happened: a difference, then a failure of a device that should work.
int exitCodeOf(const std::vector<Row>& rows)
{
    int code = 0;
    for (const Row& row : rows) {
        if (!row.equal && !row.failure) return static_cast<int>(ErrorKind::checkFailed);
        if (row.failure && row.info.unusable.empty()) code = static_cast<int>(*row.failure);
    }
    return code;
}

}  // namespace

int verifyAllDevices(const VerifyOptions& options, const PreparedScene& prepared)
{
    std::string whyNone;
    const std::vector<VulkanDeviceInfo> devices = listVulkanDevices(whyNone);
    auto usable = [](const VulkanDeviceInfo& device) { return device.unusable.empty(); };
    if (std::ranges::none_of(devices, usable)) {
        throw Error(ErrorKind::noDevice,
                    devices.empty()
                        ? "no Vulkan device to verify: " + whyNone
                        : "none of the Vulkan devices can be used: " + devices.front().unusable);
    }
    Reference reference = {makeCpuDevice(options.common.deviceOptions)};
    std::vector<Row> rows;
    for (const VulkanDeviceInfo& device : devices) {
        if (!options.common.quiet && !options.json) say("device: {}\n", device.name);
        rows.push_back(verifyOne(device, reference, prepared, options));
        if (rows.back().interrupted) {
            say("sahl: interrupted; nothing is decided\n");
            return interruptedExitCode();
        }
    }

    const int exitCode = exitCodeOf(rows);
    if (options.json) {
        const DeviceInfo cpu = reference.device->info();
        auto list = nlohmann::ordered_json::array();
        for (const Row& row : rows) list.push_back(row.json);
        const nlohmann::ordered_json json = {
            {"version", 1},
            {"scene", prepared.scene.name},
            {"reference", {{"name", cpu.name}, {"driver", cpu.driver}}},
            {"devices", list},
            {"equal", exitCode == 0}};
        answer("{}\n", json.dump(2));
    } else if (!options.common.quiet || exitCode != 0) {
        printTable(prepared, *reference.device, rows);
    }
    return exitCode;
}

}  // namespace sahl
