// The binary form: which sections there are, and how they become a scene again.
#include "saved/saved_scene.h"

#include "saved/check.h"
#include "saved/container.h"
#include "saved/description.h"
#include "scene/json_fields.h"

#include <algorithm>
#include <cstring>
#include <set>

namespace sahl {

namespace {

/// "scene" holds the description as JSON text; every other section an array.
constexpr const char* DESCRIPTION_SECTION = "scene";

/// The arrays of a scene, wherever they lie.
struct SavedArrays {
    DeviceScene device;  ///< without its frame
    std::span<const uint32_t> objectStarts;
};

/// action(name, span) for every array. A new one needs a line here (and checks in check.cpp).
template <class Action>
void forEachArray(SavedArrays& arrays, Action action)
{
    action("nodes", arrays.device.nodes);
    action("primitives", arrays.device.primitives);
    action("corners", arrays.device.triangleCorners);
    action("materials", arrays.device.materials);
    action("lights", arrays.device.lights);
    action("texels", arrays.device.probeTexels);
    action("textures", arrays.device.textures);
    action("textureTexels", arrays.device.textureTexels);
    action("instances", arrays.device.instances);
    action("objectStarts", arrays.objectStarts);
}

/// Finds sections by name, once each.
class Sections {
public:
    Sections(const std::string& file, std::span<const std::byte> bytes)
        : file_(file), sections_(readContainer(file, bytes))
    {
        std::set<std::string> names;
        for (const Section& section : sections_) {
            if (!names.insert(section.name).second) {
                throw damaged(file, section.name, "there are two of this name");
            }
        }
    }

    std::span<const std::byte> take(const std::string& name, size_t elementBytes)
    {
        const auto found = std::find_if(sections_.begin(), sections_.end(),
                                        [&](const Section& s) { return s.name == name; });
        if (found == sections_.end()) throw damaged(file_, name, "it is missing");
        if (found->elementBytes != elementBytes) {
            throw damaged(
                file_, name,
                fmt::format("its elements have {} bytes, {} are expected: another version "
                            "of the program wrote it",
                            found->elementBytes, elementBytes));
        }
        const std::span<const std::byte> bytes = found->bytes;
        sections_.erase(found);
        return bytes;
    }

    void requireAllTaken() const
    {
        if (!sections_.empty()) {
            throw damaged(file_, sections_[0].name, "this program does not know it");
        }
    }

private:
    std::string file_;
    std::vector<Section> sections_;
};

SavedArrays takeArrays(Sections& sections)
{
    SavedArrays arrays;
    forEachArray(arrays, [&]<class Element>(const char* name, std::span<const Element>& array) {
        static_assert(alignof(Element) <= SECTION_ALIGNMENT);
        const std::span<const std::byte> bytes = sections.take(name, sizeof(Element));
        array = {reinterpret_cast<const Element*>(bytes.data()), bytes.size() / sizeof(Element)};
    });
    return arrays;
}

JsonDocument parseDescription(const std::string& file, std::span<const std::byte> bytes)
{
    const std::string place = file + ": section 'scene'";
    if (bytes.size() > MAX_JSON_BYTES) {
        throw damaged(
            file, DESCRIPTION_SECTION,
            fmt::format("it has {} bytes, at most {} are read", bytes.size(), MAX_JSON_BYTES));
    }
    return parseJson(place, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

void readMaterialNames(const JsonDocument& document, PreparedScene& prepared)
{
    const JsonNode* names = nullptr;
    for (size_t i = 0; i < document.root.keys.size(); i++) {
        if (document.root.keys[i].name == "materialNames") names = &document.root.items[i];
    }
    for (const JsonNode& name : readArray(document, *names, "\"materialNames\"")) {
        if (name.kind != JsonNode::Kind::string) {
            throw errorAt(document, name, "a material's name must be a text");
        }
        prepared.scene.materialNames.push_back(name.text);
    }
    const size_t materials = prepared.borrowed->materials.size();
    if (prepared.scene.materialNames.size() != materials) {
        throw errorAt(document, *names,
                      fmt::format("{} names of {} materials", prepared.scene.materialNames.size(),
                                  materials));
    }
}

}  // namespace

void writeSavedScene(const PreparedScene& prepared, const fs::path& path)
{
    nlohmann::ordered_json description = describe(prepared);
    description["materialNames"] = prepared.scene.materialNames;
    const std::string text =
        description.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    if (text.size() > MAX_JSON_BYTES) {
        throw badInput("{}: the names of its materials take {} bytes, too many to be saved",
                       prepared.scene.name, text.size());
    }
    std::vector<Section> sections = {{DESCRIPTION_SECTION, std::as_bytes(std::span(text)), 1}};
    SavedArrays arrays = {prepared.deviceScene(), prepared.scene.objectStarts};
    arrays.device.lights = prepared.sceneLights();
    forEachArray(arrays, [&]<class Element>(const char* name, std::span<const Element> array) {
        sections.push_back({name, std::as_bytes(array), sizeof(Element)});
    });
    writeContainer(path, sections);
}

PreparedScene loadSavedScene(const fs::path& path, const SceneOptions& options)
{
    const std::string file = path.string();
    PreparedScene prepared;
    prepared.file = std::make_shared<const MappedFile>(path);
    Sections sections(file, prepared.file->bytes());
    const JsonDocument description = parseDescription(file, sections.take(DESCRIPTION_SECTION, 1));
    SavedArrays arrays = takeArrays(sections);
    sections.requireAllTaken();

    prepared.borrowed = arrays.device;
    prepared.scene.name = file;
    const Camera saved = readDescription(description, {"materialNames"}, options, prepared);
    requireReach(prepared, saved);
    readMaterialNames(description, prepared);
    BvhStatistics& tree = prepared.bvh.statistics;
    const BvhStatistics found =
        checkArrays(file, arrays.device, prepared.bvh.rootRef, arrays.objectStarts);
    tree.innerNodes = found.innerNodes;
    tree.leaves = found.leaves;
    tree.depth = found.depth;
    tree.largestLeaf = found.largestLeaf;
    tree.primitivesSeen = found.primitivesSeen;
    prepared.scene.objectStarts.assign(arrays.objectStarts.begin(), arrays.objectStarts.end());
    const DeviceScene scene = prepared.deviceScene();
    checkFrame(file, scene.frame, scene.probeTexels.size());
    replaceProbe(options, prepared);
    prepareWideTrees(prepared);
    prepareLights(prepared);
    return prepared;
}

}  // namespace sahl
