// GLB: glTF's binary container. A header, a part of JSON text, and perhaps a part for buffer 0.
#include "scene/gltf_file.h"

#include <algorithm>

namespace sahl {

namespace {

constexpr uint32_t MAGIC = 0x46546c67;       // "glTF"
constexpr uint32_t JSON_CHUNK = 0x4e4f534a;  // "JSON"
constexpr uint32_t BIN_CHUNK = 0x004e4942;   // "BIN"
constexpr size_t HEADER_BYTES = 12;
constexpr size_t CHUNK_HEADER_BYTES = 8;

uint32_t wordAt(std::span<const uint8_t> bytes, size_t offset)
{
    return static_cast<uint32_t>(bytes[offset]) | static_cast<uint32_t>(bytes[offset + 1]) << 8 |
           static_cast<uint32_t>(bytes[offset + 2]) << 16 |
           static_cast<uint32_t>(bytes[offset + 3]) << 24;
}

/// The bytes that the header announces.
std::span<const uint8_t> checkHeader(std::span<const uint8_t> bytes, const std::string& name)
{
    if (bytes.size() >= 4 && wordAt(bytes, 0) != MAGIC) {
        throw badInput("{}: no GLB file: it does not begin with \"glTF\"", name);
    }
    if (bytes.size() < HEADER_BYTES) {
        throw badInput("{}: {} bytes are too few for a GLB file", name, bytes.size());
    }
    if (wordAt(bytes, 4) != 2) {
        throw badInput("{}: GLB version {} is not read; only 2", name, wordAt(bytes, 4));
    }
    const uint32_t length = wordAt(bytes, 8);
    if (length > bytes.size()) {
        throw badInput("{}: cut short: {} bytes of {}", name, bytes.size(), length);
    }
    if (length < HEADER_BYTES + CHUNK_HEADER_BYTES) {
        throw badInput("{}: the header says that the file has {} bytes; it has no JSON", name,
                       length);
    }
    if (length < bytes.size()) {
        warn(fmt::format("{}: {} bytes behind the end were left out", name, bytes.size() - length));
    }
    return bytes.first(length);
}

}  // namespace

std::string readGlbChunks(GltfFile& file)
{
    const std::string name = file.path.string();
    const std::span<const uint8_t> bytes = checkHeader(file.glb, name);
    std::string json;
    size_t chunk = 0;
    for (size_t at = HEADER_BYTES; at < bytes.size(); chunk++) {
        if (bytes.size() - at < CHUNK_HEADER_BYTES) {
            throw badInput("{}: part {} is cut short: {} bytes of its header", name, chunk,
                           bytes.size() - at);
        }
        const uint32_t length = wordAt(bytes, at);
        const uint32_t type = wordAt(bytes, at + 4);
        at += CHUNK_HEADER_BYTES;
        if (length > bytes.size() - at) {
            throw badInput("{}: part {} should have {} bytes; there are {}", name, chunk, length,
                           bytes.size() - at);
        }
        if (length % 4 != 0) {
            throw badInput("{}: part {} has {} bytes, which is no multiple of 4", name, chunk,
                           length);
        }
        if ((chunk == 0) != (type == JSON_CHUNK) || (type == BIN_CHUNK && chunk != 1)) {
            throw badInput(
                "{}: part {} is of type {:#010x}; the first must be JSON, the second may be "
                "BIN, and there is one of each at most",
                name, chunk, type);
        }
        const std::span<const uint8_t> content = bytes.subspan(at, length);
        if (type == JSON_CHUNK) {
            if (length > MAX_GLTF_JSON_BYTES)
                throw badInput("{}: more than {} bytes of JSON", name, MAX_GLTF_JSON_BYTES);
            json.assign(content.begin(), content.end());
        } else if (type == BIN_CHUNK) {
            file.binary = content;
        } else {
            leaveOut(file, "a part of an unknown type is left out");
        }
        at += length;
    }
    return json;
}

}  // namespace sahl
