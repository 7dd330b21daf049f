// Nested JSON back into a scene: its description is parsed by itself, the rest event by event.
#include "saved/saved_scene.h"

#include "saved/check.h"
#include "saved/description.h"
#include "saved/struct_json.h"
#include "saved/tree_json_sax.h"

#include <algorithm>

namespace sahl {

namespace {

constexpr uint64_t MAX_TREE_BYTES = uint64_t{2} << 30;

/// The value of "scene" in the bytes from `begin` to `end`. What stands in front of it becomes
/// blanks, so that messages name the right line and column. Returns the camera as it was saved.
Camera readScene(const std::string& file, std::string_view all, size_t begin, size_t end,
                 const SceneOptions& options, PreparedScene& prepared)
{
    std::string text(all.substr(0, end));
    std::replace_if(
        text.begin(), text.begin() + static_cast<std::ptrdiff_t>(begin),
        [](char c) { return c != '\n'; }, ' ');
    const JsonDocument document = parseJson(file, text);
    const Camera saved =
        readDescription(document, {"materials", "textures", "lights", "objectStarts"}, options, prepared);
    Scene& scene = prepared.scene;
    const JsonNode& root = document.root;
    for (size_t i = 0; i < root.keys.size(); i++) {
        const std::string& name = root.keys[i].name;
        if (name != "materials" && name != "textures" && name != "lights" && name != "objectStarts") continue;
        for (const JsonNode& item : readArray(document, root.items[i], "\"" + name + "\"")) {
            if (name == "materials") {
                scene.materials.push_back(
                    readMaterialJson(document, item, scene.materialNames.emplace_back()));
            } else if (name == "textures") {
                scene.textures.push_back(readTextureJson(document, item));
            } else if (name == "lights") {
                scene.lights.push_back(readLightJson(document, item));
            } else {
                scene.objectStarts.push_back(
                    readUint(document, item, "an object's start", 0, MAX_PRIMITIVES));
            }
        }
    }
    return saved;
}

}  // namespace

PreparedScene loadTreeJson(const fs::path& path, const SceneOptions& options)
{
    const std::string file = path.string();
    const MappedFile mapped(path, MAX_TREE_BYTES);
    const std::string_view text(reinterpret_cast<const char*>(mapped.bytes().data()),
                                mapped.bytes().size());
    PreparedScene prepared;
    prepared.scene.name = file;
    Camera saved = {};
    auto readDescribed = [&](size_t begin, size_t end) {
        saved = readScene(file, text, begin, end, options, prepared);
    };
    TreeEvents(file, text, readDescribed, prepared).read();
    requireReach(prepared, saved);
    const DeviceScene scene = prepared.deviceScene();
    checkArrays(file, scene, prepared.bvh.rootRef, prepared.scene.objectStarts);
    checkFrame(file, scene.frame, scene.probeTexels.size());
    replaceProbe(options, prepared);
    prepareWideTrees(prepared);
    prepareLights(prepared);
    return prepared;
}

}  // namespace sahl
