#include "scene/data_uri.h"

#include <algorithm>

namespace sahl {

namespace {

constexpr std::string_view SCHEME = "data:";
constexpr std::string_view BASE64 = ";base64";

/// Value of a digit of base64; 64 for other characters.
uint32_t base64Digit(char c)
{
    if (c >= 'A' && c <= 'Z') return static_cast<uint32_t>(c - 'A');
    if (c >= 'a' && c <= 'z') return static_cast<uint32_t>(c - 'a') + 26;
    if (c >= '0' && c <= '9') return static_cast<uint32_t>(c - '0') + 52;
    if (c == '+') return 62;
    return c == '/' ? 63 : 64;
}

/// RFC 4648, with or without the = at the end.
std::vector<uint8_t> decodeBase64(std::string_view text, const std::string& where)
{
    if (text.size() % 4 == 0) {
        for (int i = 0; i < 2 && text.ends_with('='); i++) text.remove_suffix(1);
    }
    if (text.size() % 4 == 1) throw badInput("{}: the base64 text is cut short", where);
    std::vector<uint8_t> bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    uint32_t bits = 0, count = 0;
    for (const char c : text) {
        const uint32_t digit = base64Digit(c);
        if (digit > 63) {
            throw badInput("{}: character {:#04x} is not base64", where,
                           static_cast<unsigned>(static_cast<unsigned char>(c)));
        }
        bits = bits << 6 | digit;
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes.push_back(static_cast<uint8_t>(bits >> count));
        bits &= (1u << count) - 1;
    }
    return bytes;
}

/// Whether each of the parameters between semicolons is key=value; the first may be a type.
bool areParameters(std::string_view text)
{
    if (text.ends_with(';')) return false;
    bool first = true;
    while (!text.empty() || first) {
        const std::string_view part = text.substr(0, text.find(';'));
        const bool isType = first && (part.empty() || part.find('/') != std::string_view::npos);
        if (!isType && (part.find('=') == std::string_view::npos || part.front() == '='))
            return false;
        text.remove_prefix(std::min(part.size() + 1, text.size()));
        first = false;
    }
    return true;
}

/// Whether the URI begins with "word:" where a word has letters, digits, '+', '-' and '.'.
bool hasScheme(std::string_view uri)
{
    const size_t colon = uri.find(':');
    return colon != std::string_view::npos && colon < uri.find_first_of("/?#");
}

int hexDigit(char c)
{
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

}  // namespace

bool isDataUri(std::string_view uri)
{
    return uri.starts_with(SCHEME);
}

std::vector<uint8_t> readDataUri(std::string_view uri, const std::string& where)
{
    const size_t comma = uri.find(',');
    std::string_view head = uri.substr(0, comma);
    head.remove_prefix(SCHEME.size());
    const bool hasForm = comma != std::string_view::npos && head.ends_with(BASE64) &&
                         areParameters(head.substr(0, head.size() - BASE64.size()));
    if (!hasForm) {
        throw badInput("{}: \"{}...\" is not of the form data:TYPE;base64,CONTENT", where,
                       uri.substr(0, 40));
    }
    return decodeBase64(uri.substr(comma + 1), where);
}

std::string fileNameOfUri(std::string_view uri, const std::string& where)
{
    if (hasScheme(uri)) {
        throw badInput("{}: \"{}\": only names of files and data: URIs are read", where,
                       uri.substr(0, 80));
    }
    std::string name;
    for (size_t i = 0; i < uri.size(); i++) {
        if (uri[i] != '%') {
            name += uri[i];
            continue;
        }
        const int high = i + 2 < uri.size() ? hexDigit(uri[i + 1]) : -1;
        const int low = i + 2 < uri.size() ? hexDigit(uri[i + 2]) : -1;
        if (high < 0 || low < 0) {
            throw badInput("{}: \"{}\": % must be followed by two hexadecimal digits", where,
                           uri.substr(0, 80));
        }
        name += static_cast<char>(high * 16 + low);
        i += 2;
    }
    return name;
}

}  // namespace sahl
