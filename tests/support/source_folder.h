// Where tests find scenes and documents. Only one file is compiled with the path, so that the
// others are the same code wherever the project lies (compiler caches then find them again).
#pragma once

#include <filesystem>

namespace sahl::testing {

/// The root of the source tree, absolute.
std::filesystem::path sourceFolder();

}  // namespace sahl::testing
