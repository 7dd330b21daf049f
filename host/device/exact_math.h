// Whether a device divides and takes square roots as exactly as C++ does.
#pragma once

#include "device/device.h"
#include "vulkan/context.h"

#include <vector>

namespace sahl {

/// How the kernels are to divide and take roots, one of MATH_*. Math::exact is by integers, which no device gets wrong.
/// Math::automatic is the device's own way where it is C++'s; else by fused multiply-add where the device has it, else by
/// integers. Drivers that were measured are known; others are tested here, which takes milliseconds.
uint32_t chooseMath(Context& context, DeviceOptions::Math wanted);

/// Pairs (a, b), and what a device makes of them: a / b, the square root of a, fusedQuotient(a, b) and the rounding error
/// of a * b as fused multiply-add tells it.
struct MathProbe {
    std::vector<glm::vec2> operands;
    std::vector<glm::vec4> results;
};

/// Of 2^16 pairs: random mantissas and exponents, and divisors just below a power of two, which approximations get wrong.
MathProbe probeMath(Context& context);

/// Whether the device's own division and root are C++'s.
bool areExact(const MathProbe& probe);

/// Whether multiply-add rounds once, and division by it is C++'s.
bool areFused(const MathProbe& probe);

}  // namespace sahl
