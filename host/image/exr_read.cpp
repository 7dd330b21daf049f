// EXR in, through OpenEXR in a child process: its releases in wide use have known memory faults
// that a hostile file can reach.
#include "image/exr_header.h"
#include "image/isolated.h"
#include "util/error.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace sahl {

namespace {

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

/// Decodes into `pixels`, 3 floats each, top row first.
void decode(const ImageFile& file, const ExrHeader& expected, std::span<float> pixels)
{
    constexpr int noThreads = 0;
    MemoryInput stream(file);
    Imf::InputFile input(stream, noThreads);
    const Imath::Box2i window = input.header().dataWindow();
    if (window.min.x != expected.minX || window.min.y != expected.minY ||
        window.max.x - window.min.x + 1 != static_cast<int>(expected.width) ||
        window.max.y - window.min.y + 1 != static_cast<int>(expected.height)) {
        throw std::runtime_error("EXR header is ambiguous");  // `pixels` was made for our reading
    }
    const size_t xStride = 3 * sizeof(float);
    const size_t yStride = xStride * expected.width;
    const char* names = expected.grey ? "Y" : "RGB";
    Imf::FrameBuffer frame;
    for (size_t c = 0; names[c] != '\0'; c++) {
        frame.insert(std::string(1, names[c]),
                     Imf::Slice::Make(Imf::FLOAT, pixels.data() + c, window, xStride, yStride));
    }
    input.setFrameBuffer(frame);
    input.readPixels(window.min.y, window.max.y);
    if (expected.grey) {
        for (size_t i = 0; i < pixels.size(); i += 3) pixels[i + 1] = pixels[i + 2] = pixels[i];
    }
}

/// Several times what the slowest compression needs on a slow machine.
IsolatedLimits limitsFor(const ImageFile& file, size_t pixelCount)
{
    IsolatedLimits limits;
    limits.cpuSeconds = static_cast<unsigned>(2 + (pixelCount >> 22) + (file.bytes.size() >> 24));
    limits.extraMemory = uint64_t{1} << 30;  // chunks of all channels, some of them 256 rows high
    return limits;
}

void warnAboutMeaning(const ImageFile& file, const ExrHeader& header)
{
    if (!header.rec709) {
        warn(fmt::format("{}: its primaries are not Rec. 709; its values are used as if they were",
                         file.name));
    }
    if (header.cropped) {
        warn(fmt::format("{}: its data window of {} x {} pixels is read, not the displayed one",
                         file.name, header.width, header.height));
    }
}

}  // namespace

Image decodeExr(const ImageFile& file)
{
    const ExrHeader header = checkExrHeader(file);
    Image image = makeImage(file, header.width, header.height);
    SharedMemory memory(image.rgb.size() * sizeof(float));
    const std::span<float> pixels(reinterpret_cast<float*>(memory.bytes().data()),
                                  image.rgb.size());
    const std::string failure =
        runIsolated(limitsFor(file, image.rgb.size() / 3), [&] { decode(file, header, pixels); });
    if (!failure.empty()) throw badInput("{}: {}", file.name, failure);
    warnAboutMeaning(file, header);
    std::copy(pixels.begin(), pixels.end(), image.rgb.begin());
    return image;
}

}  // namespace sahl
