// Input files that may be packed with gzip: told by their first bytes, unpacked in memory.
#pragma once

#include "util/files.h"

namespace sahl {

/// Like readFile; the content of a gzip file unpacked. Throws badInput naming the file also when
/// that is damaged or truncated, unpacks to more than `maxBytes`, or to more than a real file of
/// its size would: MAX_UNPACKING times as much, unless that is little.
std::vector<uint8_t> readUnpacked(const fs::path& path, uint64_t maxBytes = uint64_t{8} << 30);
std::string readUnpackedText(const fs::path& path, uint64_t maxBytes);

/// The path without ".gz" at its end, in capitals or not.
fs::path withoutGz(const fs::path& path);

/// A few kilobytes can unpack to a thousand times as much; meshes and probes pack 2 to 20 times.
constexpr uint64_t MAX_UNPACKING = 200;
constexpr uint64_t FREE_UNPACKING = uint64_t{64} << 20;  ///< bytes that are never too much

}  // namespace sahl
