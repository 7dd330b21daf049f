#include "util/cache_folder.h"

#include <cstdlib>

namespace sahl {

std::filesystem::path cacheFolder()
{
    const char* cache = std::getenv("XDG_CACHE_HOME");
    if (cache && *cache) return std::filesystem::path(cache) / "sahl";
    const char* home = std::getenv("HOME");
    return home && *home ? std::filesystem::path(home) / ".cache" / "sahl"
                         : std::filesystem::path();
}

}  // namespace sahl
