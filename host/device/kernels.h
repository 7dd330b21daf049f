// The kernels as drivers get them: with their constants folded in.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace sahl {

/// SPIR-V of a kernel (kernels/spirv.h) made for `constants`, values of SPEC_*. Made once in a
/// process, and kept for later ones (kept_kernels.h). May be called from several threads.
std::span<const uint32_t> foldedKernel(const std::string& name,
                                       const std::vector<uint32_t>& constants);

}  // namespace sahl
