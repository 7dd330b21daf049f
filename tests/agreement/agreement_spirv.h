// The test kernels of this folder, compiled by the build.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace sahl {

/// "canary_raw" (as glslang gives it), "canary_exact" (after the build's NoContraction step), "structs", "exact_math".
std::span<const uint32_t> testSpirv(std::string_view name);

}  // namespace sahl
