// sahl verify --all-devices: one table of all that computes on this machine.

#include "app/commands.h"
#include "app/verify.h"
#include "util/error.h"
#include "util/messages.h"

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
    nlohmann::ordered_json json = {};
};

std::string verdictText(const VerifyResult& result)
{
    if (result.equal()) return "EQUAL, 0 differing bits";
    std::string text = fmt::format("DIFFERENT, {} pixels, {} bits", result.differingPixels,
                                   result.differingFilmBits);
    if (result.first) text += "; first at pixel " + placeText(*result.first);
    return text;
}

void compareWith(Device& reference, const PreparedScene& prepared, const VerifyOptions& options,
                 Row& row)
{
    auto device = makeVulkanDevice(row.info.index, options.common.deviceOptions);
    const VerifyResult result = verifyWithProgress(*device, reference, prepared, options);
    row.equal = result.equal();
    row.interrupted = result.interrupted;
    row.verdict = verdictText(result);
    row.json["seconds"] = result.deviceSeconds;
    row.json.update(resultJson(result));
}

void addFailure(Row& row, ErrorKind kind, const std::string& message)
{
    row.failure = kind;
    row.verdict = message;
    row.json["equal"] = false;
    row.json["failure"] = message;
}

/// A device that is missing something or is lost does not keep the others from being compared.
Row verifyOne(const VulkanDeviceInfo& info, Device& reference, const PreparedScene& prepared,
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
    auto reference = makeCpuDevice(options.common.deviceOptions);
    std::vector<Row> rows;
    for (const VulkanDeviceInfo& device : devices) {
        if (!options.common.quiet && !options.json) say("device: {}\n", device.name);
        rows.push_back(verifyOne(device, *reference, prepared, options));
        if (rows.back().interrupted) {
            say("sahl: interrupted; nothing is decided\n");
            return interruptedExitCode();
        }
    }

    const int exitCode = exitCodeOf(rows);
    if (options.json) {
        const DeviceInfo cpu = reference->info();
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
        printTable(prepared, *reference, rows);
    }
    return exitCode;
}

}  // namespace sahl
