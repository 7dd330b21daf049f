// Options that choose how trees are built.
#pragma once

#include "app/options.h"

namespace sahl {

/// Adds --bvh-build and --bvh-quality, in the group "Scene".
void addTreeOptions(CLI::App& command, CommonOptions& options);

}  // namespace sahl
