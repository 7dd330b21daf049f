// Radiance HDR (RGBE and XYZE): header lines, a resolution line, then scanlines of shared-exponent
// pixels, flat or in one of two run-length codes. Ward 1991, "Real Pixels", Graphics Gems II.
#include "image/image_readers.h"
#include "util/error.h"

#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

namespace sahl {

namespace {

using Rgbe = std::array<uint8_t, 4>;  // three mantissas and the exponent they share

/// A place in the file that never runs past its end.
struct Cursor {
    const ImageFile& file;
    size_t pos = 0;

    uint8_t next()
    {
        if (pos >= file.bytes.size()) throw badInput("{}: is truncated", file.name);
        return file.bytes[pos++];
    }

    /// The line that starts here, without its end.
    std::string_view line()
    {
        size_t start = pos;
        while (next() != '\n') {
        }
        std::string_view text(reinterpret_cast<const char*>(file.bytes.data()) + start,
                              pos - 1 - start);
        if (text.ends_with('\r')) text.remove_suffix(1);
        return text;
    }
};

struct HdrHeader {
    bool xyz = false;
    double exposure = 1;   // what the radiances were multiplied by before they were stored
    bool columns = false;  // scanlines run along y
    int64_t width = 0, height = 0;
    bool flipX = false;  // the first pixel is on the right
    bool flipY = false;  // the first pixel is at the bottom
};

std::string_view trimmed(std::string_view text)
{
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
    return text;
}

/// Takes the next word off the front of `text`.
std::string_view takeWord(std::string_view& text)
{
    text = trimmed(text);
    std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(word.size());
    return word;
}

template <class Number>
bool parseNumber(std::string_view word, Number& value)
{
    if (word.starts_with('+')) word.remove_prefix(1);
    auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return !word.empty() && error == std::errc{} && end == word.data() + word.size();
}

void parseExposure(const ImageFile& file, std::string_view value, HdrHeader& header)
{
    double exposure = 0;
    if (!parseNumber(value, exposure) || !std::isfinite(exposure) || exposure <= 0) {
        throw badInput("{}: EXPOSURE is {}; it must be a finite number above 0", file.name,
                       printable(value));
    }
    header.exposure *= exposure;  // it may be given again by each program on the way
    if (!std::isfinite(header.exposure) || header.exposure <= 0) {
        throw badInput("{}: the product of all EXPOSURE lines is out of range", file.name);
    }
}

/// "NAME=value" lines up to the empty line. Other variables do not change what the pixels mean,
/// or, as PRIMARIES, hold nonsense so often that nobody trusts them.
void parseVariables(Cursor& cursor, HdrHeader& header)
{
    const ImageFile& file = cursor.file;
    bool hasFormat = false;
    for (std::string_view line = cursor.line(); !line.empty(); line = cursor.line()) {
        size_t equals = line.find('=');
        if (line.starts_with('#') || equals == std::string_view::npos) continue;
        std::string_view name = trimmed(line.substr(0, equals));
        std::string_view value = trimmed(line.substr(equals + 1));
        if (name == "FORMAT") {
            hasFormat = true;
            header.xyz = value == "32-bit_rle_xyze";
            if (!header.xyz && value != "32-bit_rle_rgbe") {
                throw badInput("{}: FORMAT {} is not known; 32-bit_rle_rgbe and _xyze are read",
                               file.name, printable(value));
            }
        } else if (name == "EXPOSURE") {
            parseExposure(file, value, header);
        } else if (name == "COLORCORR") {
            warn(fmt::format("{}: COLORCORR {} is not undone", file.name, printable(value)));
        }
    }
    if (!hasFormat) warn(fmt::format("{}: has no FORMAT line; taken as RGBE", file.name));
}

/// "-Y 480 +X 640": which axis the scanlines follow one another along, and both directions.
void parseResolution(const ImageFile& file, std::string_view line, HdrHeader& header)
{
    std::string_view rest = line;
    std::string_view axis[2], number[2];
    int64_t size[2] = {};
    bool good = true;
    for (int i = 0; i < 2; i++) {
        axis[i] = takeWord(rest);
        number[i] = takeWord(rest);
        good = good && axis[i].size() == 2 && (axis[i][0] == '-' || axis[i][0] == '+') &&
               parseNumber(number[i], size[i]);
    }
    header.columns = good && axis[0][1] == 'X';
    int x = header.columns ? 0 : 1;
    good = good && axis[x][1] == 'X' && axis[1 - x][1] == 'Y' && trimmed(rest).empty();
    if (!good) {
        throw badInput("{}: resolution line {} is not of the kind \"-Y 480 +X 640\"", file.name,
                       printable(line));
    }
    header.flipX = axis[x][0] == '-';
    header.flipY = axis[1 - x][0] == '+';
    header.width = size[x];
    header.height = size[1 - x];
}

void readPlane(Cursor& cursor, std::span<Rgbe> line, size_t plane)
{
    for (size_t i = 0; i < line.size();) {
        uint8_t code = cursor.next();
        bool isRun = code > 128;
        size_t count = isRun ? code - 128u : code;
        if (count == 0 || count > line.size() - i) {
            throw badInput("{}: damaged at byte {}: a run of {} pixels where {} are left",
                           cursor.file.name, cursor.pos - 1, count, line.size() - i);
        }
        uint8_t value = isRun ? cursor.next() : uint8_t{0};
        for (size_t end = i + count; i < end; i++) line[i][plane] = isRun ? value : cursor.next();
    }
}

/// Flat pixels, or the first run-length code: a pixel 1 1 1 n repeats the one before n times, and
/// several of them in a row give the number's bytes from the lowest up.
void readOldScanline(Cursor& cursor, std::span<Rgbe> line, Rgbe first)
{
    Rgbe pixel = first;
    unsigned shift = 0;
    for (size_t i = 0; i < line.size();) {
        if (i > 0) {
            for (uint8_t& byte : pixel) byte = cursor.next();
        }
        if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
            line[i++] = pixel;
            shift = 0;
            continue;
        }
        size_t count = shift < 32 ? size_t{pixel[3]} << shift : line.size() + 1;
        if (i == 0 || count > line.size() - i) {
            throw badInput("{}: damaged at byte {}: a run of {} pixels where {} are left",
                           cursor.file.name, cursor.pos - 4, count, line.size() - i);
        }
        for (size_t end = i + count; i < end; i++) line[i] = line[i - 1];
        shift += 8;
    }
}

void readScanline(Cursor& cursor, std::span<Rgbe> line)
{
    Rgbe first;
    for (uint8_t& byte : first) byte = cursor.next();
    bool canBeNew = line.size() >= 8 && line.size() <= 32767;
    if (!canBeNew || first[0] != 2 || first[1] != 2 || first[2] > 127) {
        readOldScanline(cursor, line, first);
        return;
    }
    size_t width = size_t{first[2]} << 8 | first[3];
    if (width != line.size()) {
        throw badInput("{}: damaged at byte {}: a scanline of {} pixels in a picture of {}",
                       cursor.file.name, cursor.pos - 4, width, line.size());
    }
    for (size_t plane = 0; plane < 4; plane++) readPlane(cursor, line, plane);
}

/// What a mantissa of 1 stands for, by exponent byte. No half step is added to mantissas.
std::array<double, 256> mantissaUnits(double exposure)
{
    std::array<double, 256> units = {};  // exponent 0 means black
    for (int e = 1; e < 256; e++)
        units[static_cast<size_t>(e)] = std::ldexp(1.0, e - 136) / exposure;
    return units;
}

/// CIE XYZ to linear Rec. 709, white D65 (IEC 61966-2-1, Annex F).
void xyzToRgb(float* pixel)
{
    double x = pixel[0], y = pixel[1], z = pixel[2];
    pixel[0] = static_cast<float>(3.2406255 * x - 1.5372080 * y - 0.4986286 * z);
    pixel[1] = static_cast<float>(-0.9689307 * x + 1.8757561 * y + 0.0415175 * z);
    pixel[2] = static_cast<float>(0.0557101 * x - 0.2040211 * y + 1.0569959 * z);
}

}  // namespace

Image decodeHdr(const ImageFile& file)
{
    Cursor cursor = {file};
    HdrHeader header;
    cursor.line();  // the magic word
    parseVariables(cursor, header);
    parseResolution(file, cursor.line(), header);
    requireImageSize(file, header.width, header.height);

    const int64_t lines = header.columns ? header.width : header.height;
    const int64_t lineLength = header.columns ? header.height : header.width;
    if (static_cast<size_t>(lines) * 4 > file.bytes.size()) {
        throw badInput("{}: is truncated: {} bytes cannot hold {} scanlines", file.name,
                       file.bytes.size(), lines);
    }
    Image image = makeImage(file, header.width, header.height);
    std::vector<Rgbe> line(static_cast<size_t>(lineLength));
    const std::array<double, 256> units = mantissaUnits(header.exposure);
    for (int64_t i = 0; i < lines; i++) {
        readScanline(cursor, line);
        for (int64_t k = 0; k < lineLength; k++) {
            int64_t x = header.columns ? i : k;
            int64_t y = header.columns ? k : i;
            if (header.flipX) x = header.width - 1 - x;
            if (header.flipY) y = header.height - 1 - y;
            const Rgbe& in = line[static_cast<size_t>(k)];
            float* pixel = &image.rgb[static_cast<size_t>(3 * (y * header.width + x))];
            for (size_t c = 0; c < 3; c++) pixel[c] = static_cast<float>(in[c] * units[in[3]]);
            if (header.xyz) xyzToRgb(pixel);
        }
    }
    if (size_t left = file.bytes.size() - cursor.pos; left > 0) {
        warn(fmt::format("{}: {} bytes after the last pixel are ignored", file.name, left));
    }
    return image;
}

}  // namespace sahl
