// glTF files for tests, written from JSON and numbers.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace sahl::testing {

/// The bytes of numbers, in a row.
template <class T>
std::string bytesOf(const std::vector<T>& numbers)
{
    std::string bytes(numbers.size() * sizeof(T), '\0');
    std::memcpy(bytes.data(), numbers.data(), bytes.size());
    return bytes;
}

inline std::string base64(const std::string& bytes)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t bits = 0;
        for (size_t k = 0; k < 3; k++)
            bits = bits << 8 | (i + k < bytes.size() ? static_cast<uint8_t>(bytes[i + k]) : 0u);
        for (size_t k = 0; k < 4; k++)
            text += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63];
    }
    return text;
}

/// A JSON glTF file with one buffer. `members` are those of the file but "asset" and "buffers".
inline std::string gltfText(const std::string& members, const std::string& buffer)
{
    return R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": )" +
           std::to_string(buffer.size()) + R"(, "uri": "data:application/octet-stream;base64,)" +
           base64(buffer) + "\"}], " + members + "}";
}

inline std::string wordOf(uint32_t word)
{
    return bytesOf(std::vector<uint32_t>{word});
}

/// A part of a GLB file, filled up to a multiple of 4 bytes.
inline std::string glbChunk(const std::string& type, std::string content)
{
    while (content.size() % 4 != 0) content += type == "JSON" ? ' ' : '\0';
    return wordOf(static_cast<uint32_t>(content.size())) + type + content;
}

inline std::string glbHeader(size_t size)
{
    return "glTF" + wordOf(2) + wordOf(static_cast<uint32_t>(size));
}

/// The binary file of the same content.
inline std::string glbBytes(const std::string& members, const std::string& buffer)
{
    const std::string json = R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": )" +
                             std::to_string(buffer.size()) + "}], " + members + "}";
    const std::string body = glbChunk("JSON", json) + glbChunk(std::string("BIN\0", 4), buffer);
    return glbHeader(12 + body.size()) + body;
}

/// A square in the plane z = 0 from (0,0) to (1,1), counter-clockwise from +z: corners, and indices
/// of two triangles behind them. Buffer view 0 and accessor 0 are the corners, 1 the indices.
inline std::string squareBuffer()
{
    return bytesOf<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}) +
           bytesOf<uint16_t>({0, 1, 2, 0, 2, 3});
}

inline std::string squareViews()
{
    return R"("bufferViews": [{"buffer": 0, "byteLength": 48},
                              {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
              "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                            {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}])";
}

/// Members of a file with the square as mesh 0, before nodes and more.
inline std::string squareMembers(const std::string& more)
{
    return squareViews() +
           R"(, "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}], )" +
           more;
}

inline std::string squareFile(const std::string& more)
{
    return gltfText(squareMembers(more), squareBuffer());
}

}  // namespace sahl::testing
