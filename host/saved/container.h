// The binary file as a container: a header, a table of named sections, and the sections' bytes.
// Knows nothing of what is in them.
#pragma once

#include "util/error.h"
#include "util/files.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sahl {

/// Sections begin at multiples of this [bytes]: enough for any of our structs, and a cache line.
constexpr uint64_t SECTION_ALIGNMENT = 64;
constexpr uint32_t SAVED_VERSION = 2;
constexpr uint32_t BYTE_ORDER_MARK = 0x01020304;

/// Like PNG's: shows transfers that change line ends or clear the eighth bit.
constexpr std::array<uint8_t, 8> SAVED_MAGIC = {0x89, 'S', 'A', 'H', 'L', '\r', '\n', 0x1a};

struct SavedHeader {
    std::array<uint8_t, 8> magic = SAVED_MAGIC;
    uint32_t byteOrder = BYTE_ORDER_MARK;
    uint32_t version = SAVED_VERSION;
    uint32_t headerBytes = 64;
    uint32_t entryBytes = 64;  ///< of an entry in the table, which follows the header
    uint32_t sectionCount = 0;
    uint32_t unused0 = 0;
    uint64_t fileBytes = 0;
    uint64_t hash = 0;  ///< XXH3 (64 bits) of header, with 0 in this place, and table
    std::array<uint64_t, 2> unused1 = {};
};
static_assert(sizeof(SavedHeader) == 64);

struct SavedEntry {
    std::array<char, 24> name = {};  ///< filled up with zeros, at least one
    uint64_t offset = 0;             ///< from the beginning of the file [bytes]
    uint64_t bytes = 0;
    uint32_t elementBytes = 0;
    uint32_t unused0 = 0;
    uint64_t hash = 0;  ///< XXH3 (64 bits) of the section's bytes
    uint64_t unused1 = 0;
};
static_assert(sizeof(SavedEntry) == 64);

struct Section {
    std::string name;
    std::span<const std::byte> bytes;
    uint32_t elementBytes = 0;
};

/// badInput with the place and what to do about it: "x.sahl: section 'nodes': <finding>; ...".
Error damaged(const std::string& file, const std::string& section, const std::string& finding);

/// Writes a file of these sections, in this order, each right behind the one before but for zeros
/// up to its alignment.
void writeContainer(const fs::path& path, std::span<const Section> sections);

/// The sections of a file: all bytes of it are accounted for, and every hash is right. Views into
/// `bytes`, which begin at a multiple of SECTION_ALIGNMENT.
std::vector<Section> readContainer(const std::string& file, std::span<const std::byte> bytes);

/// XXH3, 64 bits.
uint64_t hashOf(std::span<const std::byte> bytes);

}  // namespace sahl
