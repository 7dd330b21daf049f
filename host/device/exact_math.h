// Whether a device divides and takes square roots as exactly as C++ does.
#pragma once

#include "device/device.h"
#include "vulkan/context.h"

#include <span>

namespace sahl {

/// True when the kernels must use the exact division and root of pathtrace/exact.glsl: as asked for,
/// or, for Math::automatic, when the device's own are not correctly rounded. Drivers that were
/// measured are known; others are tested here with 2^16 pairs, which takes milliseconds.
bool chooseExactMath(Context& context, DeviceOptions::Math wanted);

/// True when the device's own division and root give C++'s bits for 2^16 pairs: random mantissas and
/// exponents, and divisors just below a power of two, which approximations get wrong.
bool dividesExactly(Context& context);

/// True when results[i] is (x / y, square root of x) of operands[i], as C++ rounds them.
bool areExact(std::span<const glm::vec2> operands, std::span<const glm::vec2> results);

}  // namespace sahl
