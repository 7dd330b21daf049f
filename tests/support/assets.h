// Where the test pictures and meshes lie that are too large for this repository.
#pragma once

#include "support/source_folder.h"

#include <cstdlib>
#include <filesystem>

namespace sahl::testing {

/// $SAHL_ASSETS, or ../shared/assets beside the source tree.
inline std::filesystem::path assetFolder()
{
    if (const char* folder = std::getenv("SAHL_ASSETS")) return folder;
    return sourceFolder() / "../shared/assets";
}

}  // namespace sahl::testing

/// Skips the test when the folder of assets does not have `name`.
#define SAHL_REQUIRE_ASSET(name)                                                                   \
    if (!std::filesystem::exists(sahl::testing::assetFolder() / (name))) {                         \
        GTEST_SKIP() << "missing: " << (name) << " (set SAHL_ASSETS)";                             \
    }
