// EXR files of kinds that Sahl reads but does not write, made with OpenEXR.
#pragma once

#include "support/pictures.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfTileDescriptionAttribute.h>
#include <OpenEXR/ImfTiledOutputFile.h>

namespace sahl::testing {

struct ExrOptions {
    Imf::Compression compression = Imf::ZIP_COMPRESSION;
    Imf::LineOrder lineOrder = Imf::INCREASING_Y;
    Imf::PixelType type = Imf::FLOAT;
    Imath::V2i origin = {0, 0};          // of the data window
    Imf::Chromaticities primaries = {};  // default: Rec. 709, not written to the file
    int tileSize = 0;                    // 0: scanlines
    std::vector<std::string> channels = {"R", "G", "B"};  // channel i holds channel i % 3
};

class ByteStream : public Imf::OStream {
public:
    ByteStream() : Imf::OStream("test") {}
    void write(const char* source, int count) override
    {
        bytes.resize(std::max(bytes.size(), pos + static_cast<size_t>(count)));
        std::memcpy(bytes.data() + pos, source, static_cast<size_t>(count));
        pos += static_cast<size_t>(count);
    }
    uint64_t tellp() override { return pos; }
    void seekp(uint64_t to) override { pos = to; }

    FileBytes bytes;
    size_t pos = 0;
};

inline FileBytes makeExr(const Image& image, const ExrOptions& options)
{
    const Imath::Box2i window(options.origin,
                              options.origin + Imath::V2i(static_cast<int>(image.width) - 1,
                                                          static_cast<int>(image.height) - 1));
    Imf::Header header(window, window, 1, Imath::V2f(0, 0), 1, options.lineOrder,
                       options.compression);
    if (options.primaries.red != Imf::Chromaticities().red) {
        Imf::addChromaticities(header, options.primaries);
    }
    // OpenEXR converts nothing on the way out, so halves are made here.
    std::vector<half> halves(image.rgb.begin(), image.rgb.end());
    const bool isHalf = options.type == Imf::HALF;
    const size_t size = isHalf ? sizeof(half) : sizeof(float);
    const char* base = isHalf ? reinterpret_cast<const char*>(halves.data())
                              : reinterpret_cast<const char*>(image.rgb.data());
    Imf::FrameBuffer frame;
    for (size_t i = 0; i < options.channels.size(); i++) {
        header.channels().insert(options.channels[i], Imf::Channel(options.type));
        frame.insert(options.channels[i],
                     Imf::Slice::Make(options.type, base + i % 3 * size, window, 3 * size,
                                      3 * size * image.width));
    }
    ByteStream stream;
    if (options.tileSize > 0) {
        const auto side = static_cast<unsigned>(options.tileSize);
        header.setTileDescription(Imf::TileDescription(side, side, Imf::ONE_LEVEL));
        Imf::TiledOutputFile file(stream, header);
        file.setFrameBuffer(frame);
        file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
    } else {
        Imf::OutputFile file(stream, header);
        file.setFrameBuffer(frame);
        file.writePixels(static_cast<int>(image.height));
    }
    return std::move(stream.bytes);
}

}  // namespace sahl::testing
