// PLY files for tests: the same items as text or as bytes of either order.
#pragma once

#include "scene/ply_header.h"

#include <fmt/format.h>

#include <bit>
#include <string>
#include <utility>
#include <vector>

namespace sahl::testing {

constexpr PlyFormat PLY_FORMATS[] = {PlyFormat::ascii, PlyFormat::littleEndian,
                                     PlyFormat::bigEndian};

/// A line of text, or the bytes that say the same.
using PlyItem = std::vector<std::pair<PlyType, double>>;

inline PlyItem floats(std::initializer_list<double> values)
{
    PlyItem item;
    for (double value : values) item.emplace_back(PlyType::float32, value);
    return item;
}

/// A list of ints behind a number of them that takes a byte.
inline PlyItem face(std::initializer_list<double> corners)
{
    PlyItem item = {{PlyType::uint8, double(corners.size())}};
    for (double corner : corners) item.emplace_back(PlyType::int32, corner);
    return item;
}

inline std::string plyBytes(PlyType type, double value, bool bigEndian)
{
    uint64_t bits = type == PlyType::float64   ? std::bit_cast<uint64_t>(value)
                    : type == PlyType::float32 ? std::bit_cast<uint32_t>(float(value))
                                               : static_cast<uint64_t>(static_cast<int64_t>(value));
    const size_t size = bytesOf(type);
    std::string bytes(size, '\0');
    for (size_t i = 0; i < size; i++, bits >>= 8) {
        bytes[bigEndian ? size - 1 - i : i] = static_cast<char>(bits & 255);
    }
    return bytes;
}

/// `elements`: the header's lines between "format" and "end_header".
inline std::string ply(PlyFormat format, const std::string& elements,
                       const std::vector<PlyItem>& items, const std::string& lineEnd = "\n")
{
    const char* names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    std::string header =
        fmt::format("ply\nformat {} 1.0\n{}end_header\n", names[int(format)], elements);
    std::string file;
    for (char c : header) file += c == '\n' ? lineEnd : std::string(1, c);
    for (const PlyItem& item : items) {
        for (const auto& [type, value] : item) {
            file += format == PlyFormat::ascii
                        ? fmt::format("{} ", value)
                        : plyBytes(type, value, format == PlyFormat::bigEndian);
        }
        if (format == PlyFormat::ascii) file += lineEnd;
    }
    return file;
}

/// The header's lines for vertices of floats x, y, z and faces of `face()`.
inline std::string plyElements(size_t vertices, size_t faces)
{
    return fmt::format("element vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
                       "element face {}\nproperty list uchar int vertex_indices\n",
                       vertices, faces);
}

}  // namespace sahl::testing
