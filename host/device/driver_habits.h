// What drivers do that kernels must know of.
#pragma once

#include <cstdlib>
#include <string>

namespace sahl {

/// Whether it is Mesa's lavapipe of version 25 or later. Versions between 22.3, which was measured, and 25.0, which was
/// too, are taken to be as the former.
///   driver  as in DeviceInfo
inline bool isNewLavapipe(const std::string& driver)
{
    constexpr int FIRST_NEW = 25;
    const std::string mesa = "llvmpipe Mesa ";
    return driver.starts_with(mesa) && std::atoi(driver.c_str() + mesa.size()) >= FIRST_NEW;
}

/// Whether the driver compiles a kernel again for every command buffer where branches depend on uniforms
/// (kernels/uniforms.glsl). Mesa's lavapipe did in 22.3; 25.0 keeps what it compiles for the values of the uniforms,
/// which gains a few per cent.
inline bool compilesForUniforms(const std::string& driver)
{
    return driver.starts_with("llvmpipe Mesa ") && !isNewLavapipe(driver);
}

/// Whether the driver reads a texel of a buffer by a call of a function, for which its caller saves what it holds in
/// registers, as Mesa's lavapipe does: there nodes and primitives are images (kernels/device.glsl). 22.3 reads these in
/// place, 25.0 by functions as well: with images rays take 6 % fewer instructions on both.
inline bool callsForTexels(const std::string& driver) { return driver.starts_with("llvmpipe Mesa "); }

/// Whether the driver may end a loop before its own condition does, as Mesa's llvmpipe does after 65,535 turns. Those of
/// which nobody knows are taken to do so.
inline bool mayCutLoops(const std::string& driver) { return !driver.starts_with("NVIDIA "); }

}  // namespace sahl
