// EXR out: float32 and uint32 channels in zip-compressed scanlines, through OpenEXR into memory.
#include "image/image.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <cassert>
#include <cstring>

namespace sahl {

namespace {

class MemoryOutput : public Imf::OStream {
public:
    explicit MemoryOutput(std::vector<uint8_t>& bytes) : Imf::OStream("picture"), bytes_(bytes) {}

    void write(const char* source, int count) override
    {
        size_t end = pos_ + static_cast<size_t>(count);
        if (end > bytes_.size()) bytes_.resize(end);
        std::memcpy(bytes_.data() + pos_, source, static_cast<size_t>(count));
        pos_ = end;
    }
    uint64_t tellp() override { return pos_; }
    void seekp(uint64_t pos) override { pos_ = pos; }

private:
    std::vector<uint8_t>& bytes_;
    size_t pos_ = 0;
};

Imath::Box2i windowOf(uint32_t left, uint32_t top, uint32_t width, uint32_t height)
{
    const Imath::V2i first(static_cast<int>(left), static_cast<int>(top));
    return {first, first + Imath::V2i(static_cast<int>(width) - 1, static_cast<int>(height) - 1)};
}

}  // namespace

std::vector<uint8_t> encodeExr(const Image& image, const ImageMetadata& metadata,
                               std::span<const ImageChannel> channels,
                               const std::optional<ImagePlace>& place,
                               std::span<const IntegerChannel> integers)
{
    assert(image.width > 0 && image.height > 0);
    assert(image.rgb.size() == size_t{3} * image.width * image.height);
    const ImagePlace at = place.value_or(ImagePlace{0, 0, image.width, image.height});
    Imf::Header header(windowOf(0, 0, at.fullWidth, at.fullHeight),
                       windowOf(at.left, at.top, image.width, image.height));
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const auto& [name, text] : metadata) header.insert(name, Imf::StringAttribute(text));

    const size_t xStride = 3 * sizeof(float);
    Imf::FrameBuffer frame;
    const char* names[3] = {"R", "G", "B"};
    for (size_t c = 0; c < 3; c++) {
        header.channels().insert(names[c], Imf::Channel(Imf::FLOAT));
        frame.insert(names[c],
                     Imf::Slice::Make(Imf::FLOAT, image.rgb.data() + c, header.dataWindow(),
                                      xStride, xStride * image.width));
    }
    for (const ImageChannel& channel : channels) {
        assert(channel.values.size() == size_t{image.width} * image.height);
        header.channels().insert(channel.name, Imf::Channel(Imf::FLOAT));
        frame.insert(channel.name,
                     Imf::Slice::Make(Imf::FLOAT, channel.values.data(), header.dataWindow(),
                                      sizeof(float), sizeof(float) * image.width));
    }
    for (const IntegerChannel& channel : integers) {
        header.channels().insert(channel.name, Imf::Channel(Imf::UINT));
        frame.insert(channel.name,
                     Imf::Slice::Make(Imf::UINT, channel.first, header.dataWindow(), channel.stride,
                                      channel.stride * image.width));
    }
    std::vector<uint8_t> bytes;
    MemoryOutput stream(bytes);
    {
        // The table of offsets is written when the file goes out of scope.
        Imf::OutputFile output(stream, header);
        output.setFrameBuffer(frame);
        output.writePixels(static_cast<int>(image.height));
    }
    return bytes;
}

}  // namespace sahl
