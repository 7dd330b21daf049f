// Files: reading whole inputs with limits, and writing outputs so that they are complete or absent.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace sahl {

namespace fs = std::filesystem;

/// The whole content of a regular file. Throws badInput naming the file when it is missing, a
/// directory, a device or pipe (checked before reading: /dev/zero would never end), unreadable,
/// or larger than `maxBytes`.
std::vector<uint8_t> readFile(const fs::path& path, uint64_t maxBytes = uint64_t{8} << 30);
std::string readTextFile(const fs::path& path, uint64_t maxBytes = uint64_t{256} << 20);

/// The content of a regular file as memory that is read from the file where it is touched. Checks and
/// throws as readFile does. Sahl replaces files by renaming, so nothing changes under a mapping; a file
/// that another program cuts short meanwhile ends this one (SIGBUS).
class MappedFile {
public:
    explicit MappedFile(const fs::path& path, uint64_t maxBytes = uint64_t{64} << 30);
    ~MappedFile();
    MappedFile(const MappedFile&) = delete;
    MappedFile& operator=(const MappedFile&) = delete;

    /// Begins at a multiple of the size of a page.
    std::span<const std::byte> bytes() const { return bytes_; }

private:
    std::span<const std::byte> bytes_;
};

/// Same checks as readFile without reading: for libraries that open the file themselves.
void requireRegularFile(const fs::path& path, uint64_t maxBytes = uint64_t{8} << 30);

/// The files that the functions above have opened so far in this process: what no output may
/// replace.
std::vector<fs::path> filesRead();

/// Throws cannotWrite unless a file can be created beside `target` now and `target` itself is
/// absent or a writable regular file. Called before rendering, so that a bad path costs nothing.
void requireWritable(const fs::path& target);

/// A file that takes the place of `target` on commit(), written piece by piece: at any moment the old
/// or the complete new file is there. Devices and pipes are written in place. All functions throw
/// cannotWrite; without a commit nothing is left behind.
class AtomicFile {
public:
    explicit AtomicFile(const fs::path& target);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    void write(std::span<const uint8_t> bytes);
    void commit();

private:
    fs::path target_, place_, temporary_;  // place_: behind a symbolic link
    int fd_ = -1;
};

/// Replaces `target` by `bytes` so that at any moment the old or the complete new file is there:
/// a temporary file beside it, checked writes, fsync, rename. Throws cannotWrite; the temporary
/// file is removed on failure.
void writeFileAtomically(const fs::path& target, std::span<const uint8_t> bytes);
void writeFileAtomically(const fs::path& target, const std::string& text);

}  // namespace sahl
