// What --device means on machines with all kinds of devices.
#include "device/select.h"
#include "util/error.h"

#include <gtest/gtest.h>

namespace sahl::testing {
namespace {

VulkanDeviceInfo device(uint32_t index, const std::string& name, const std::string& kind)
{
    VulkanDeviceInfo info;
    info.index = index;
    info.name = name;
    info.kind = kind;
    info.uuid = "0123abcd-0000-0000-0000-00000000000" + std::to_string(index);
    return info;
}

std::vector<VulkanDeviceInfo> workstation()
{
    return {device(0, "llvmpipe (LLVM 15.0.6, 256 bits)", "software"),
            device(1, "Intel(R) UHD Graphics 770", "integrated"),
            device(2, "NVIDIA RTX A4000", "discrete"), device(3, "NVIDIA RTX A4000", "discrete")};
}

std::string errorOf(const std::string& selection, const std::vector<VulkanDeviceInfo>& devices)
{
    try {
        chooseDevice(selection, devices, "no Vulkan driver found");
    } catch (const Error& error) {
        EXPECT_EQ(error.kind, ErrorKind::noDevice);
        return error.what();
    }
    return "";
}

TEST(ChooseDevice, auto_takesARealGpuWithoutANote)
{
    Choice choice = chooseDevice("auto", workstation(), "");
    EXPECT_EQ(choice.index, 2u);
    EXPECT_EQ(choice.note, "");
    auto laptop = workstation();
    laptop.resize(2);
    EXPECT_EQ(chooseDevice("auto", laptop, "").index, 1u);
}

TEST(ChooseDevice, auto_saysThatTheCpuGivesTheSameBitsAsSoftware)
{
    auto devices = workstation();
    devices.resize(1);
    Choice choice = chooseDevice("auto", devices, "");
    EXPECT_EQ(choice.index, 0u);
    EXPECT_NE(choice.note.find("--device cpu gives the same bits"), std::string::npos)
        << choice.note;
}

TEST(ChooseDevice, auto_saysWhyItPassesOverAGpu)
{
    auto devices = workstation();
    devices.resize(2);
    devices[1].unusable = "its driver has Vulkan 1.0.2, 1.1 is needed";
    Choice choice = chooseDevice("auto", devices, "");
    EXPECT_EQ(choice.index, 0u);
    EXPECT_NE(choice.note.find("Vulkan 1.0.2"), std::string::npos) << choice.note;
}

TEST(ChooseDevice, auto_refusesWhenThereIsVulkanAndNothingOfItCanBeUsed)
{
    auto devices = workstation();
    for (VulkanDeviceInfo& each : devices) each.unusable = "it has no queue for compute";
    EXPECT_NE(errorOf("auto", devices).find("no queue for compute"), std::string::npos);
}

TEST(ChooseDevice, auto_takesTheCpuWhereThereIsNoVulkanAndSaysWhy)
{
    Choice choice = chooseDevice("auto", {}, "no Vulkan driver found");
    EXPECT_FALSE(choice.index.has_value());
    EXPECT_EQ(choice.note, "computing on the CPU: no Vulkan driver found");
}

TEST(ChooseDevice, takesIndexUuidKindAndPartOfAName)
{
    EXPECT_EQ(chooseDevice("1", workstation(), "").index, 1u);
    EXPECT_EQ(chooseDevice("0123ABCD-0000-0000-0000-000000000003", workstation(), "").index, 3u);
    EXPECT_EQ(chooseDevice("software", workstation(), "").index, 0u);
    EXPECT_EQ(chooseDevice("Integrated", workstation(), "").index, 1u);
    EXPECT_EQ(chooseDevice("uhd", workstation(), "").index, 1u);
    EXPECT_FALSE(chooseDevice("cpu", workstation(), "").index.has_value());
}

TEST(ChooseDevice, saysWhichOfSeveralItTook)
{
    auto devices = workstation();
    devices[2].unusable = "it has no queue for compute";
    Choice choice = chooseDevice("nvidia", devices, "");
    EXPECT_EQ(choice.index, 3u);
    EXPECT_NE(choice.note.find("fits 2 devices, taking device 3"), std::string::npos)
        << choice.note;
}

TEST(ChooseDevice, refusesWhatFitsNothingWithTheListOfDevices)
{
    for (const char* selection : {"99", "Voodoo", "", "virtual", "2x", "-1", "99999999999"}) {
        std::string text = errorOf(selection, workstation());
        EXPECT_NE(text.find("no such device"), std::string::npos) << selection;
        EXPECT_NE(text.find("\n  2  NVIDIA RTX A4000 (discrete)"), std::string::npos) << text;
    }
    EXPECT_NE(errorOf("0", {}).find("no Vulkan driver found"), std::string::npos);
}

TEST(ChooseDevice, refusesANamedDeviceThatCannotBeUsedWithTheReason)
{
    auto devices = workstation();
    devices[1].unusable = "it has no queue for compute";
    EXPECT_NE(errorOf("1", devices).find("cannot be used: it has no queue for compute"),
              std::string::npos);
}

}  // namespace
}  // namespace sahl::testing
