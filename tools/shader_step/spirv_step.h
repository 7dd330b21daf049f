// What the build does to every SPIR-V module of the path tracer before it is embedded.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace sahl::shader_step {

/// Float instructions that the module holds and that are not promised to give the same bits
/// everywhere (dot products, matrix products, fma, built-in functions other than floor and sqrt, 64-bit
/// floats, ...), one line each. Empty when the module is fine. Throws std::runtime_error when it is
/// no SPIR-V module.
std::vector<std::string> refusedInstructions(const std::vector<uint32_t>& module);

/// The module with every float + - * / and negation decorated NoContraction: a driver may then
/// neither rearrange nor fuse them.
std::vector<uint32_t> decoratedNoContraction(const std::vector<uint32_t>& module);

}  // namespace sahl::shader_step
