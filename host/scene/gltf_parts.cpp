// Reading "primitives": which accessors hold what.
#include "scene/gltf_parts.h"

#include <algorithm>

namespace sahl {

namespace {

bool isOneOf(uint32_t type, std::initializer_list<uint32_t> types)
{
    return std::find(types.begin(), types.end(), type) != types.end();
}

/// Whether positions, normals or texture coordinates may be of that kind: floats, or with
/// KHR_mesh_quantization whole numbers.
bool hasFormat(const GltfFile& file, const std::string& name, const GltfAccessor& accessor)
{
    const uint32_t type = accessor.numbers.componentType;
    const bool quantized = usesExtension(file, "KHR_mesh_quantization");
    const bool isSmall = isOneOf(type, {GLTF_BYTE, GLTF_UBYTE, GLTF_SHORT, GLTF_USHORT});
    if (name == "POSITION")
        return accessor.type == "VEC3" && (type == GLTF_FLOAT || (quantized && isSmall));
    if (name == "NORMAL") {
        const bool isSigned = isOneOf(type, {GLTF_BYTE, GLTF_SHORT}) && accessor.normalized;
        return accessor.type == "VEC3" && (type == GLTF_FLOAT || (quantized && isSigned));
    }
    const bool isShare = isOneOf(type, {GLTF_UBYTE, GLTF_USHORT}) && accessor.normalized;
    return accessor.type == "VEC2" && (type == GLTF_FLOAT || isShare || (quantized && isSmall));
}

/// Number of the set in "TEXCOORD_0"; nullopt for other names.
std::optional<uint32_t> setOf(const std::string& name)
{
    const std::string prefix = "TEXCOORD_";
    if (!name.starts_with(prefix)) return std::nullopt;
    const std::string digits = name.substr(prefix.size());
    const bool isNumber = !digits.empty() && digits.size() <= 3 &&
                          digits.find_first_not_of("0123456789") == std::string::npos &&
                          (digits.size() == 1 || digits[0] != '0');
    return isNumber ? std::optional(static_cast<uint32_t>(std::stoul(digits))) : std::nullopt;
}

/// The set of texture coordinates that the part's material uses; nullopt where it has no textures.
std::optional<uint32_t> texCoordSetOf(const GltfModel& model, const GltfPart& part)
{
    const GltfMaterial& material = model.materials[part.material];
    for (const auto* use : material.textures()) {
        if (*use) return (*use)->texCoord;
    }
    return std::nullopt;
}

void readAttribute(GltfModel& model, const JsonObject& attributes, const std::string& name,
                   GltfPart& part)
{
    GltfFile& file = model.file;
    const uint32_t index = requiredIndex(attributes, name, file.accessors.size(), "accessors");
    const GltfAccessor& accessor = file.accessors[index];
    const std::optional<uint32_t> set = setOf(name);
    if (name == "POSITION" || name == "NORMAL" || set) {
        if (!hasFormat(file, name, accessor)) {
            throw errorAt(
                file.document, attributes.at(name),
                fmt::format("{} of {} is {}, {} of component type {}{}, which is not allowed", name,
                            part.what, accessor.what, accessor.type, accessor.numbers.componentType,
                            usesExtension(file, "KHR_mesh_quantization")
                                ? ""
                                : " without KHR_mesh_quantization"));
        }
    }
    if (name == "POSITION") part.positions = &accessor;
    if (name == "NORMAL") part.normals = &accessor;
    if (name.starts_with("COLOR_")) leaveOut(file, "colours of vertices are not used");
    if (set && set == texCoordSetOf(model, part)) part.texCoords = &accessor;
}

/// All attributes have a value for each vertex.
void requireSameCounts(const GltfFile& file, const JsonObject& attributes, const GltfPart& part)
{
    const GltfAccessor* first = nullptr;
    for (const JsonKey& key : attributes.node().keys) {
        const GltfAccessor& accessor =
            file.accessors[requiredIndex(attributes, key.name, file.accessors.size(), "accessors")];
        if (!first) first = &accessor;
        if (accessor.count == first->count) continue;
        throw errorAt(
            file.document, attributes.node(),
            fmt::format("the attributes of {} have {} and {} values; they must have as many",
                        part.what, first->count, accessor.count));
    }
}

const GltfAccessor* readIndexAccessor(const GltfFile& file, const JsonObject& object,
                                      const GltfPart& part)
{
    const auto index = indexOf(object, "indices", file.accessors.size(), "accessors");
    if (!index) return nullptr;
    const GltfAccessor& indices = file.accessors[*index];
    const bool fits = indices.type == "SCALAR" && !indices.normalized &&
                      isOneOf(indices.numbers.componentType, {GLTF_UBYTE, GLTF_USHORT, GLTF_UINT});
    if (!fits) {
        throw errorAt(
            file.document, object.at("indices"),
            fmt::format("\"indices\" of {} is {}, {} of component type {}; it must be a SCALAR of "
                        "whole numbers without sign",
                        part.what, indices.what, indices.type, indices.numbers.componentType));
    }
    if (indices.view && file.views[*indices.view].stride > 0) {
        throw errorAt(file.document, object.at("indices"),
                      fmt::format("\"indices\" of {} is in {}, which must not have a stride",
                                  part.what, file.views[*indices.view].what));
    }
    return &indices;
}

GltfPart readPart(GltfModel& model, const JsonNode& node, const std::string& what)
{
    GltfFile& file = model.file;
    const JsonObject object(file.document, node, what);
    GltfPart part;
    part.what = what;
    part.mode = object.uint("mode", GLTF_TRIANGLES, 0, GLTF_TRIANGLE_FAN);
    const auto defaultMaterial = static_cast<uint32_t>(model.materials.size() - 1);
    part.material = indexOf(object, "material", model.materials.size() - 1, "materials")
                        .value_or(defaultMaterial);
    required(object, "attributes");
    const JsonObject attributes = *childOf(object, "attributes");
    for (const JsonKey& key : attributes.node().keys)
        readAttribute(model, attributes, key.name, part);
    requireSameCounts(file, attributes, part);
    if (texCoordSetOf(model, part) && !part.texCoords)
        leaveOut(file, "a mesh without texture coordinates shows one point of its textures");
    part.indices = readIndexAccessor(file, object, part);
    if (!itemsOf(object, "targets").empty())
        leaveOut(
            file,
            "morph targets are left out: their meshes keep the shape in which they are stored");
    return part;
}

}  // namespace

std::vector<GltfPart> readGltfParts(GltfModel& model, const JsonNode& node, size_t index)
{
    const JsonObject mesh(model.file.document, node, fmt::format("mesh {}", index));
    mesh.string("name", "");
    required(mesh, "primitives");
    std::vector<GltfPart> parts;
    for (const JsonNode& item : itemsOf(mesh, "primitives")) {
        const std::string what = fmt::format("primitive {} of {}", parts.size(), mesh.what());
        parts.push_back(readPart(model, item, what));
    }
    return parts;
}

}  // namespace sahl
