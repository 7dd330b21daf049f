// The text in front of a PLY file: which elements follow, of which properties, in which format.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sahl {

enum class PlyFormat { ascii, littleEndian, bigEndian };

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

size_t bytesOf(PlyType type);

/// A value, or a list of values behind their number.
struct PlyProperty {
    std::string name;
    PlyType type = PlyType::float32;
    bool isList = false;
    PlyType countType = PlyType::uint8;  ///< of a list
};

struct PlyElement {
    std::string name;
    uint64_t count = 0;  ///< as the header says: not to be believed
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    PlyFormat format = PlyFormat::ascii;
    std::vector<PlyElement> elements;
    size_t bodyStart = 0;  ///< byte behind the header
    size_t lines = 0;      ///< of the header
};

/// Reads the header of a file that is given whole. Throws badInput naming `file` and line: another
/// format or version, unknown statements and types, elements or properties that are there twice.
PlyHeader readPlyHeader(std::string_view bytes, const std::string& file);

/// A piece of the file for a message: at most 40 characters in quotes, '?' for what would not
/// print.
std::string quoted(std::string_view text);

}  // namespace sahl
