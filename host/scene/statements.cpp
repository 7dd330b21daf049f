#include "scene/statements.h"

#include "scene/numbers.h"
#include "util/error.h"

#include <algorithm>
#include <iterator>

namespace sahl {

namespace {

bool isBlank(char c) { return c == ' ' || c == '\t'; }

constexpr std::string_view BYTE_ORDER_MARK = "\xEF\xBB\xBF";

[[noreturn]] void refuseZeroByte(const std::string& text, size_t at, const std::string& file)
{
    auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    throw badInput("{}:{}: a zero byte: this is binary or UTF-16, not text in UTF-8", file, line);
}

/// Whether there is anything that normaliseLines() changes.
bool isNormal(std::string_view text)
{
    const auto isIn = [&](char c) { return text.find(c) != std::string_view::npos; };
    return !text.starts_with(BYTE_ORDER_MARK) && !isIn('\r') && !isIn('\\') && !isIn('\v') && !isIn('\f');
}

}  // namespace

std::string normaliseLines(std::string text, const std::string& file)
{
    if (size_t zero = text.find('\0'); zero != std::string::npos) refuseZeroByte(text, zero, file);
    if (isNormal(text)) return text;
    std::string lines;
    lines.reserve(text.size() + 1);
    size_t joined = 0;  // line ends owed since the last real one
    size_t i = text.starts_with(BYTE_ORDER_MARK) ? BYTE_ORDER_MARK.size() : 0;
    for (; i < text.size(); i++) {
        if (text[i] != '\n' && text[i] != '\r') {
            lines += text[i] == '\v' || text[i] == '\f' ? ' ' : text[i];
            continue;
        }
        if (text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n') i++;
        if (!lines.empty() && lines.back() == '\\') {
            lines.back() = ' ';
            joined++;
        } else {
            lines.append(joined + 1, '\n');
            joined = 0;
        }
    }
    return lines;
}

bool StatementReader::next(Statement& statement)
{
    while (!rest_.empty()) {
        size_t end = std::min(rest_.find('\n'), rest_.size());
        std::string_view line = rest_.substr(0, end);
        rest_.remove_prefix(std::min(end + 1, rest_.size()));
        line_++;
        std::string_view words = trimmed(line);
        if (words.empty() || words[0] == '#') continue;
        statement.keyword = takeWord(words);
        statement.rest = trimmed(words);
        statement.line = line_;
        statement.file = file_;
        return true;
    }
    return false;
}

std::string at(const Statement& statement)
{
    return fmt::format("{}:{}", statement.file, statement.line);
}

size_t checkNumbers(const Statement& statement, size_t least, size_t most, bool allowNotFinite)
{
    std::string_view rest = statement.rest;
    size_t n = 0;
    for (auto word = takeWord(rest); !word.empty() && word[0] != '#'; word = takeWord(rest), n++) {
        double value = 0;
        NumberText how = parseNumber(word, value);
        if (how == NumberText::notANumber || (how == NumberText::notFinite && !allowNotFinite)) {
            throw badInput("{}: \"{}\" is not a {}number", at(statement), word.substr(0, 40),
                           how == NumberText::notFinite ? "finite " : "");
        }
    }
    if (n < least || n > most) {
        throw badInput("{}: \"{}\" needs {} numbers{}, found {}", at(statement), statement.keyword,
                       n < least ? least : most, n < least ? "" : " at most", n);
    }
    return n;
}

std::string_view takeWord(std::string_view& rest)
{
    const auto begin = std::find_if_not(rest.begin(), rest.end(), isBlank);
    const auto end = std::find_if(begin, rest.end(), isBlank);
    const std::string_view word(begin, end);
    rest = std::string_view(end, rest.end());
    return word;
}

std::string_view trimmed(std::string_view text)
{
    const auto begin = std::find_if_not(text.begin(), text.end(), isBlank);
    const auto end = std::find_if_not(text.rbegin(), std::make_reverse_iterator(begin), isBlank).base();
    return std::string_view(begin, end);
}

}  // namespace sahl
