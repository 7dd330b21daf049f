#include "compare/report.h"

#include "compare/page_text.h"
#include "image/color_map.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <map>
#include <new>
#include <span>

namespace sahl {

namespace {

std::string base64(std::span<const uint8_t> bytes)
{
    constexpr char DIGITS[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (size_t i = 0; i < bytes.size(); i += 3) {
        const size_t present = std::min<size_t>(3, bytes.size() - i);
        uint32_t group = 0;
        for (size_t k = 0; k < 3; k++) group = group << 8 | (k < present ? bytes[i + k] : 0u);
        for (size_t k = 0; k < 4; k++) {
            text += k <= present ? DIGITS[group >> (18 - 6 * k) & 63] : '=';
        }
    }
    return text;
}

/// Bytes of equal weight side by side, which packs to about half of what floats as they lie do.
std::string packed(std::span<const float> values)
{
    std::vector<uint8_t> bytes(4 * values.size());
    for (size_t i = 0; i < values.size(); i++) {
        const auto bits = std::bit_cast<uint32_t>(values[i]);
        for (size_t byte = 0; byte < 4; byte++) {
            bytes[byte * values.size() + i] = static_cast<uint8_t>(bits >> (8 * byte));
        }
    }
    uLongf size = compressBound(bytes.size());
    std::vector<uint8_t> out(size);
    if (compress2(out.data(), &size, bytes.data(), bytes.size(), 6) != Z_OK) throw std::bad_alloc();
    return base64({out.data(), size});
}

std::string viridisColours()
{
    std::vector<uint8_t> bytes;
    for (int i = 0; i < 256; i++) {
        const Colour8 color = colorOf(ColorMap::viridis, i / 255.0);
        bytes.insert(bytes.end(), color.begin(), color.end());
    }
    return base64(bytes);
}

std::string planesJson(const LoadedPicture& a, const LoadedPicture& b, const Comparison& c)
{
    const Flip& flip = c.metrics.hdrFlip ? *c.metrics.hdrFlip : c.metrics.ldrFlip;
    std::string json =
        fmt::format(R"({{"viridis":"{}","a":"{}","b":"{}","flip":"{}")", viridisColours(),
                    packed(a.image.rgb), packed(b.image.rgb), packed(flip.map));
    if (c.statistics) json += fmt::format(R"(,"z":"{}")", packed(c.statistics->z));
    return json + "}";
}

/// JSON that no text in it can end the script element of: names of files may hold anything.
std::string withoutTags(std::string_view json)
{
    std::string text;
    for (char c : json) {
        if (c == '<') {
            text += "\\u003c";
        } else {
            text += c;
        }
    }
    return text;
}

}  // namespace

std::string reportPage(std::string_view json, const LoadedPicture& a, const LoadedPicture& b,
                       const Comparison& comparison)
{
    const std::map<std::string_view, std::string> parts = {
        {"{{style}}", PAGE_STYLE},
        {"{{script}}", PAGE_SCRIPT},
        {"{{comparison}}", withoutTags(json)},
        {"{{planes}}", planesJson(a, b, comparison)}};
    const std::string_view frame = PAGE_HTML;
    std::string page;
    size_t done = 0;
    for (size_t begin = frame.find("{{"); begin != frame.npos; begin = frame.find("{{", done)) {
        const size_t end = frame.find("}}", begin) + 2;
        page += frame.substr(done, begin - done);
        page += parts.at(frame.substr(begin, end - begin));
        done = end;
    }
    page += frame.substr(done);
    return page;
}

}  // namespace sahl
