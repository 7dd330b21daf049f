// sahl verify --all-variants: one table of all ways in which a device can run the kernels.

#include "app/commands.h"
#include "app/verify.h"
#include "device/variants.h"
#include "util/error.h"
#include "util/messages.h"

#include <algorithm>
#include <memory>

namespace sahl {

namespace {

/// What came of one variant: kept as words, since films are large.
struct Row {
    std::string variant;
    std::string ranAs;  ///< another name where device or scene do not allow what the variant asks for
    std::string verdict;
    bool equal = false;
    bool interrupted = false;
    nlohmann::ordered_json json;
};

Row verifyVariant(const std::string& variant, Device& reference, const PreparedScene& prepared, const VerifyOptions& options)
{
    DeviceOptions deviceOptions = options.common.deviceOptions;
    deviceOptions.variant = variant;
    std::string note;  // has been given for the first device
    const auto device = openDevice(options.common.device, deviceOptions, note);
    const VerifyResult result = verifyWithProgress(*device, reference, prepared, options);

    const std::string ranAs = device->statistics().variant;
    nlohmann::ordered_json json = {{"variant", variant}, {"ranAs", ranAs}, {"seconds", result.deviceSeconds}};
    json.update(resultJson(result));
    return {variant, ranAs, verdictText(result), result.equal(), result.interrupted, json};
}

nlohmann::ordered_json sideJson(const Device& device)
{
    const DeviceInfo info = device.info();
    return {{"name", info.name}, {"driver", info.driver}};
}

void printRows(const std::vector<Row>& rows)
{
    size_t names = 0;
    for (const Row& row : rows) names = std::max(names, row.variant.size());
    for (const Row& row : rows) {
        const std::string another = row.ranAs == row.variant ? "" : fmt::format(", as {}", row.ranAs);
        answer("  {:{}}  {}{}\n", row.variant, names, row.verdict, another);
    }
}

}  // namespace

int verifyAllVariants(const VerifyOptions& options, const PreparedScene& prepared)
{
    const std::unique_ptr<Device> device = openDeviceFor(options.common);
    if (device->statistics().variant.empty()) {
        throw usageError("--all-variants is for Vulkan devices: the CPU runs the text in one way");
    }
    const auto reference = makeCpuDevice(options.common.deviceOptions);
    std::vector<Row> rows;
    for (const Variant& variant : allVariants()) {
        if (!options.common.quiet && !options.json) say("variant: {}\n", nameOf(variant));
        rows.push_back(verifyVariant(nameOf(variant), *reference, prepared, options));
        if (rows.back().interrupted) {
            say("sahl: interrupted; nothing is decided\n");
            return interruptedExitCode();
        }
    }

    const bool equal = std::ranges::all_of(rows, &Row::equal);
    if (options.json) {
        auto list = nlohmann::ordered_json::array();
        for (const Row& row : rows) list.push_back(row.json);
        const nlohmann::ordered_json json = {{"version", 1},
                                             {"scene", prepared.scene.name},
                                             {"device", sideJson(*device)},
                                             {"reference", sideJson(*reference)},
                                             {"variants", list},
                                             {"equal", equal}};
        answer("{}\n", json.dump(2));
    } else if (!options.common.quiet || !equal) {
        answer("scene  {}\n", sceneText(prepared.scene));
        answer("{}  {}\n", device->info().name, device->info().driver);
        printRows(rows);
    }
    return equal ? 0 : static_cast<int>(ErrorKind::checkFailed);
}

}  // namespace sahl
