// The lines of OBJ and MTL files: a keyword and its words.
#pragma once

#include <string>
#include <string_view>

namespace sahl {

/// One line of text, without comment.
struct Statement {
    std::string_view keyword;
    std::string_view rest;  ///< behind the keyword, trimmed
    size_t line = 0;        ///< from 1
    std::string_view file;  ///< its name, for messages
};

/// Makes every line end in one '\n', joins lines that end in a backslash (keeping later line
/// numbers right), drops a byte order mark and makes vertical tabs and form feeds, which
/// tinyobjloader does not take for blanks, spaces. Throws badInput naming `file` and line when the
/// text holds a zero byte: it is binary or UTF-16.
std::string normaliseLines(std::string text, const std::string& file);

/// Walks over the statements of a text from normaliseLines, leaving out empty lines and comments.
class StatementReader {
public:
    StatementReader(std::string_view text, std::string_view file) : rest_(text), file_(file) {}

    /// False at the end of the text.
    bool next(Statement& statement);

private:
    std::string_view rest_, file_;
    size_t line_ = 0;
};

/// "FILE:LINE"
std::string at(const Statement& statement);

/// Checks that `least` to `most` decimal numbers, and nothing else but a comment, stand behind the
/// keyword, and returns how many. Throws badInput naming file and line.
size_t checkNumbers(const Statement& statement, size_t least, size_t most,
                    bool allowNotFinite = false);

/// Takes the next word off the front of `rest`; empty at the end.
std::string_view takeWord(std::string_view& rest);

std::string_view trimmed(std::string_view text);

}  // namespace sahl
