#include "util/gzip.h"

#include "util/error.h"

#include <zlib.h>

#include <algorithm>
#include <new>

namespace sahl {

namespace {

constexpr size_t CHUNK = size_t{1} << 18;

bool isPacked(std::span<const uint8_t> bytes)
{
    return bytes.size() >= 2 && bytes[0] == 0x1f && bytes[1] == 0x8b;
}

/// zlib's state, which ends itself.
struct Inflation {
    Inflation()
    {
        constexpr int gzipOnly = 16;
        if (inflateInit2(&stream, MAX_WBITS + gzipOnly) != Z_OK) throw std::bad_alloc();
    }
    ~Inflation() { inflateEnd(&stream); }
    Inflation(const Inflation&) = delete;
    Inflation& operator=(const Inflation&) = delete;
    z_stream stream = {};
};

/// Unpacks one member of the file, which may hold several, and returns how many bytes it took.
size_t unpackMember(std::span<const uint8_t> packed, std::vector<uint8_t>& unpacked,
                    uint64_t maxBytes, const fs::path& path)
{
    Inflation inflation;
    z_stream& stream = inflation.stream;
    size_t taken = 0;  // given to zlib so far
    while (true) {
        if (stream.avail_in == 0) {
            // Of what zlib counts in 32 bits, a part at a time.
            size_t part = std::min(packed.size() - taken, size_t{1} << 30);
            stream.next_in = const_cast<Bytef*>(packed.data() + taken);
            stream.avail_in = static_cast<uInt>(part);
            taken += part;
        }
        const size_t before = unpacked.size();
        unpacked.resize(before + CHUNK);
        stream.next_out = unpacked.data() + before;
        stream.avail_out = CHUNK;
        const int result = inflate(&stream, Z_NO_FLUSH);
        unpacked.resize(before + CHUNK - stream.avail_out);
        if (unpacked.size() > maxBytes) {
            throw badInput(
                "{}: unpacks to more than {} bytes, from {}; if that is right, unpack it "
                "with gunzip first",
                path.string(), maxBytes, packed.size());
        }
        if (result == Z_STREAM_END) return taken - stream.avail_in;
        if (result == Z_MEM_ERROR) throw std::bad_alloc();
        if (result == Z_BUF_ERROR && taken == packed.size()) {
            throw badInput("{}: the gzip file is truncated after {} unpacked bytes", path.string(),
                           unpacked.size());
        }
        if (result != Z_OK && result != Z_BUF_ERROR) {
            throw badInput("{}: the gzip file is damaged ({}) after {} unpacked bytes",
                           path.string(), stream.msg ? stream.msg : "unknown", unpacked.size());
        }
    }
}

std::vector<uint8_t> unpack(std::span<const uint8_t> packed, uint64_t maxBytes,
                            const fs::path& path)
{
    maxBytes = std::min(maxBytes, std::max(FREE_UNPACKING, MAX_UNPACKING * packed.size()));
    std::vector<uint8_t> unpacked;
    while (!packed.empty()) {
        if (!isPacked(packed)) {
            throw badInput("{}: {} bytes behind the end of the gzip data are none", path.string(),
                           packed.size());
        }
        packed = packed.subspan(unpackMember(packed, unpacked, maxBytes, path));
    }
    return unpacked;
}

}  // namespace

std::vector<uint8_t> readUnpacked(const fs::path& path, uint64_t maxBytes)
{
    std::vector<uint8_t> bytes = readFile(path, maxBytes);
    return isPacked(bytes) ? unpack(bytes, maxBytes, path) : bytes;
}

std::string readUnpackedText(const fs::path& path, uint64_t maxBytes)
{
    std::vector<uint8_t> bytes = readUnpacked(path, maxBytes);
    return std::string(bytes.begin(), bytes.end());
}

fs::path withoutGz(const fs::path& path)
{
    const std::string extension = path.extension().string();
    return extension == ".gz" || extension == ".GZ" ? path.parent_path() / path.stem() : path;
}

}  // namespace sahl
