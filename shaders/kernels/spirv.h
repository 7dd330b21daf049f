// The compiled kernels, part of the binary. C++ only.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace sahl {

/// SPIR-V of a kernel: "path_texel", "path_storage", "first_hits_texel", "first_hits_storage" (see
/// kernels/path.comp), "trace_rays_texel" and so on, or "math_probe".
std::span<const uint32_t> kernelSpirv(std::string_view name);

}  // namespace sahl
