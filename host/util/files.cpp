#include "util/files.h"

#include "util/error.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <mutex>
#include <random>
#include <utility>

namespace sahl {

namespace {

Error cannotWrite(const fs::path& path, const std::string& why)
{
    return Error(ErrorKind::cannotWrite, fmt::format("{}: cannot write: {}", path.string(), why));
}

/// An open file descriptor that closes itself.
struct Descriptor {
    explicit Descriptor(int value) : fd(value) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor()
    {
        if (fd >= 0) ::close(fd);
    }
    int fd;
};

std::mutex filesReadMutex;
std::vector<fs::path> filesReadSoFar;

/// Opens for reading and checks that it is a regular file of a bearable size.
Descriptor openInput(const fs::path& path, uint64_t maxBytes, uint64_t& size)
{
    // O_NONBLOCK: opening a pipe must not wait for its writer.
    Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (file.fd < 0) throw badInput("{}: cannot read: {}", path.string(), std::strerror(errno));
    struct stat info = {};
    if (::fstat(file.fd, &info) != 0) throw badInput("{}: {}", path.string(), std::strerror(errno));
    if (S_ISDIR(info.st_mode)) throw badInput("{}: is a directory, not a file", path.string());
    if (!S_ISREG(info.st_mode)) {
        throw badInput("{}: is not a regular file (a device or pipe cannot be read)",
                       path.string());
    }
    size = static_cast<uint64_t>(info.st_size);
    if (size > maxBytes) {
        throw badInput("{}: has {} bytes; at most {} are read", path.string(), size, maxBytes);
    }
    std::lock_guard lock(filesReadMutex);
    filesReadSoFar.push_back(path);
    return Descriptor(std::exchange(file.fd, -1));
}

/// A new file beside `target`; its name has random digits, since process ids come again: in another
/// container, or after a kill that left a temporary file behind.
Descriptor createTemporary(const fs::path& target, fs::path& name)
{
    std::random_device random;
    for (int attempt = 0; attempt < 100; attempt++) {
        name = target;
        name += fmt::format(".{:08x}.tmp", random());
        int fd = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (fd >= 0 || errno != EEXIST) return Descriptor(fd);
    }
    return Descriptor(-1);
}

void writeAll(int fd, std::span<const uint8_t> bytes, const fs::path& target)
{
    while (!bytes.empty()) {
        ssize_t written = ::write(fd, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) throw cannotWrite(target, std::strerror(written < 0 ? errno : ENOSPC));
        bytes = bytes.subspan(static_cast<size_t>(written));
    }
}

fs::path folderOf(const fs::path& target)
{
    return target.has_parent_path() ? target.parent_path() : fs::path(".");
}

/// What a symbolic link leads to; other paths as they are.
fs::path linkResolved(const fs::path& target)
{
    std::error_code ignored;
    return fs::is_symlink(target, ignored) ? fs::weakly_canonical(target, ignored) : target;
}

/// Devices and pipes are written in place: there is nothing to rename over.
bool isSpecialFile(const fs::path& target)
{
    struct stat info = {};
    return ::stat(target.c_str(), &info) == 0 && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode);
}

}  // namespace

std::vector<fs::path> filesRead()
{
    std::lock_guard lock(filesReadMutex);
    return filesReadSoFar;
}

MappedFile::MappedFile(const fs::path& path, uint64_t maxBytes)
{
    uint64_t size = 0;
    Descriptor file = openInput(path, maxBytes, size);
    if (size == 0) return;
    void* place = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE | MAP_POPULATE, file.fd, 0);
    if (place == MAP_FAILED) {
        throw badInput("{}: cannot be mapped into memory: {}", path.string(), std::strerror(errno));
    }
    bytes_ = {static_cast<const std::byte*>(place), size};
}

MappedFile::~MappedFile()
{
    if (!bytes_.empty()) ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
}

void requireRegularFile(const fs::path& path, uint64_t maxBytes)
{
    uint64_t size = 0;
    openInput(path, maxBytes, size);
}

std::vector<uint8_t> readFile(const fs::path& path, uint64_t maxBytes)
{
    uint64_t size = 0;
    Descriptor file = openInput(path, maxBytes, size);
    std::vector<uint8_t> bytes(size);
    size_t have = 0;
    while (have < bytes.size()) {
        ssize_t got = ::read(file.fd, bytes.data() + have, bytes.size() - have);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) throw badInput("{}: cannot read: {}", path.string(), std::strerror(errno));
        if (got == 0) break;  // the file shrank meanwhile; what follows will find it truncated
        have += static_cast<size_t>(got);
    }
    bytes.resize(have);
    return bytes;
}

std::string readTextFile(const fs::path& path, uint64_t maxBytes)
{
    std::vector<uint8_t> bytes = readFile(path, maxBytes);
    return std::string(bytes.begin(), bytes.end());
}

void requireWritable(const fs::path& target)
{
    std::error_code ignored;
    if (fs::is_directory(target, ignored)) throw cannotWrite(target, "it is a directory");
    if (fs::exists(target, ignored) && ::access(target.c_str(), W_OK) != 0) {
        throw cannotWrite(target, std::strerror(errno));
    }
    if (isSpecialFile(target)) return;
    fs::path place = linkResolved(target);
    fs::path temporary;
    Descriptor file = createTemporary(place, temporary);
    if (file.fd < 0) {
        throw cannotWrite(
            target, fmt::format("{} (folder {})", std::strerror(errno), folderOf(place).string()));
    }
    ::unlink(temporary.c_str());
}

AtomicFile::AtomicFile(const fs::path& target) : target_(target)
{
    if (isSpecialFile(target)) {
        fd_ = ::open(target.c_str(), O_WRONLY | O_CLOEXEC);
    } else {
        place_ = linkResolved(target);
        Descriptor file = createTemporary(place_, temporary_);
        if (file.fd < 0) temporary_.clear();
        fd_ = std::exchange(file.fd, -1);
    }
    if (fd_ < 0) throw cannotWrite(target, std::strerror(errno));
}

AtomicFile::~AtomicFile()
{
    if (fd_ >= 0) ::close(fd_);
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void AtomicFile::write(std::span<const uint8_t> bytes)
{
    writeAll(fd_, bytes, target_);
}

void AtomicFile::commit()
{
    if (temporary_.empty()) return;
    if (::fsync(fd_) != 0) throw cannotWrite(target_, std::strerror(errno));
    if (::close(std::exchange(fd_, -1)) != 0) throw cannotWrite(target_, std::strerror(errno));
    if (::rename(temporary_.c_str(), place_.c_str()) != 0) {
        throw cannotWrite(target_, std::strerror(errno));
    }
    temporary_.clear();
    // The rename itself must survive a power cut; a folder that cannot be synced is no failure.
    Descriptor folder(::open(folderOf(place_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (folder.fd >= 0) ::fsync(folder.fd);
}

void writeFileAtomically(const fs::path& target, std::span<const uint8_t> bytes)
{
    AtomicFile file(target);
    file.write(bytes);
    file.commit();
}

void writeFileAtomically(const fs::path& target, const std::string& text)
{
    writeFileAtomically(target, {reinterpret_cast<const uint8_t*>(text.data()), text.size()});
}

}  // namespace sahl
