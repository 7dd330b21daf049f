// Specialisation constants put into a shader before a driver sees it. Software drivers compile
// every branch that a constant rules out, which takes seconds; folded here, such code is gone.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace sahl {

/// The module with its specialisation constants of ids 0, 1, 2, ... fixed at values[0], values[1],
/// ...; code that they rule out is left out. Functions are inlined and variables kept as values. No
/// float arithmetic is folded or rearranged. Throws deviceLost when the module cannot be read.
std::vector<uint32_t> foldedConstants(std::span<const uint32_t> spirv,
                                      std::span<const uint32_t> values);

/// What that does, in words: of other words the results may be others. Kept kernels are told apart by
/// them (device/kept_kernels.h), so that whoever changes what is done has to change these.
std::string foldingPasses();

}  // namespace sahl
