// Takes the place of vulkan_device.cpp in builds with SAHL_WITH_VULKAN=OFF.
#include "device/ceilings.h"
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

Ceilings measureCeilings(uint32_t, double, uint32_t)
{
    throw Error(ErrorKind::noDevice, WHY);
}

double Ceiling::rate() const
{
    return 0;
}

uint64_t validationMessageCount()
{
    return 0;
}

}  // namespace sahl
