// Checks of the text that both compilers read, for what compiles in both and means different things.
#pragma once

#include <string>
#include <vector>

namespace sahl::shader_step {

/// Everything in a file of shaders/pathtrace/ that could make GPU and CPU differ or fail in one of
/// the compilers, as "file:line: what, and what to write instead". Empty when the text is fine.
std::vector<std::string> lintText(const std::string& file, const std::string& text);

}  // namespace sahl::shader_step
