// What the readers of EXR files share: the file in memory as OpenEXR's stream, and bounds for the
// child process in which it is decoded.
#pragma once

#include "image/exr_header.h"
#include "image/isolated.h"

#include <Imath/ImathBox.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>

#include <cstring>
#include <stdexcept>

namespace sahl {

class MemoryInput : public Imf::IStream {
public:
    explicit MemoryInput(const ImageFile& file)
        : Imf::IStream(fs::path(file.name).filename().c_str()), bytes_(file.bytes)
    {
    }

    bool read(char* target, int count) override
    {
        if (count < 0 || static_cast<uint64_t>(count) > bytes_.size() - pos_) {
            throw std::runtime_error("is truncated");
        }
        std::memcpy(target, bytes_.data() + pos_, static_cast<size_t>(count));
        pos_ += static_cast<uint64_t>(count);
        return pos_ < bytes_.size();
    }
    uint64_t tellg() override { return pos_; }
    void seekg(uint64_t pos) override
    {
        if (pos > bytes_.size()) throw std::runtime_error("is truncated");
        pos_ = pos;
    }

private:
    std::span<const uint8_t> bytes_;
    uint64_t pos_ = 0;
};

/// Throws unless OpenEXR found the window that we did: memory was made for ours.
inline void requireSameWindow(const Imath::Box2i& window, const ExrHeader& expected)
{
    if (window.min.x != expected.minX || window.min.y != expected.minY ||
        window.max.x - window.min.x + 1 != static_cast<int>(expected.width) ||
        window.max.y - window.min.y + 1 != static_cast<int>(expected.height)) {
        throw std::runtime_error("EXR header is ambiguous");
    }
}

/// Several times what the slowest compression needs on a slow machine. All channels of a file are
/// unpacked, whichever are asked for.
inline IsolatedLimits decodingLimits(const ImageFile& file, const ExrHeader& header)
{
    const uint64_t values = uint64_t{header.width} * header.height * header.channels.size();
    IsolatedLimits limits;
    limits.cpuSeconds = static_cast<unsigned>(2 + (values >> 23) + (file.bytes.size() >> 24));
    limits.extraMemory = uint64_t{1} << 30;  // chunks of all channels, some of them 256 rows high
    return limits;
}

}  // namespace sahl
