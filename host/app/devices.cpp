// sahl devices: what this machine offers.

#include "app/commands.h"
#include "app/option_kinds.h"
#include "app/tune.h"
#include "device/device.h"
#include "device/variants.h"
#include "util/messages.h"
#include "util/parallel.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>

namespace sahl {

namespace {

nlohmann::ordered_json devicesJson(const std::vector<VulkanDeviceInfo>& devices,
                                   const std::string& whyNone)
{
    auto list = nlohmann::ordered_json::array();
    for (const VulkanDeviceInfo& device : devices) {
        list.push_back({{"index", device.index},
                        {"name", device.name},
                        {"driver", device.driver},
                        {"kind", device.kind},
                        {"uuid", device.uuid},
                        {"apiVersion", device.apiVersion},
                        {"deviceMemoryBytes", device.deviceMemory},
                        {"maxStorageBufferBytes", device.maxStorageBufferBytes},
                        {"maxTexelBufferElements", device.maxTexelBufferElements},
                        {"subgroupSize", device.subgroupSize},
                        {"maxGroupInvocations", device.maxGroupInvocations},
                        {"usable", device.unusable.empty()},
                        {"unusable", device.unusable}});
    }
    DeviceInfo cpu = makeCpuDevice({})->info();
    return {
        {"version", 1},
        {"vulkan", list},
        {"noVulkan", whyNone},
        {"cpu", {{"name", cpu.name}, {"driver", cpu.driver}, {"threads", defaultThreadCount()}}}};
}

void printDevices(const std::vector<VulkanDeviceInfo>& devices, const std::string& whyNone)
{
    for (const VulkanDeviceInfo& device : devices) {
        answer("{}    {}\n     {}, driver {}, Vulkan {}\n     UUID {}\n"
               "     {} MiB, storage buffers to {} MiB, texel buffers to {} elements\n",
               device.index, device.name, device.kind, device.driver, device.apiVersion,
               device.uuid, device.deviceMemory >> 20, device.maxStorageBufferBytes >> 20,
               device.maxTexelBufferElements);
        if (!device.unusable.empty()) answer("     cannot be used: {}\n", device.unusable);
    }
    if (!whyNone.empty()) answer("no Vulkan device: {}\n", whyNone);
    DeviceInfo cpu = makeCpuDevice({})->info();
    answer("cpu  {}\n     the same text compiled by {}\n", cpu.name, cpu.driver);
}

}  // namespace

Command addDevicesCommand(CLI::App& app)
{
    auto json = std::make_shared<bool>(false);
    auto tune = std::make_shared<bool>(false);
    auto variants = std::make_shared<bool>(false);
    CLI::App* command =
        app.add_subcommand("devices", "list the devices of this machine")->group("Commands");
    addFlag(*command, "--json", *json, "the list as JSON on stdout");
    addFlag(*command, "--tune", *tune,
            "measure all variants on every Vulkan device and keep\nthe fastest for later starts (docs/variants.md)");
    addFlag(*command, "--variants", *variants, "the names that --variant takes");
    command->footer("Examples:\n"
                    "  sahl devices\n"
                    "  sahl devices --json\n"
                    "  sahl devices --tune");
    return [json, tune, variants] {
        if (*variants) {
            for (const Variant& variant : allVariants()) answer("{}\n", nameOf(variant));
            return 0;
        }
        if (*tune) return tuneDevices();
        std::string whyNone;
        std::vector<VulkanDeviceInfo> devices = listVulkanDevices(whyNone);
        if (*json) {
            answer("{}\n", devicesJson(devices, whyNone).dump(2));
        } else {
            printDevices(devices, whyNone);
        }
        return 0;
    };
}

}  // namespace sahl
