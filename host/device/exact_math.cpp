#include "device/exact_math.h"

#include "kernels/spirv.h"
#include "shared/bindings.h"
#include "vulkan/run_compute.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>
#include <utility>

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

bool areExact(const MathProbe& probe)
{
    for (size_t i = 0; i < probe.operands.size(); i++) {
        const auto [a, b] = std::pair(probe.operands[i].x, probe.operands[i].y);
        if (probe.results[i].x != a / b || probe.results[i].y != std::sqrt(a)) return false;
    }
    return true;
}

bool areFused(const MathProbe& probe)
{
    for (size_t i = 0; i < probe.operands.size(); i++) {
        const auto [a, b] = std::pair(probe.operands[i].x, probe.operands[i].y);
        if (probe.results[i].z != a / b || probe.results[i].w != std::fma(a, b, -(a * b))) return false;
    }
    return true;
}

MathProbe probeMath(Context& context)
{
    std::mt19937 random(1);
    constexpr uint32_t RESULT_BYTES = sizeof(glm::vec4);
    const uint32_t fitting = context.physical.properties.limits.maxStorageBufferRange / RESULT_BYTES;
    const uint32_t pairs = std::min(PAIRS, fitting / GROUP * GROUP);
    MathProbe probe;
    std::vector<glm::vec2>& operands = probe.operands;
    operands.resize(pairs);
    probe.results.resize(pairs);
    for (uint32_t i = 0; i < pairs; i++) {
        operands[i] = {anyNumber(random), anyNumber(random)};
        if (i % 8 == 0) operands[i].y = std::bit_cast<float>(0x3f7fffffu - i / 8 % 16);
        if (i % 8 == 1) operands[i].x = 1;
    }
    ComputeParameters parameters;
    parameters.name = "math_probe";
    parameters.groups = {pairs / GROUP, 1, 1};
    runCompute(context, kernelSpirv("math_probe"),
               {std::as_writable_bytes(std::span(operands)), std::as_writable_bytes(std::span(probe.results))},
               parameters);
    return probe;
}

uint32_t chooseMath(Context& context, DeviceOptions::Math wanted)
{
    using Math = DeviceOptions::Math;
    if (wanted == Math::exact) return MATH_INTEGERS;
    const VkDriverId driver = context.physical.driverId;
    const bool measured = driver == VK_DRIVER_ID_MESA_LLVMPIPE || driver == VK_DRIVER_ID_GOOGLE_SWIFTSHADER;
    if (wanted == Math::native || measured) return MATH_NATIVE;
    const MathProbe probe = probeMath(context);
    if (areExact(probe)) return MATH_NATIVE;
    return areFused(probe) ? MATH_FUSED : MATH_INTEGERS;
}

}  // namespace sahl
