// EXR in, through OpenEXR in a child process: its releases in wide use have known memory faults
// that a hostile file can reach.
#include "image/exr_input.h"
#include "util/error.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>

#include <algorithm>

namespace sahl {

namespace {

/// Decodes into `pixels`, 3 floats each, top row first.
void decode(const ImageFile& file, const ExrHeader& expected, std::span<float> pixels)
{
    constexpr int noThreads = 0;
    MemoryInput stream(file);
    Imf::InputFile input(stream, noThreads);
    const Imath::Box2i window = input.header().dataWindow();
    requireSameWindow(window, expected);
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
        runIsolated(decodingLimits(file, header), [&] { decode(file, header, pixels); });
    if (!failure.empty()) throw badInput("{}: {}", file.name, failure);
    warnAboutMeaning(file, header);
    std::copy(pixels.begin(), pixels.end(), image.rgb.begin());
    return image;
}

}  // namespace sahl
