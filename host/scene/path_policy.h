// Which files a scene may name: those in its own folder, and in folders that the user allowed.
#pragma once

#include "util/files.h"

#include <string>
#include <vector>

namespace sahl {

struct PathPolicy {
    fs::path root;                  ///< folder of the scene file
    std::vector<fs::path> allowed;  ///< further folders (or single files)
};

/// The file that `name`, written in a file of folder `base`, stands for. Symbolic links are
/// followed before the comparison. Throws badInput that starts with `where` when the name is empty
/// or the file lies outside of what the policy permits. The file need not exist.
fs::path resolvePath(const PathPolicy& policy, const fs::path& base, const std::string& name,
                     const std::string& where);

/// Folder that a file lies in, "." for a bare name.
fs::path folderOf(const fs::path& file);

}  // namespace sahl
