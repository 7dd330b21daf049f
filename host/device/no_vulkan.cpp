// Takes the place of vulkan_device.cpp in builds with SAHL_WITH_VULKAN=OFF.
#include "device/device.h"
#include "util/error.h"

namespace sahl {

namespace {
constexpr const char* WHY = "this sahl was built without Vulkan (SAHL_WITH_VULKAN=OFF); only "
                            "--device cpu is offered";
}

std::vector<VulkanDeviceInfo> listVulkanDevices(std::string& whyNone)
{
    whyNone = WHY;
    return {};
}

std::unique_ptr<Device> makeVulkanDevice(uint32_t, const DeviceOptions&)
{
    throw Error(ErrorKind::noDevice, WHY);
}

uint64_t validationMessageCount()
{
    return 0;
}

}  // namespace sahl
