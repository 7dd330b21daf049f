#include "scene/path_policy.h"

#include "util/error.h"

#include <algorithm>

namespace sahl {

namespace {

/// Absolute path without links and dots; throws badInput starting with `where` on a loop of links.
fs::path canonical(const fs::path& path, const std::string& where)
{
    std::error_code error;
    fs::path absolute = fs::absolute(path, error);
    fs::path result = error ? fs::path() : fs::weakly_canonical(absolute, error);
    if (error) throw badInput("{}: {}: {}", where, path.string(), error.message());
    // A trailing slash would leave an empty last element, which no file inside has.
    return result.has_filename() ? result : result.parent_path();
}

bool isWithin(const fs::path& folder, const fs::path& file)
{
    auto [end, unused] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
    return end == folder.end();
}

}  // namespace

fs::path resolvePath(const PathPolicy& policy, const fs::path& base, const std::string& name,
                     const std::string& where)
{
    if (name.empty()) throw badInput("{}: the file name is empty", where);
    if (name.find('\0') != std::string::npos) {
        throw badInput("{}: the file name contains a zero byte", where);
    }
    fs::path file = canonical(base / name, where);
    if (isWithin(canonical(policy.root, where), file)) return base / name;
    for (const fs::path& folder : policy.allowed) {
        if (isWithin(canonical(folder, where), file)) return base / name;
    }
    throw badInput("{}: \"{}\" lies outside the scene's folder; --allow-path {} permits it", where,
                   name, folderOf(file).string());
}

fs::path folderOf(const fs::path& file)
{
    return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

}  // namespace sahl
