#include "scene/ply_header.h"

#include "scene/statements.h"
#include "util/error.h"

#include <algorithm>
#include <charconv>
#include <utility>

namespace sahl {

namespace {

/// No sensible header has more; a file that is no PLY soon has.
constexpr size_t MAX_LINE = 4096, MAX_ELEMENTS = 256, MAX_PROPERTIES = 1024, MAX_NAME = 64;

struct HeaderReading {
    std::string_view bytes;
    std::string_view
        lineEnd;       ///< as behind the first line; data may begin with either of its bytes
    std::string file;  ///< for messages
    PlyHeader header;
    bool formatKnown = false;
    std::string_view rest;  ///< of the current line
};

std::string at(const HeaderReading& reading)
{
    return fmt::format("{}:{}", reading.file, reading.header.lines);
}

/// Takes the next line. Throws badInput at the end of the file.
void nextLine(HeaderReading& reading)
{
    PlyHeader& header = reading.header;
    std::string_view rest = reading.bytes.substr(header.bodyStart);
    size_t end = rest.substr(0, MAX_LINE).find(reading.lineEnd);
    header.lines++;
    if (end == std::string_view::npos) {
        if (rest.size() < MAX_LINE) {
            throw badInput("{}: the file ends within the header; \"end_header\" is missing",
                           at(reading));
        }
        throw badInput("{}: a line of the header has more than {} characters", at(reading),
                       MAX_LINE);
    }
    reading.rest = trimmed(rest.substr(0, end));
    header.bodyStart += end + reading.lineEnd.size();
}

/// The next word of the line; `what` it should be when it is not there.
std::string_view requireWord(HeaderReading& reading, const char* what)
{
    std::string_view word = takeWord(reading.rest);
    if (word.empty()) throw badInput("{}: {} is missing", at(reading), what);
    return word;
}

/// Likewise, of characters that messages can show.
std::string requireName(HeaderReading& reading, const char* what)
{
    std::string_view name = requireWord(reading, what);
    bool printable =
        std::all_of(name.begin(), name.end(), [](char c) { return c >= '!' && c <= '~'; });
    if (!printable || name.size() > MAX_NAME) {
        throw badInput("{}: {} is {}; names have at most {} letters, digits and signs", at(reading),
                       what, quoted(name), MAX_NAME);
    }
    return std::string(name);
}

void readMagic(HeaderReading& reading)
{
    std::string_view first = reading.bytes.substr(0, 16);
    size_t end = std::min(first.find_first_of("\r\n"), first.size());
    if (trimmed(first.substr(0, end)) != "ply") {
        throw badInput("{}: is no PLY file: it begins with {}, not with a line \"ply\"",
                       reading.file, quoted(first.substr(0, end)));
    }
    first.remove_prefix(end);
    reading.lineEnd = first.starts_with("\r\n") ? "\r\n" : first.starts_with("\r") ? "\r" : "\n";
    nextLine(reading);
}

void readFormat(HeaderReading& reading)
{
    static const std::pair<std::string_view, PlyFormat> formats[] = {
        {"ascii", PlyFormat::ascii},
        {"binary_little_endian", PlyFormat::littleEndian},
        {"binary_big_endian", PlyFormat::bigEndian}};
    std::string_view name = requireWord(reading, "the format");
    std::string_view version = requireWord(reading, "the version of the format");
    auto found = std::find_if(std::begin(formats), std::end(formats),
                              [&](const auto& format) { return format.first == name; });
    if (found == std::end(formats) || version != "1.0") {
        throw badInput("{}: format {} {} is not known; ascii, binary_little_endian and "
                       "binary_big_endian 1.0 are read",
                       at(reading), quoted(name), quoted(version));
    }
    if (std::exchange(reading.formatKnown, true)) {
        throw badInput("{}: the format is there twice", at(reading));
    }
    reading.header.format = found->second;
}

PlyType readType(HeaderReading& reading)
{
    static const std::pair<std::string_view, PlyType> types[] = {
        {"char", PlyType::int8},      {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
        {"uint8", PlyType::uint8},    {"short", PlyType::int16},     {"int16", PlyType::int16},
        {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},   {"int", PlyType::int32},
        {"int32", PlyType::int32},    {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
        {"float", PlyType::float32},  {"float32", PlyType::float32}, {"double", PlyType::float64},
        {"float64", PlyType::float64}};
    std::string_view name = requireWord(reading, "the type of the property");
    for (const auto& [word, type] : types) {
        if (word == name) return type;
    }
    throw badInput("{}: type {} is not known; there are char, uchar, short, ushort, int, uint, "
                   "float and double",
                   at(reading), quoted(name));
}

void readElement(HeaderReading& reading)
{
    std::vector<PlyElement>& elements = reading.header.elements;
    std::string name = requireName(reading, "the name of the element");
    std::string_view text = requireWord(reading, "the number of elements");
    uint64_t count = 0;
    auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), count);
    if (error != std::errc() || stop != text.data() + text.size()) {
        throw badInput("{}: {} is no number of elements", at(reading), quoted(text));
    }
    for (const PlyElement& element : elements) {
        if (element.name == name) {
            throw badInput("{}: element {} is there twice", at(reading), quoted(name));
        }
    }
    if (elements.size() == MAX_ELEMENTS) {
        throw badInput("{}: more than {} kinds of elements", at(reading), MAX_ELEMENTS);
    }
    elements.push_back({name, count, {}});
}

void readProperty(HeaderReading& reading)
{
    if (reading.header.elements.empty()) {
        throw badInput("{}: a property before the first element", at(reading));
    }
    PlyElement& element = reading.header.elements.back();
    PlyProperty property;
    std::string_view ahead = reading.rest;
    if (takeWord(ahead) == "list") {
        reading.rest = ahead;
        property.isList = true;
        property.countType = readType(reading);
    }
    property.type = readType(reading);
    property.name = requireName(reading, "the name of the property");
    for (const PlyProperty& other : element.properties) {
        if (other.name == property.name) {
            throw badInput("{}: property {} of element {} is there twice", at(reading),
                           quoted(property.name), quoted(element.name));
        }
    }
    if (element.properties.size() == MAX_PROPERTIES) {
        throw badInput("{}: more than {} properties", at(reading), MAX_PROPERTIES);
    }
    element.properties.push_back(std::move(property));
}

}  // namespace

size_t bytesOf(PlyType type)
{
    switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
        return 1;
    case PlyType::int16:
    case PlyType::uint16:
        return 2;
    case PlyType::float64:
        return 8;
    default:
        return 4;
    }
}

std::string quoted(std::string_view text)
{
    std::string result = "\"";
    for (char c : text.substr(0, 40)) result += c >= ' ' && c <= '~' ? c : '?';
    return result + (text.size() > 40 ? "...\"" : "\"");
}

PlyHeader readPlyHeader(std::string_view bytes, const std::string& file)
{
    HeaderReading reading;
    reading.bytes = bytes;
    reading.file = file;
    readMagic(reading);
    while (true) {
        nextLine(reading);
        std::string_view keyword = takeWord(reading.rest);
        if (keyword == "comment" || keyword == "obj_info" || keyword.empty()) continue;
        if (keyword == "format")
            readFormat(reading);
        else if (keyword == "element")
            readElement(reading);
        else if (keyword == "property")
            readProperty(reading);
        else if (keyword != "end_header")
            throw badInput("{}: {} is no statement of a PLY header", at(reading), quoted(keyword));
        if (!trimmed(reading.rest).empty()) {
            throw badInput("{}: {} behind the end of the statement", at(reading),
                           quoted(trimmed(reading.rest)));
        }
        if (keyword == "end_header") break;
    }
    if (!reading.formatKnown) throw badInput("{}: the header names no format", file);
    return std::move(reading.header);
}

}  // namespace sahl
