#include "saved/container.h"

#include <xxhash.h>

#include <algorithm>
#include <cstring>

namespace sahl {

namespace {

uint64_t alignedUp(uint64_t offset)
{
    return (offset + SECTION_ALIGNMENT - 1) / SECTION_ALIGNMENT * SECTION_ALIGNMENT;
}

uint64_t headHash(SavedHeader header, std::span<const SavedEntry> table)
{
    header.hash = 0;
    std::vector<std::byte> bytes(sizeof(header) + table.size_bytes());
    std::memcpy(bytes.data(), &header, sizeof(header));
    if (!table.empty()) {
        std::memcpy(bytes.data() + sizeof(header), table.data(), table.size_bytes());
    }
    return hashOf(bytes);
}

void write(AtomicFile& file, std::span<const std::byte> bytes)
{
    file.write({reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()});
}

SavedEntry entryOf(const Section& section, uint64_t offset)
{
    SavedEntry entry;
    section.name.copy(entry.name.data(), entry.name.size() - 1);
    entry.offset = offset;
    entry.bytes = section.bytes.size();
    entry.elementBytes = section.elementBytes;
    entry.hash = hashOf(section.bytes);
    return entry;
}

Error unusable(const std::string& file, const std::string& finding)
{
    return badInput("{}: {}", file, finding);
}

/// The header, as far as it can be trusted before its hash is known to be right.
SavedHeader readHeader(const std::string& file, std::span<const std::byte> bytes)
{
    SavedHeader header;
    const size_t start = std::min(bytes.size(), SAVED_MAGIC.size());
    if (bytes.empty()) throw unusable(file, "is empty");
    if (std::memcmp(bytes.data(), SAVED_MAGIC.data(), start) != 0) {
        throw unusable(file,
                       "is not a saved scene of Sahl; make one with sahl bvh SCENE -o x.sahl");
    }
    if (bytes.size() < sizeof(header)) {
        throw unusable(file, fmt::format("has {} bytes, not even the {} of the header; it was cut "
                                         "short: copy or save it again",
                                         bytes.size(), sizeof(header)));
    }
    std::memcpy(&header, bytes.data(), sizeof(header));
    if (header.byteOrder != BYTE_ORDER_MARK) {
        throw damaged(
            file, "header",
            fmt::format("the byte order mark is {:08x}, {:08x} is expected: the file is of "
                        "a machine with another byte order, or damaged",
                        header.byteOrder, BYTE_ORDER_MARK));
    }
    if (header.version != SAVED_VERSION) {
        throw damaged(file, "header",
                      fmt::format("the format's version is {}, this program reads version {}",
                                  header.version, SAVED_VERSION));
    }
    if (header.headerBytes != sizeof(SavedHeader) || header.entryBytes != sizeof(SavedEntry)) {
        throw damaged(file, "header",
                      fmt::format("a header of {} and entries of {} bytes, {} and {} are expected",
                                  header.headerBytes, header.entryBytes, sizeof(SavedHeader),
                                  sizeof(SavedEntry)));
    }
    if (header.fileBytes != bytes.size()) {
        throw damaged(file, "header",
                      fmt::format("the file has {} bytes, {} are expected: it was cut short or "
                                  "something was added",
                                  bytes.size(), header.fileBytes));
    }
    return header;
}

std::vector<SavedEntry> readTable(const std::string& file, const SavedHeader& header,
                                  std::span<const std::byte> bytes)
{
    if (header.sectionCount > (bytes.size() - sizeof(header)) / sizeof(SavedEntry)) {
        throw damaged(file, "header",
                      fmt::format("{} sections do not fit into the file", header.sectionCount));
    }
    std::vector<SavedEntry> table(header.sectionCount);
    if (!table.empty()) {
        std::memcpy(table.data(), bytes.data() + sizeof(header), table.size() * sizeof(SavedEntry));
    }
    const uint64_t hash = headHash(header, table);
    if (hash != header.hash) {
        throw damaged(file, "header",
                      fmt::format("the hash of header and table is {:016x}, {:016x} is expected",
                                  hash, header.hash));
    }
    return table;
}

void requireZeros(const std::string& file, const std::string& before, uint64_t offset,
                  std::span<const std::byte> gap)
{
    for (size_t i = 0; i < gap.size(); i++) {
        if (gap[i] == std::byte{0}) continue;
        throw damaged(file, before,
                      fmt::format("the byte at {} in front of it is not zero", offset + i));
    }
}

/// The section of an entry, which must begin right behind byte `end` but for the alignment.
Section readSection(const std::string& file, const SavedEntry& entry, uint64_t end,
                    std::span<const std::byte> bytes)
{
    Section section;
    const auto zero = std::find(entry.name.begin(), entry.name.end(), '\0');
    section.name.assign(entry.name.begin(), zero);
    if (zero == entry.name.end()) throw damaged(file, "header", "a section's name has no end");
    const std::string& name = section.name;
    if (entry.offset != alignedUp(end)) {
        throw damaged(file, name,
                      fmt::format("it begins at byte {}, {} is expected: sections overlap or leave "
                                  "a gap",
                                  entry.offset, alignedUp(end)));
    }
    if (entry.offset > bytes.size() || entry.bytes > bytes.size() - entry.offset) {
        throw damaged(file, name,
                      fmt::format("its {} bytes from byte {} on reach beyond the end of the file, "
                                  "which has {}",
                                  entry.bytes, entry.offset, bytes.size()));
    }
    requireZeros(file, name, end, bytes.subspan(end, entry.offset - end));
    if (entry.elementBytes == 0 || entry.bytes % entry.elementBytes != 0) {
        throw damaged(file, name,
                      fmt::format("its {} bytes are no whole number of elements of {} bytes",
                                  entry.bytes, entry.elementBytes));
    }
    section.bytes = bytes.subspan(entry.offset, entry.bytes);
    section.elementBytes = entry.elementBytes;
    const uint64_t hash = hashOf(section.bytes);
    if (hash != entry.hash) {
        throw damaged(file, name,
                      fmt::format("its hash is {:016x}, {:016x} is expected: the file was altered",
                                  hash, entry.hash));
    }
    return section;
}

}  // namespace

uint64_t hashOf(std::span<const std::byte> bytes)
{
    return XXH3_64bits(bytes.data(), bytes.size());
}

Error damaged(const std::string& file, const std::string& section, const std::string& finding)
{
    return badInput("{}: section '{}': {}; save the scene again with this program's sahl bvh", file,
                    section, finding);
}

void writeContainer(const fs::path& path, std::span<const Section> sections)
{
    SavedHeader header;
    header.sectionCount = static_cast<uint32_t>(sections.size());
    std::vector<SavedEntry> table;
    uint64_t end = sizeof(header) + sections.size() * sizeof(SavedEntry);
    for (const Section& section : sections) {
        table.push_back(entryOf(section, alignedUp(end)));
        end = table.back().offset + table.back().bytes;
    }
    header.fileBytes = end;
    header.hash = headHash(header, table);

    AtomicFile file(path);
    write(file, std::as_bytes(std::span(&header, 1)));
    write(file, std::as_bytes(std::span(table)));
    end = sizeof(header) + table.size() * sizeof(SavedEntry);
    const std::array<std::byte, SECTION_ALIGNMENT> zeros = {};
    for (size_t i = 0; i < sections.size(); i++) {
        write(file, std::span(zeros).first(table[i].offset - end));
        write(file, sections[i].bytes);
        end = table[i].offset + table[i].bytes;
    }
    file.commit();
}

std::vector<Section> readContainer(const std::string& file, std::span<const std::byte> bytes)
{
    const SavedHeader header = readHeader(file, bytes);
    const std::vector<SavedEntry> table = readTable(file, header, bytes);
    std::vector<Section> sections;
    uint64_t end = sizeof(header) + table.size() * sizeof(SavedEntry);
    for (const SavedEntry& entry : table) {
        sections.push_back(readSection(file, entry, end, bytes));
        end = entry.offset + entry.bytes;
    }
    if (end != bytes.size()) {
        throw damaged(file, "header",
                      fmt::format("the last section ends at byte {} of {}", end, bytes.size()));
    }
    return sections;
}

}  // namespace sahl
