// Where what can be made again is kept.
#pragma once

#include <filesystem>

namespace sahl {

/// The folder `sahl` of the user's cache: in $XDG_CACHE_HOME, else in ~/.cache. Empty where neither
/// that nor HOME is set. It need not exist.
std::filesystem::path cacheFolder();

}  // namespace sahl
