// What drivers do that kernels must know of.
#pragma once

#include <cstdlib>
#include <string>

namespace sahl {

/// Whether the driver compiles a kernel again for every command buffer where branches depend on uniforms
/// (kernels/uniforms.glsl). Mesa's lavapipe did in 22.3; 25.0 keeps what it compiles for the values of the uniforms,
/// which gains a few per cent. Versions between are taken to be as the former: where that is wrong it costs least.
///   driver  as in DeviceInfo
inline bool compilesForUniforms(const std::string& driver)
{
    constexpr int FIRST_THAT_KEEPS = 25;
    const std::string mesa = "llvmpipe Mesa ";
    return driver.starts_with(mesa) && std::atoi(driver.c_str() + mesa.size()) < FIRST_THAT_KEEPS;
}

}  // namespace sahl
