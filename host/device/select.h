// The choice among the devices of a machine, apart from opening one.
#pragma once

#include "device/device.h"

namespace sahl {

/// A Vulkan device by its index, or the CPU; and a line for the user, or "".
struct Choice {
    std::optional<uint32_t> index;
    std::string note;
};

/// What `selection` (see openDevice) means among `devices`. `whyNone`: why there are none.
/// Throws noDevice with the list of devices.
Choice chooseDevice(const std::string& selection, const std::vector<VulkanDeviceInfo>& devices,
                    const std::string& whyNone);

/// "devices here:" and a line for each, the CPU included.
std::string deviceList(const std::vector<VulkanDeviceInfo>& devices, const std::string& whyNone);

}  // namespace sahl
