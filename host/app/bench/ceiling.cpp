// sahl bench ceiling: what a Vulkan device can do at most.

#include "app/bench/bench.h"
#include "app/bench/rounds.h"
#include "app/bench/table.h"
#include "device/ceilings.h"
#include "device/select.h"
#include "util/error.h"
#include "util/messages.h"

#include <string_view>

namespace sahl {

using Json = nlohmann::ordered_json;

namespace {

constexpr uint32_t ROUNDS = 5;
constexpr double SECONDS = 0.05;  // of a round

uint32_t chosenIndex(const BenchOptions& options)
{
    std::string whyNone;
    const std::vector<VulkanDeviceInfo> devices = listVulkanDevices(whyNone);
    const Choice choice = chooseDevice(options.common.device, devices, whyNone);
    if (choice.index) return *choice.index;
    throw Error(ErrorKind::noDevice, fmt::format("sahl bench ceiling measures Vulkan devices; {}",
                                                 deviceList(devices, whyNone)));
}

bool isBytes(std::string_view name)
{
    return name == "read" || name == "copy";
}

}  // namespace

Json benchCeiling(const BenchOptions& options)
{
    const uint32_t rounds = options.repeat > 0 ? options.repeat : ROUNDS;
    const Ceilings ceilings = measureCeilings(chosenIndex(options), SECONDS, rounds);
    Json rows = Json::array();
    std::vector<TableRow> table;
    for (const Ceiling& ceiling : ceilings.measured) {
        const std::string unit = isBytes(ceiling.name) ? "GB/s" : "Goperations/s";
        if (!ceiling.failure.empty()) {
            rows.push_back({{"name", ceiling.name}, {"failure", ceiling.failure}});
            table.push_back({ceiling.name, "failed", "", ""});
            warn(fmt::format("ceiling of {}: {}", ceiling.name, ceiling.failure));
            continue;
        }
        const Timing timing = {ceiling.name, ceiling.seconds};
        rows.push_back({{"name", ceiling.name},
                        {isBytes(ceiling.name) ? "bytes" : "operations", ceiling.work},
                        {"seconds", ceiling.seconds},
                        {"perSecond", ceiling.rate()},
                        {"spread", timing.spread()}});
        table.push_back(
            {ceiling.name, shortNumber(ceiling.rate() * 1e-9), unit, percent(timing.spread())});
    }
    answer("{}, buffers of {} MiB, the fastest of {} rounds\n", ceilings.device,
           ceilings.bufferBytes >> 20, rounds);
    printTable({"ceiling", "rate", "", "spread"}, table);
    return {{"device", {{"name", ceilings.device}, {"driver", ceilings.driver}}},
            {"bufferBytes", ceilings.bufferBytes},
            {"rounds", rounds},
            {"rows", rows}};
}

}  // namespace sahl
