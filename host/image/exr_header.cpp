// The header of an EXR file: magic, version and flags, then attributes (name, type, size, value)
// up to an empty name. "OpenEXR File Layout", openexr.com.
#include "image/exr_header.h"
#include "util/error.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <string_view>

namespace sahl {

namespace {

constexpr uint32_t FLAG_TILED = 0x200;
constexpr uint32_t FLAG_LONG_NAMES = 0x400;
constexpr uint32_t FLAG_NON_IMAGE = 0x800;
constexpr uint32_t FLAG_MULTI_PART = 0x1000;

constexpr size_t MAX_CHANNELS = 1024;
constexpr size_t MAX_NAME = 255;

// Scanlines in a chunk by compression: none, RLE, ZIPS, ZIP, PIZ, PXR24, B44, B44A, DWAA, DWAB.
constexpr std::array<int64_t, 10> LINES_PER_CHUNK = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256};

/// Little-endian fields, never read past the end.
struct FieldReader {
    const ImageFile& file;
    std::span<const uint8_t> bytes;
    size_t pos = 0;

    uint8_t u8()
    {
        if (pos >= bytes.size()) throw badInput("{}: EXR header is truncated", file.name);
        return bytes[pos++];
    }
    uint32_t u32()
    {
        uint32_t value = 0;
        for (int shift = 0; shift < 32; shift += 8) value |= uint32_t{u8()} << shift;
        return value;
    }
    int32_t i32() { return std::bit_cast<int32_t>(u32()); }
    float f32() { return std::bit_cast<float>(u32()); }
    std::string name()
    {
        std::string text;
        for (uint8_t c = u8(); c != 0; c = u8()) {
            if (text.size() == MAX_NAME || c < ' ' || c > '~') {
                throw badInput("{}: EXR header is damaged at byte {}: no name there", file.name,
                               pos - 1);
            }
            text.push_back(static_cast<char>(c));
        }
        return text;
    }
};

struct Attribute {
    std::string type;
    std::span<const uint8_t> value;
};

using Attributes = std::map<std::string, Attribute>;

Attributes readAttributes(FieldReader& reader)
{
    Attributes attributes;
    for (std::string name = reader.name(); !name.empty(); name = reader.name()) {
        std::string type = reader.name();
        uint32_t size = reader.u32();
        if (size > reader.bytes.size() - reader.pos) {
            throw badInput("{}: EXR attribute \"{}\" claims {} bytes, {} are left",
                           reader.file.name, name, size, reader.bytes.size() - reader.pos);
        }
        Attribute attribute = {type, reader.bytes.subspan(reader.pos, size)};
        reader.pos += size;
        if (!attributes.emplace(name, attribute).second) {
            throw badInput("{}: EXR attribute \"{}\" is there twice", reader.file.name, name);
        }
    }
    return attributes;
}

/// A reader over the value of a required attribute.
FieldReader require(const ImageFile& file, const Attributes& attributes, const std::string& name,
                    std::string_view type)
{
    auto found = attributes.find(name);
    if (found == attributes.end()) throw badInput("{}: EXR header has no {}", file.name, name);
    if (found->second.type != type) {
        throw badInput("{}: EXR attribute \"{}\" is of type {}, not {}", file.name, name,
                       found->second.type, type);
    }
    return {file, found->second.value};
}

void checkVersion(const ImageFile& file, uint32_t version)
{
    if ((version & 0xff) != 2) {
        throw badInput("{}: EXR version {} is not known; 2 is read", file.name, version & 0xff);
    }
    if (version & FLAG_NON_IMAGE) {
        throw badInput("{}: deep EXR is not read; flatten it to one value a pixel", file.name);
    }
    if (version & FLAG_MULTI_PART) {
        throw badInput("{}: multi-part EXR is not read; save the wanted part alone", file.name);
    }
    if (version & ~(0xffu | FLAG_TILED | FLAG_LONG_NAMES)) {
        throw badInput("{}: unknown EXR flags {:#x}", file.name, version >> 8);
    }
}

std::map<std::string, ExrChannel> readChannels(const ImageFile& file, FieldReader reader)
{
    std::map<std::string, ExrChannel> channels;
    for (std::string name = reader.name(); !name.empty(); name = reader.name()) {
        if (channels.size() == MAX_CHANNELS) {
            throw badInput("{}: has more than {} channels", file.name, MAX_CHANNELS);
        }
        uint32_t pixelType = reader.u32();
        reader.u32();  // perceptually linear or not, for lossy codes alone; and three unused bytes
        int32_t xSampling = reader.i32();
        int32_t ySampling = reader.i32();
        if (pixelType > 2 || xSampling < 1 || ySampling < 1) {
            throw badInput("{}: EXR channel \"{}\" has type {} and sampling {} x {}", file.name,
                           name, pixelType, xSampling, ySampling);
        }
        channels[name] = {static_cast<ExrKind>(pixelType), xSampling == 1 && ySampling == 1};
    }
    return channels;
}

/// Whether the picture is grey. Throws unless it has all of R, G, B, or else Y without chroma.
bool checkChannels(const ImageFile& file, const std::map<std::string, ExrChannel>& channels)
{
    auto has = [&](const char* name) { return channels.count(name) > 0; };
    bool rgb = has("R") && has("G") && has("B");
    if (!rgb && (!has("Y") || has("RY") || has("BY"))) {
        std::string names;
        for (const auto& [name, channel] : channels) names += (names.empty() ? "" : ", ") + name;
        if (names.size() > 200) names = names.substr(0, 200) + " ...";
        throw badInput("{}: needs channels R, G, B, or Y alone; it has {}", file.name,
                       names.empty() ? "none" : names);
    }
    for (const char* name : {"R", "G", "B", "Y"}) {
        bool wanted = rgb == (std::string_view(name) != "Y");
        if (wanted && !channels.at(name).fullResolution) {
            throw badInput("{}: channel {} is stored at a lower resolution", file.name, name);
        }
    }
    return !rgb;
}

ExrWindow readWindow(FieldReader reader)
{
    ExrWindow window;
    for (int64_t* edge : {&window.minX, &window.minY, &window.maxX, &window.maxY}) {
        *edge = reader.i32();
    }
    return window;
}

/// Each chunk has 8 bytes in the table of offsets and a head before its data.
void checkLength(const ImageFile& file, const Attributes& attributes, bool tiled, size_t headerEnd,
                 const ExrHeader& header)
{
    uint8_t compression = require(file, attributes, "compression", "compression").u8();
    if (compression >= LINES_PER_CHUNK.size()) {
        throw badInput("{}: EXR compression {} is not known", file.name, compression);
    }
    int64_t lines = LINES_PER_CHUNK[compression];
    int64_t chunks = (int64_t{header.height} + lines - 1) / lines;
    int64_t chunkBytes = 8 + 8;
    if (tiled) {
        FieldReader tile = require(file, attributes, "tiles", "tiledesc");
        int64_t tileWidth = tile.u32();
        int64_t tileHeight = tile.u32();
        if (tileWidth < 1 || tileHeight < 1 || tileWidth > 32768 || tileHeight > 32768) {
            throw badInput("{}: tiles of {} x {} pixels", file.name, tileWidth, tileHeight);
        }
        chunks = ((header.width + tileWidth - 1) / tileWidth) *
                 ((header.height + tileHeight - 1) / tileHeight);
        chunkBytes = 8 + 20;
    }
    size_t left = file.bytes.size() - headerEnd;
    if (static_cast<size_t>(chunks * chunkBytes) > left) {
        throw badInput("{}: is truncated: {} x {} pixels need {} chunks, {} bytes are left",
                       file.name, header.width, header.height, chunks, left);
    }
}

ImageMetadata textsOf(const Attributes& attributes)
{
    ImageMetadata texts;
    for (const auto& [name, attribute] : attributes) {
        if (attribute.type != "string") continue;
        texts[name].assign(attribute.value.begin(), attribute.value.end());
    }
    return texts;
}

bool isRec709(const ImageFile& file, const Attributes& attributes)
{
    auto found = attributes.find("chromaticities");
    if (found == attributes.end() || found->second.value.size() != 32) return true;
    constexpr float rec709[8] = {0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};
    FieldReader reader = {file, found->second.value};
    bool same = true;
    for (float expected : rec709) same = std::fabs(reader.f32() - expected) < 0.002f && same;
    return same;
}

}  // namespace

void requireExrMagic(const ImageFile& file)
{
    if (file.bytes.empty()) throw badInput("{}: the file is empty", file.name);
    FieldReader reader = {file, file.bytes};
    if (reader.u32() != 20000630) throw badInput("{}: is not an EXR file", file.name);
}

ExrHeader checkExrHeader(const ImageFile& file)
{
    FieldReader reader = {file, file.bytes};
    reader.u32();  // the magic number, seen by readImage
    const uint32_t version = reader.u32();
    checkVersion(file, version);
    const Attributes attributes = readAttributes(reader);
    if (auto type = attributes.find("type"); type != attributes.end()) {
        std::string text(type->second.value.begin(), type->second.value.end());
        if (text != "scanlineimage" && text != "tiledimage") {
            throw badInput("{}: EXR of type {} is not read", file.name, printable(text));
        }
    }

    const ExrWindow data = readWindow(require(file, attributes, "dataWindow", "box2i"));
    const ExrWindow display = readWindow(require(file, attributes, "displayWindow", "box2i"));
    const int64_t width = data.maxX - data.minX + 1;
    const int64_t height = data.maxY - data.minY + 1;
    requireImageSize(file, width, height);

    ExrHeader header;
    header.minX = static_cast<int32_t>(data.minX);
    header.minY = static_cast<int32_t>(data.minY);
    header.width = static_cast<uint32_t>(width);
    header.height = static_cast<uint32_t>(height);
    header.channels = readChannels(file, require(file, attributes, "channels", "chlist"));
    header.grey = checkChannels(file, header.channels);
    checkLength(file, attributes, (version & FLAG_TILED) != 0, reader.pos, header);
    header.rec709 = isRec709(file, attributes);
    header.cropped = data != display;
    header.display = display;
    header.texts = textsOf(attributes);
    return header;
}

}  // namespace sahl
