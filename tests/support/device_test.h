// What tests on a Vulkan device share: they run with validation, and any message fails them.
#pragma once

#include "device/device.h"
#include "vulkan/context.h"

#include <gtest/gtest.h>

#include <cstring>

namespace sahl::testing {

/// Fixture of every test that uses a Vulkan device. The first device of the loader is used; which
/// driver that is, the test's environment decides. No device is a failure, never a skip.
class DeviceTest : public ::testing::Test {
protected:
    void SetUp() override { messagesBefore_ = validationMessageCount(); }
    void TearDown() override
    {
        EXPECT_EQ(validationMessageCount(), messagesBefore_) << "the validation layer spoke";
    }

    /// For tests that provoke the validation layer: messages up to now do not fail the test.
    void forgiveMessages() { messagesBefore_ = validationMessageCount(); }

    static std::unique_ptr<Context> openFirstContext()
    {
        auto instance = openInstance(true);
        return openContext(instance, physicalDevices(*instance).at(0));
    }

    static std::unique_ptr<Device> openFirstDevice(DeviceOptions options = {})
    {
        options.validation = true;
        return makeVulkanDevice(0, options);
    }

private:
    uint64_t messagesBefore_ = 0;
};

inline bool sameBits(float a, float b)
{
    return std::memcmp(&a, &b, sizeof(a)) == 0;
}

}  // namespace sahl::testing
