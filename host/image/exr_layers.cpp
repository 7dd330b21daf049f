#include "image/exr_layers.h"

#include "image/exr_input.h"
#include "util/error.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>

namespace sahl {

namespace {

/// The file as bytes that are read where they are touched: most of it, by the child process alone.
struct OpenExr {
    MappedFile mapped;
    ImageFile file;
    ExrHeader header;

    explicit OpenExr(const fs::path& path)
        : mapped(path), file{path.string(), {reinterpret_cast<const uint8_t*>(mapped.bytes().data()),
                                             mapped.bytes().size()}}
    {
        requireExrMagic(file);
        header = checkExrHeader(file);
    }
};

ExrDescription descriptionOf(const ImageFile& file, const ExrHeader& header)
{
    const ExrWindow& full = header.display;
    const ExrWindow data = {header.minX, header.minY, int64_t{header.minX} + header.width - 1,
                            int64_t{header.minY} + header.height - 1};
    if (data.minX < full.minX || data.minY < full.minY || data.maxX > full.maxX ||
        data.maxY > full.maxY) {
        throw badInput("{}: its data window reaches beyond its display window", file.name);
    }
    ExrDescription description = {header.width, header.height, {}, header.texts, header.channels};
    description.place = {static_cast<uint32_t>(data.minX - full.minX),
                         static_cast<uint32_t>(data.minY - full.minY),
                         static_cast<uint32_t>(full.maxX - full.minX + 1),
                         static_cast<uint32_t>(full.maxY - full.minY + 1)};
    return description;
}

Imf::PixelType typeOf(const ExrChannel& channel)
{
    return channel.kind == ExrKind::integer ? Imf::UINT : Imf::FLOAT;
}

void decode(const ImageFile& file, const ExrHeader& header, std::span<const std::string> names,
            const ExrPlanes& planes)
{
    constexpr int noThreads = 0;
    MemoryInput stream(file);
    Imf::InputFile input(stream, noThreads);
    const Imath::Box2i window = input.header().dataWindow();
    requireSameWindow(window, header);
    Imf::FrameBuffer frame;
    for (size_t i = 0; i < names.size(); i++) {
        const Imf::PixelType type = typeOf(header.channels.at(names[i]));
        const Imf::Channel* found = input.header().channels().findChannel(names[i]);
        if (found == nullptr || found->type != type || found->xSampling != 1 ||
            found->ySampling != 1) {
            throw std::runtime_error("EXR header is ambiguous");
        }
        frame.insert(names[i], Imf::Slice::Make(type, planes.plane(i).data(), window, sizeof(uint32_t),
                                                sizeof(uint32_t) * header.width));
    }
    input.setFrameBuffer(frame);
    input.readPixels(window.min.y, window.max.y);
}

}  // namespace

ExrPlanes::ExrPlanes(size_t count, size_t pixels)
    : memory_(std::make_shared<const SharedMemory>(count * pixels * sizeof(uint32_t))), pixels_(pixels)
{
}

std::span<uint32_t> ExrPlanes::plane(size_t i) const
{
    return {reinterpret_cast<uint32_t*>(memory_->bytes().data()) + i * pixels_, pixels_};
}

std::span<const uint32_t> ExrPlanes::words() const
{
    return {plane(0).data(), memory_->bytes().size() / sizeof(uint32_t)};
}

ExrDescription describeExr(const fs::path& path)
{
    const OpenExr exr(path);
    return descriptionOf(exr.file, exr.header);
}

ExrPlanes readExrPlanes(const fs::path& path, const ExrDescription& described,
                        std::span<const std::string> names)
{
    const OpenExr exr(path);
    if (descriptionOf(exr.file, exr.header) != described) {
        throw badInput("{}: is another file than a moment ago; try again", exr.file.name);
    }
    for (const std::string& name : names) {
        const auto found = described.channels.find(name);
        if (found == described.channels.end()) {
            throw badInput("{}: has no channel {}", exr.file.name, name);
        }
        if (found->second.kind == ExrKind::half || !found->second.fullResolution) {
            throw badInput("{}: channel {} is not of 32 bits at full resolution", exr.file.name, name);
        }
    }
    const ExrPlanes planes(names.size(), size_t{described.width} * described.height);
    const std::string failure = runIsolated(decodingLimits(exr.file, exr.header),
                                            [&] { decode(exr.file, exr.header, names, planes); });
    if (!failure.empty()) throw badInput("{}: {}", exr.file.name, failure);
    return planes;
}

}  // namespace sahl
