#include "device/exact_math.h"

#include "kernels/spirv.h"
#include "vulkan/run_compute.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>

namespace sahl {

namespace {

constexpr uint32_t PAIRS = 1 << 16;
constexpr uint32_t GROUP = 64;  // invocations of math_probe.comp

/// A number in [2^-20, 2^20): neither operands nor results leave the range that Vulkan speaks of.
float anyNumber(std::mt19937& random)
{
    auto mantissa = static_cast<uint32_t>(random() & 0x007fffffu);
    auto exponent = static_cast<uint32_t>(107 + random() % 40);
    return std::bit_cast<float>(exponent << 23 | mantissa);
}

}  // namespace

bool areExact(std::span<const glm::vec2> operands, std::span<const glm::vec2> results)
{
    for (size_t i = 0; i < operands.size(); i++) {
        if (results[i].x != operands[i].x / operands[i].y) return false;
        if (results[i].y != std::sqrt(operands[i].x)) return false;
    }
    return true;
}

bool dividesExactly(Context& context)
{
    std::mt19937 random(1);
    constexpr uint32_t PAIR_BYTES = sizeof(glm::vec2);
    const uint32_t fitting = context.physical.properties.limits.maxStorageBufferRange / PAIR_BYTES;
    const uint32_t pairs = std::min(PAIRS, fitting / GROUP * GROUP);
    std::vector<glm::vec2> operands(pairs), results(pairs);
    for (uint32_t i = 0; i < pairs; i++) {
        operands[i] = {anyNumber(random), anyNumber(random)};
        if (i % 8 == 0) operands[i].y = std::bit_cast<float>(0x3f7fffffu - i / 8 % 16);
        if (i % 8 == 1) operands[i].x = 1;
    }
    ComputeParameters parameters;
    parameters.name = "math_probe";
    parameters.groups = {pairs / GROUP, 1, 1};
    runCompute(context, kernelSpirv("math_probe"),
               {std::as_writable_bytes(std::span(operands)), std::as_writable_bytes(std::span(results))},
               parameters);
    return areExact(operands, results);
}

bool chooseExactMath(Context& context, DeviceOptions::Math wanted)
{
    if (wanted != DeviceOptions::Math::automatic) return wanted == DeviceOptions::Math::exact;
    VkDriverId driver = context.physical.driverId;
    bool measured = driver == VK_DRIVER_ID_MESA_LLVMPIPE || driver == VK_DRIVER_ID_GOOGLE_SWIFTSHADER;
    return !measured && !dividesExactly(context);
}

}  // namespace sahl
