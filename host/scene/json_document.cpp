#include "scene/json_document.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <unordered_set>

namespace sahl {

namespace {

using Nlohmann = nlohmann::json;

/// Builds the tree from the parser's events. The events come without positions, but in the order
/// of the text and only for text that is valid so far, so a cursor that skips what lies between two
/// values finds each of them.
class TreeBuilder : public nlohmann::json_sax<Nlohmann> {
public:
    explicit TreeBuilder(JsonDocument& document) : document_(document)
    {
        if (document.text.starts_with("\xEF\xBB\xBF")) cursor_ = 3;
    }

    bool null() override
    {
        add(JsonNode::Kind::null);
        return true;
    }
    bool boolean(bool value) override
    {
        add(JsonNode::Kind::boolean).truth = value;
        return true;
    }
    bool number_integer(number_integer_t value) override
    {
        return number(static_cast<double>(value));
    }
    bool number_unsigned(number_unsigned_t value) override
    {
        return number(static_cast<double>(value));
    }
    bool number_float(number_float_t value, const string_t&) override { return number(value); }
    bool string(string_t& value) override
    {
        add(JsonNode::Kind::string).text = value;
        return true;
    }
    bool binary(binary_t&) override { return false; }  // not part of JSON text
    bool start_object(std::size_t) override { return open(JsonNode::Kind::object); }
    bool start_array(std::size_t) override { return open(JsonNode::Kind::array); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }

    bool key(string_t& name) override
    {
        size_t offset = nextToken();
        cursor_ = endOfScalar(offset);
        if (!names_.back().insert(name).second) {
            throw badInput("{}: duplicate key \"{}\"", document_.where(offset), name);
        }
        path_.back()->keys.push_back({name, static_cast<uint32_t>(offset)});
        return true;
    }

    bool parse_error(std::size_t position, const std::string&,
                     const nlohmann::detail::exception& error) override
    {
        // "[json.exception...] parse error at line 1, column 2: syntax error while ..."
        std::string why = error.what();
        size_t column = why.find("column ");
        size_t colon = column == std::string::npos ? column : why.find(": ", column);
        if (colon != std::string::npos) why = why.substr(colon + 2);
        if (why.starts_with("[json.exception")) why = why.substr(why.find("] ") + 2);
        size_t offset = position > 0 ? position - 1 : 0;
        throw badInput("{}: {}", document_.where(offset), why);
    }

private:
    /// Offset of the next value, key or closing bracket.
    size_t nextToken() const
    {
        size_t at = document_.text.find_first_not_of(" \t\r\n,:", cursor_);
        return std::min(at, document_.text.size());
    }

    size_t endOfScalar(size_t begin) const
    {
        const std::string& text = document_.text;
        if (begin >= text.size() || text[begin] != '"') {
            return std::min(text.find_first_of(" \t\r\n,:]}", begin), text.size());
        }
        size_t at = begin + 1;
        while (at < text.size() && text[at] != '"') at += text[at] == '\\' ? 2 : 1;
        return std::min(at + 1, text.size());
    }

    JsonNode& place(JsonNode::Kind kind, size_t offset)
    {
        JsonNode* node = &document_.root;
        if (!path_.empty()) node = &path_.back()->items.emplace_back();
        node->kind = kind;
        node->offset = static_cast<uint32_t>(offset);
        return *node;
    }

    JsonNode& add(JsonNode::Kind kind)
    {
        size_t offset = nextToken();
        cursor_ = endOfScalar(offset);
        return place(kind, offset);
    }

    bool number(double value)
    {
        add(JsonNode::Kind::number).number = value;
        return true;
    }

    bool open(JsonNode::Kind kind)
    {
        size_t offset = nextToken();
        cursor_ = offset + 1;
        if (path_.size() >= MAX_JSON_DEPTH) {
            throw badInput("{}: nested deeper than {} levels", document_.where(offset),
                           MAX_JSON_DEPTH);
        }
        path_.push_back(&place(kind, offset));
        names_.emplace_back();
        return true;
    }

    bool close()
    {
        cursor_ = nextToken() + 1;
        path_.pop_back();
        names_.pop_back();
        return true;
    }

    JsonDocument& document_;
    size_t cursor_ = 0;
    std::vector<JsonNode*> path_;  ///< open objects and arrays; stable while they are open
    std::vector<std::unordered_set<std::string>> names_;  ///< keys of each of them
};

}  // namespace

std::string JsonDocument::where(size_t offset) const
{
    offset = std::min(offset, text.size());
    auto begin = text.begin(), end = text.begin() + static_cast<std::ptrdiff_t>(offset);
    auto line = 1 + std::count(begin, end, '\n');
    size_t lineStart = offset == 0 ? std::string::npos : text.rfind('\n', offset - 1);
    auto first =
        begin + (lineStart == std::string::npos ? 0 : static_cast<std::ptrdiff_t>(lineStart) + 1);
    // Bytes 10xxxxxx continue a character of UTF-8.
    auto column = 1 + std::count_if(first, end, [](char c) { return (c & 0xC0) != 0x80; });
    return fmt::format("{}:{}:{}", file, line, column);
}

JsonDocument parseJson(const std::string& file, const std::string& text)
{
    JsonDocument document;
    document.file = file;
    document.text = text;
    TreeBuilder builder(document);
    Nlohmann::sax_parse(document.text, &builder, nlohmann::detail::input_format_t::json, true);
    return document;
}

const char* kindName(JsonNode::Kind kind)
{
    switch (kind) {
    case JsonNode::Kind::null:
        return "null";
    case JsonNode::Kind::boolean:
        return "true or false";
    case JsonNode::Kind::number:
        return "a number";
    case JsonNode::Kind::string:
        return "a text";
    case JsonNode::Kind::array:
        return "an array";
    case JsonNode::Kind::object:
        break;
    }
    return "an object";
}

}  // namespace sahl
