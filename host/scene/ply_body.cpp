#include "scene/ply_body.h"

#include "scene/numbers.h"
#include "scene/statements.h"
#include "util/error.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace sahl {

namespace {

constexpr double NOT_FINITE = std::numeric_limits<double>::quiet_NaN();

/// The least that an item can take; in text a digit and a blank for each number.
uint64_t leastBytes(const PlyElement& element, bool isText)
{
    uint64_t bytes = 0;
    for (const PlyProperty& property : element.properties) {
        bytes += isText ? 2 : bytesOf(property.isList ? property.countType : property.type);
    }
    return bytes;
}

double decode(std::string_view bytes, PlyType type, bool bigEndian)
{
    uint64_t bits = 0;
    for (size_t i = 0; i < bytes.size(); i++) {
        bits = bits << 8 | static_cast<uint8_t>(bytes[bigEndian ? i : bytes.size() - 1 - i]);
    }
    switch (type) {
    case PlyType::int8:
        return static_cast<int8_t>(bits);
    case PlyType::int16:
        return static_cast<int16_t>(bits);
    case PlyType::int32:
        return static_cast<int32_t>(bits);
    case PlyType::float32:
        return std::bit_cast<float>(static_cast<uint32_t>(bits));
    case PlyType::float64:
        return std::bit_cast<double>(bits);
    default:
        return static_cast<double>(bits);  // unsigned, below 2^32
    }
}

}  // namespace

PlyBody::PlyBody(std::string_view bytes, const PlyHeader& header, const std::string& file)
    : format_(header.format),
      file_(file),
      size_(bytes.size()),
      rest_(bytes.substr(header.bodyStart)),
      lineNumber_(header.lines)
{
}

std::string PlyBody::where() const
{
    if (isText()) return fmt::format("{}:{}", file_, lineNumber_);
    return fmt::format("{}: byte {} ({} {})", file_, valueAt_, element_->name, index_);
}

void PlyBody::beginElement(const PlyElement& element)
{
    element_ = &element;
    index_ = 0;
    uint64_t least = leastBytes(element, isText());
    uint64_t left = rest_.size() + (isText() ? 1 : 0);  // the last line need not end
    if (least == 0 || element.count <= left / least) return;
    throw badInput("{}: is truncated, or its header is wrong: {} elements {} of at least {} bytes "
                   "each cannot be in the {} bytes that are left",
                   file_, element.count, quoted(element.name), least, rest_.size());
}

void PlyBody::beginItem(uint64_t index)
{
    index_ = index;
    if (!isText()) return;
    line_ = {};
    while (line_.empty()) {
        if (rest_.empty()) {
            throw badInput("{}: the file ends, and {} {} of {} is missing", where(), element_->name,
                           index, element_->count);
        }
        size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
        line_ = trimmed(rest_.substr(0, end));
        bool twoBytes = rest_.substr(end).starts_with("\r\n");
        rest_.remove_prefix(std::min(end + (twoBytes ? 2 : 1), rest_.size()));
        lineNumber_++;
    }
}

double PlyBody::number(std::string_view word, const PlyProperty& property) const
{
    if (word.empty()) {
        throw badInput("{}: {} {} has no value for property {}", where(), element_->name, index_,
                       quoted(property.name));
    }
    double value = 0;
    switch (parseNumber(word, value)) {
    case NumberText::fine:
        return value;
    case NumberText::notFinite:
        return NOT_FINITE;
    default:
        throw badInput("{}: {} is not a number", where(), quoted(word));
    }
}

double PlyBody::scalar(PlyType type, const PlyProperty& property)
{
    if (isText()) return number(takeWord(line_), property);
    size_t bytes = bytesOf(type);
    valueAt_ = size_ - rest_.size();
    if (bytes > rest_.size()) {
        throw badInput("{}: is truncated within property {}", where(), quoted(property.name));
    }
    double value = decode(rest_.substr(0, bytes), type, format_ == PlyFormat::bigEndian);
    rest_.remove_prefix(bytes);
    return std::abs(value) <= std::numeric_limits<float>::max() ? value : NOT_FINITE;
}

double PlyBody::value(const PlyProperty& property)
{
    return scalar(property.type, property);
}

uint64_t PlyBody::listLength(const PlyProperty& property)
{
    double length = scalar(property.countType, property);
    if (!(length >= 0 && length < 0x1p63 && length == std::floor(length))) {
        throw badInput("{}: {} is no length of the list {}", where(), length,
                       quoted(property.name));
    }
    auto count = static_cast<uint64_t>(length);
    uint64_t room = isText() ? (line_.size() + 1) / 2 : rest_.size() / bytesOf(property.type);
    if (count > room) {
        throw badInput("{}: the list {} of {} values does not fit into the {} bytes that are left",
                       where(), quoted(property.name), count,
                       isText() ? line_.size() : rest_.size());
    }
    return count;
}

void PlyBody::skip(const PlyProperty& property)
{
    uint64_t count = property.isList ? listLength(property) : 1;
    for (uint64_t i = 0; i < count; i++) scalar(property.type, property);
}

size_t PlyBody::bytesLeft() const
{
    size_t start = isText() ? rest_.find_first_not_of(" \t\r\n") : 0;
    return start == std::string_view::npos ? 0 : rest_.size() - start;
}

void PlyBody::endItem()
{
    if (isText() && !trimmed(line_).empty()) {
        throw badInput("{}: {} {} has more values than properties, from {} on", where(),
                       element_->name, index_, quoted(trimmed(line_)));
    }
}

}  // namespace sahl
