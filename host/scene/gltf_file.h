// glTF files as containers: the JSON, the buffers that it names, the views of them and the
// accessors that say how numbers lie in views. All of it is checked here, so that reading a number
// cannot fail.
//
// Written here since no library that Debian packages checks what it hands on: tinygltf 2.7 knows
// neither lines nor the ends of views.
#pragma once

#include "scene/gltf_json.h"
#include "scene/path_policy.h"

#include <map>
#include <span>
#include <vector>

namespace sahl {

// accessor.componentType
constexpr uint32_t GLTF_BYTE = 5120;
constexpr uint32_t GLTF_UBYTE = 5121;
constexpr uint32_t GLTF_SHORT = 5122;
constexpr uint32_t GLTF_USHORT = 5123;
constexpr uint32_t GLTF_UINT = 5125;
constexpr uint32_t GLTF_FLOAT = 5126;

/// A part of a buffer.
struct GltfView {
    std::string what;  ///< "buffer view 3", for messages
    std::span<const uint8_t> bytes;
    uint32_t offset = 0;  ///< in the buffer [bytes]
    uint32_t stride = 0;  ///< from one element to the next [bytes]; 0: they are packed
};

/// Numbers in a buffer, all of them within it.
struct GltfNumbers {
    const uint8_t* first = nullptr;
    uint32_t stride = 0;  ///< from one element to the next [bytes]
    uint32_t componentType = GLTF_FLOAT;
};

/// Elements of an accessor that have other values than those in its view.
struct GltfSparse {
    uint32_t count = 0;
    GltfNumbers indices;  ///< of the elements, rising
    GltfNumbers values;
};

struct GltfAccessor {
    std::string what;  ///< "accessor 3", for messages
    const JsonNode* node = nullptr;
    std::string type;         ///< "SCALAR", "VEC2" ...
    uint32_t components = 1;  ///< of an element
    uint32_t count = 0;       ///< of elements
    bool normalized = false;  ///< whole numbers stand for [0,1] or [-1,1]
    std::optional<uint32_t> view;
    GltfNumbers numbers;  ///< first == nullptr: all are zero
    std::optional<GltfSparse> sparse;
};

struct GltfFile {
    fs::path path;
    PathPolicy policy;
    std::vector<uint8_t> glb;                        ///< the whole of a binary file
    std::optional<std::span<const uint8_t>> binary;  ///< its second part
    JsonDocument document;
    std::map<std::string, std::vector<uint8_t>> files;  ///< that buffers name, by name
    std::vector<std::vector<uint8_t>> written;          ///< content of data: URIs
    std::vector<std::span<const uint8_t>> buffers;
    std::vector<GltfView> views;
    std::vector<GltfAccessor> accessors;
    std::vector<std::string> extensions;      ///< extensionsUsed
    std::map<std::string, uint64_t> omitted;  ///< what was left out, and how often

    GltfFile() = default;
    GltfFile(const GltfFile&) = delete;  // spans and pointers into itself
    GltfFile& operator=(const GltfFile&) = delete;

    JsonObject root() const { return {document, document.root, "the file"}; }
};

/// Reads a .gltf or .glb file, what it contains deciding, and the buffers that it names. Throws
/// badInput with file, line and column: what JSON, container, buffers, views or accessors are not
/// allowed to be, another version than 2.x, extensions that are required and not known.
void readGltfFile(GltfFile& file, const fs::path& path, const PathPolicy& policy);

/// The parts of a GLB file's bytes, left in file.glb: JSON text (returned) and binary part.
std::string readGlbChunks(GltfFile& file);

/// Reads "bufferViews" and "accessors".
void readGltfViews(GltfFile& file);
void readGltfAccessors(GltfFile& file);

/// The bytes behind a URI of `object`, named in messages; data: URIs stay in file.written.
std::span<const uint8_t> readGltfUri(GltfFile& file, const JsonObject& object);

/// A component of an element of an accessor, turned into [-1,1] when it is normalized. Both must be
/// in range. Floats may be anything, not finite ones included.
double gltfNumber(const GltfAccessor& accessor, uint32_t element, uint32_t component);

/// Whether the file says that it uses an extension.
bool usesExtension(const GltfFile& file, const std::string& name);

/// Counts something that is left out, told once at the end: "points and lines are left out".
void leaveOut(GltfFile& file, const std::string& what);
void tellOmissions(const GltfFile& file);

constexpr uint64_t MAX_GLTF_BYTES = 0xffffffffu;  ///< of one file
constexpr uint64_t MAX_GLTF_JSON_BYTES = uint64_t{256} << 20;
constexpr uint64_t MAX_GLTF_VALUES = uint64_t{1} << 22;  ///< in the JSON
constexpr uint32_t MAX_ZERO_ELEMENTS = 1u << 20;         ///< of an accessor that has no view

}  // namespace sahl
