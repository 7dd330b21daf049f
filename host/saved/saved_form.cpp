// Which of the two forms a file has.
#include "saved/saved_scene.h"

#include <fstream>

namespace sahl {

SavedForm savedFormOf(const fs::path& path)
{
    const std::string extension = path.extension().string();
    if (extension == ".sahl" || extension == ".SAHL") return SavedForm::binary;
    std::error_code ignored;
    if (extension != ".json" || !fs::is_regular_file(path, ignored)) return SavedForm::none;
    // The key must be the first one, so that this looks at the beginning alone.
    std::string start(256, '\0');
    std::ifstream file(path, std::ios::binary);
    file.read(start.data(), static_cast<std::streamsize>(start.size()));
    start.resize(static_cast<size_t>(file.gcount()));
    std::erase_if(start, [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; });
    return start.starts_with("{\"sahlTree\":") ? SavedForm::json : SavedForm::none;
}

PreparedScene loadSaved(SavedForm form, const fs::path& path, const SceneOptions& options)
{
    return form == SavedForm::binary ? loadSavedScene(path, options) : loadTreeJson(path, options);
}

}  // namespace sahl
