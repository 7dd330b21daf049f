// What --device names.
#include "device/select.h"

#include "util/error.h"

#include <algorithm>
#include <cctype>
#include <charconv>

namespace sahl {

namespace {

std::string lowerCase(std::string text)
{
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

std::optional<uint32_t> parseIndex(const std::string& text)
{
    uint32_t index = 0;
    auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
    if (error != std::errc() || end != text.data() + text.size()) return {};
    return index;
}

/// Smaller is better for "auto".
int rank(const VulkanDeviceInfo& device)
{
    const char* const order[] = {"discrete", "integrated", "virtual", "other", "software"};
    return static_cast<int>(std::find(std::begin(order), std::end(order), device.kind) - order);
}

/// The devices that a selection other than "auto" and "cpu" names, best match first.
std::vector<VulkanDeviceInfo> matches(const std::string& selection,
                                      const std::vector<VulkanDeviceInfo>& devices)
{
    std::optional<uint32_t> index = parseIndex(selection);
    std::string wanted = lowerCase(selection);
    auto collect = [&](auto fits) {
        std::vector<VulkanDeviceInfo> found;
        std::copy_if(devices.begin(), devices.end(), std::back_inserter(found), fits);
        return found;
    };
    if (wanted.empty()) return {};
    if (index) return collect([&](const VulkanDeviceInfo& d) { return d.index == *index; });
    auto found = collect([&](const VulkanDeviceInfo& d) { return d.kind == wanted; });
    if (found.empty()) found = collect([&](const VulkanDeviceInfo& d) { return d.uuid == wanted; });
    if (found.empty())
        found = collect([&](const VulkanDeviceInfo& d) {
            return lowerCase(d.name).find(wanted) != std::string::npos;
        });
    std::stable_partition(found.begin(), found.end(),
                          [](const VulkanDeviceInfo& d) { return d.unusable.empty(); });
    return found;
}

std::string label(const VulkanDeviceInfo& device)
{
    return fmt::format("device {}, {} ({})", device.index, device.name, device.kind);
}

std::string skippedText(const std::vector<VulkanDeviceInfo>& devices)
{
    std::string text;
    for (const VulkanDeviceInfo& device : devices)
        if (!device.unusable.empty() && device.kind != "software")
            text += fmt::format("; {} cannot be used: {}", label(device), device.unusable);
    return text;
}

Choice chooseAutomatically(const std::vector<VulkanDeviceInfo>& devices, const std::string& whyNone)
{
    if (devices.empty()) return {{}, fmt::format("computing on the CPU: {}", whyNone)};
    const VulkanDeviceInfo* best = nullptr;
    for (const VulkanDeviceInfo& device : devices)
        if (device.unusable.empty() && (!best || rank(device) < rank(*best))) best = &device;
    if (!best)
        throw Error(ErrorKind::noDevice,
                    fmt::format("none of the Vulkan devices can be used; use --device cpu\n{}",
                                deviceList(devices, whyNone)));
    std::string note;
    if (best->kind == "software")
        note = fmt::format("{} is software: --device cpu gives the same bits, usually sooner{}",
                           label(*best), skippedText(devices));
    return {best->index, note};
}

}  // namespace

std::string deviceList(const std::vector<VulkanDeviceInfo>& devices, const std::string& whyNone)
{
    std::string text = "devices here:";
    for (const VulkanDeviceInfo& device : devices) {
        text +=
            fmt::format("\n  {}  {} ({})  {}", device.index, device.name, device.kind, device.uuid);
        if (!device.unusable.empty()) text += fmt::format("  unusable: {}", device.unusable);
    }
    text += "\n  cpu  this machine's processor";
    if (devices.empty()) text += fmt::format("\n({})", whyNone);
    return text;
}

Choice chooseDevice(const std::string& selection, const std::vector<VulkanDeviceInfo>& devices,
                    const std::string& whyNone)
{
    if (selection == "cpu") return {};
    if (selection == "auto") return chooseAutomatically(devices, whyNone);
    std::vector<VulkanDeviceInfo> found = matches(selection, devices);
    if (found.empty())
        throw Error(ErrorKind::noDevice, fmt::format("--device {}: no such device; {}", selection,
                                                     deviceList(devices, whyNone)));
    const VulkanDeviceInfo& device = found.front();
    if (!device.unusable.empty())
        throw Error(ErrorKind::noDevice,
                    fmt::format("--device {}: {} cannot be used: {}; {}", selection, label(device),
                                device.unusable, deviceList(devices, whyNone)));
    std::string note;
    if (found.size() > 1)
        note = fmt::format("--device {} fits {} devices, taking {}", selection, found.size(),
                           label(device));
    return {device.index, note};
}

std::unique_ptr<Device> openDevice(const std::string& selection, const DeviceOptions& options,
                                   std::string& note)
{
    note.clear();
    if (selection == "cpu") return makeCpuDevice(options);
    std::string whyNone;
    std::vector<VulkanDeviceInfo> devices = listVulkanDevices(whyNone);
    Choice choice = chooseDevice(selection, devices, whyNone);
    note = choice.note;
    return choice.index ? makeVulkanDevice(*choice.index, options) : makeCpuDevice(options);
}

}  // namespace sahl
