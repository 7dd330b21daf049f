#include "scene/gltf_file.h"

#include "scene/data_uri.h"
#include "util/gzip.h"

#include <algorithm>

namespace sahl {

namespace {

/// Extensions that the readers know; others must not be required.
const std::vector<std::string> KNOWN = {
    "KHR_lights_punctual",        "KHR_materials_emissive_strength", "KHR_materials_ior",
    "KHR_materials_transmission", "KHR_mesh_quantization",           "KHR_texture_transform",
};

bool isIn(const std::vector<std::string>& list, const std::string& word)
{
    return std::find(list.begin(), list.end(), word) != list.end();
}

std::vector<std::string> namesOf(const JsonObject& root, const std::string& key)
{
    std::vector<std::string> names;
    for (const JsonNode& item : itemsOf(root, key)) {
        if (item.kind != JsonNode::Kind::string) {
            throw errorAt(
                root.document(), item,
                fmt::format("\"{}\" must hold texts, found {}", key, kindName(item.kind)));
        }
        names.push_back(item.text);
    }
    return names;
}

void readExtensions(GltfFile& file)
{
    const JsonObject root = file.root();
    childOf(root, "extensions");
    file.extensions = namesOf(root, "extensionsUsed");
    for (const std::string& name : namesOf(root, "extensionsRequired")) {
        const JsonNode& place = root.at("extensionsRequired");
        if (!isIn(KNOWN, name)) {
            throw errorAt(
                file.document, place,
                fmt::format("the file requires the extension {}, which is not read", name));
        }
        if (!isIn(file.extensions, name)) {
            throw errorAt(
                file.document, place,
                fmt::format("the extension {} is required and not in extensionsUsed", name));
        }
    }
    std::string unknown;
    for (const std::string& name : file.extensions) {
        if (!isIn(KNOWN, name)) unknown += (unknown.empty() ? "" : ", ") + name;
    }
    if (!unknown.empty()) {
        warn(fmt::format("{}: extensions that are not read: {}", file.document.file,
                         unknown.substr(0, 400)));
    }
}

bool isWholeNumber(std::string_view text)
{
    return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

/// The text of "2.0" as major and minor; throws when it is something else.
std::pair<std::string, std::string> versionOf(const JsonObject& asset, const std::string& key)
{
    const std::string text = asset.string(key, "");
    const size_t dot = std::min(text.find('.'), text.size());
    const std::string major = text.substr(0, dot);
    const std::string minor = text.substr(std::min(dot + 1, text.size()));
    if (!isWholeNumber(major) || !isWholeNumber(minor)) {
        throw errorAt(
            asset.document(), asset.at(key),
            fmt::format("\"{}\" is \"{}\"; it must be like \"2.0\"", key, text.substr(0, 40)));
    }
    return {major, minor};
}

void checkVersion(const GltfFile& file)
{
    const JsonObject root = file.root();
    required(root, "asset");
    const JsonObject asset = *childOf(root, "asset");
    required(asset, "version");
    const auto [major, minor] = versionOf(asset, "version");
    if (major != "2") {
        throw errorAt(file.document, asset.at("version"),
                      fmt::format("glTF {}.{} is not read; only 2.0", major, minor));
    }
    if (asset.has("minVersion") &&
        versionOf(asset, "minVersion") != std::pair<std::string, std::string>("2", "0")) {
        throw errorAt(file.document, asset.at("minVersion"),
                      fmt::format("the file needs a reader of glTF {}; this one reads 2.0",
                                  asset.string("minVersion", "")));
    }
}

void readBuffer(GltfFile& file, const JsonNode& node, size_t index)
{
    const JsonObject buffer(file.document, node, fmt::format("buffer {}", index));
    const uint32_t length = requiredUint(buffer, "byteLength", 1, 0xffffffffu);
    std::span<const uint8_t> bytes;
    if (buffer.has("uri")) {
        bytes = readGltfUri(file, buffer);
    } else if (index == 0 && file.binary) {
        bytes = *file.binary;
    } else if (index == 0 && !file.glb.empty()) {
        throw errorAt(file.document, node,
                      "buffer 0 should be the binary part of the file, which has none");
    } else {
        file.buffers.push_back({});  // filled by an extension; views of it find it empty
        return;
    }
    if (bytes.size() < length) {
        throw errorAt(file.document, buffer.at("byteLength"),
                      fmt::format("buffer {} should have {} bytes; there are {}", index, length,
                                  bytes.size()));
    }
    file.buffers.push_back(bytes.first(length));
}

/// Each value takes a hundred times its place in the text, so their number has a bound of its own.
void requireFewValues(const std::string& text, const std::string& name)
{
    const auto values = static_cast<uint64_t>(std::count_if(
        text.begin(), text.end(), [](char c) { return c == ',' || c == '[' || c == '{'; }));
    if (values > MAX_GLTF_VALUES) {
        throw badInput("{}: more than {} values in the JSON", name, MAX_GLTF_VALUES);
    }
}

}  // namespace

std::span<const uint8_t> readGltfUri(GltfFile& file, const JsonObject& object)
{
    const std::string uri = object.string("uri", "");
    const std::string where = fmt::format(
        "{}: \"uri\" of {}", file.document.where(object.at("uri").offset), object.what());
    if (isDataUri(uri)) return file.written.emplace_back(readDataUri(uri, where));
    const std::string name = fileNameOfUri(uri, where);
    const auto known = file.files.find(name);
    if (known != file.files.end()) return known->second;
    const fs::path path = resolvePath(file.policy, folderOf(file.path), name, where);
    return file.files[name] = readFile(path, MAX_GLTF_BYTES);
}

void readGltfFile(GltfFile& file, const fs::path& path, const PathPolicy& policy)
{
    file.path = path;
    file.policy = policy;
    file.glb = readUnpacked(path, MAX_GLTF_BYTES);
    const std::string name = path.string();
    const bool isBinary =
        withoutGz(path).extension() == ".glb" ||
        (file.glb.size() >= 4 && std::equal(file.glb.begin(), file.glb.begin() + 4, "glTF"));
    std::string text;
    if (isBinary) {
        text = readGlbChunks(file);
    } else {
        if (file.glb.size() > MAX_GLTF_JSON_BYTES)
            throw badInput("{}: more than {} bytes of JSON", name, MAX_GLTF_JSON_BYTES);
        text.assign(file.glb.begin(), file.glb.end());
        file.glb = {};
    }
    requireFewValues(text, name);
    file.document = parseJson(name, text);
    checkVersion(file);
    readExtensions(file);
    const auto& buffers = itemsOf(file.root(), "buffers");
    for (size_t i = 0; i < buffers.size(); i++) readBuffer(file, buffers[i], i);
    readGltfViews(file);
    readGltfAccessors(file);
}

bool usesExtension(const GltfFile& file, const std::string& name)
{
    return isIn(file.extensions, name);
}

void leaveOut(GltfFile& file, const std::string& what)
{
    file.omitted[what]++;
}

void tellOmissions(const GltfFile& file)
{
    for (const auto& [what, count] : file.omitted) {
        const std::string times = count > 1 ? fmt::format(" ({} times)", count) : "";
        warn(fmt::format("{}: {}{}", file.document.file, what, times));
    }
}

}  // namespace sahl
