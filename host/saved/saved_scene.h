// Scenes saved together with their tree, so that they are loaded without building it: as one binary
// file that is read where it lies (.sahl), and as nested JSON for people and other programs. Both
// are described in docs/saved_scenes.md.
#pragma once

#include "render/prepare.h"

namespace sahl {

/// Writes scene and tree as one binary file, complete or not at all. The same scene gives the same
/// bytes. Throws cannotWrite; badInput when the scene has no description of its camera.
void writeSavedScene(const PreparedScene& prepared, const fs::path& path);

/// Loads a binary file without copying its arrays and checks all of it: hashes, layout, tree,
/// indices, numbers. Whatever passes can be rendered. `options` are honoured where the tree stays:
/// size, samples, bounces, seed, and another probe. Throws badInput naming file, section, finding
/// and help; usage for options that need the original scene.
PreparedScene loadSavedScene(const fs::path& path, const SceneOptions& options);

/// Writes scene and trees as nested JSON: groups are arrays, leaves are typed objects; an object that
/// instances place is written once. Throws as writeSavedScene does, and badInput for descriptions
/// that are too long to be read back.
void writeTreeJson(const PreparedScene& prepared, const fs::path& path);

/// Reads what writeTreeJson writes, or anything of that form, however deep, in bounded memory
/// beside the scene itself. Boxes are made from the leaves; the trees stay as they are.
/// `options` and errors as in loadSavedScene, with line and column.
PreparedScene loadTreeJson(const fs::path& path, const SceneOptions& options);

/// Whether `path` is to be loaded by one of the two functions above: by its extension .sahl, or a
/// .json file whose first key is "sahlTree". False for files that cannot be read.
enum class SavedForm { none, binary, json };
SavedForm savedFormOf(const fs::path& path);

/// Loads either of them. `form` is not SavedForm::none.
PreparedScene loadSaved(SavedForm form, const fs::path& path, const SceneOptions& options);

}  // namespace sahl
