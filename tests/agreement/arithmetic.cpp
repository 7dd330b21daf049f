// Do the device's floats round as C++'s do, and does the NoContraction step of the build do its work?

#include "agreement/agreement_spirv.h"
#include "support/device_test.h"
#include "vulkan/run_compute.h"

#include <random>

namespace sahl::testing {
namespace {

constexpr size_t INPUTS = 1 << 16;

class Arithmetic : public DeviceTest {
protected:
    std::vector<float> run(std::span<const uint32_t> spirv)
    {
        std::vector<float> outputs(INPUTS * 2);
        auto context = openFirstContext();
        ComputeParameters parameters;
        parameters.groups = {INPUTS / 64, 1, 1};
        runCompute(*context, spirv,
                   {std::as_writable_bytes(std::span(inputs_)), std::as_writable_bytes(std::span(outputs))},
                   parameters);
        return outputs;
    }

    /// Number of outputs, of expression 0 and 1, that differ from C++ in any bit.
    std::array<int, 2> differences(const std::vector<float>& outputs)
    {
        std::array<int, 2> count = {};
        for (size_t i = 0; i < INPUTS; i++) {
            float x = inputs_[i * 4], y = inputs_[i * 4 + 1], z = inputs_[i * 4 + 2], w = inputs_[i * 4 + 3];
            float first = x * y + y * z + z * x;
            float second = w + (0.2126f * (x * y) + 0.7152f * (y * z) + 0.0722f * (z * x));
            count[0] += !sameBits(outputs[i * 2], first);
            count[1] += !sameBits(outputs[i * 2 + 1], second);
        }
        return count;
    }

    void SetUp() override
    {
        DeviceTest::SetUp();
        std::mt19937 random(1);
        std::uniform_real_distribution<float> uniform(-1, 1);
        for (float& value : inputs_) value = uniform(random);
    }

    std::vector<float> inputs_ = std::vector<float>(INPUTS * 4);
};

TEST_F(Arithmetic, decoratedExpressionsAreTheSameBitsAsInCpp)
{
    auto differing = differences(run(testSpirv("canary_exact")));
    EXPECT_EQ(differing[0], 0);
    EXPECT_EQ(differing[1], 0);
}

TEST_F(Arithmetic, undecoratedExpressionsAreOtherInstructionsAndDifferOnLavapipe)
{
    // Without this the test above would pass even if the build's step did nothing.
    auto raw = testSpirv("canary_raw");
    auto exact = testSpirv("canary_exact");
    EXPECT_GT(exact.size(), raw.size()) << "nothing was decorated";
    auto differing = differences(run(raw));
    // Other drivers are free to leave undecorated expressions as they are written.
    bool rearranges = openFirstContext()->physical.driverId == VK_DRIVER_ID_MESA_LLVMPIPE;
    EXPECT_GE(differing[0] + differing[1], rearranges ? 1 : 0);
}

}  // namespace
}  // namespace sahl::testing
