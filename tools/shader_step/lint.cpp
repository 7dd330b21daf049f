#include "lint.h"

#include <fmt/format.h>

#include <regex>
#include <sstream>

namespace sahl::shader_step {

namespace {

struct Rule {
    std::regex pattern;
    const char* advice;
};

const std::string LITERAL = R"((?:\d+\.\d*|\.\d+|\d+)(?:e[-+]?\d+)?[fu]?)";

const char* const FOLDED =
    "arithmetic between literals: glslang folds it in double precision; write one literal";

const std::vector<Rule>& rules()
{
    static const std::vector<Rule> all = {
        // Operands to the left decide: x * 2.0f + 1.0f is evaluated from the left and folds nothing.
        {std::regex(R"((^|[(,=<>?:{;!]|\breturn\b)\s*-?)" + LITERAL + R"(\s*[-+*/]\s*-?)" + LITERAL +
                    R"((?![\w.]))"),
         FOLDED},
        {std::regex(R"([-+]\s*)" + LITERAL + R"(\s*[*/]\s*-?)" + LITERAL + R"((?![\w.]))"), FOLDED},
        {std::regex(R"(\bCONST\s+float\s+\w+\s*=(?!\s*-?[\d.]+(e[-+]?\d+)?f;))"),
         "a constant must be one literal with f: expressions are folded in double precision"},
        {std::regex(R"((^|[^\w.])(\d+\.\d*|\.\d+)(e[-+]?\d+)?(?![\w.]))"),
         "a float literal needs the suffix f: without it C++ computes in double precision"},
        {std::regex(R"((^|[^\w.])(dot|cross|normalize|length|distance|mix|min|max|abs|clamp|pow|exp|exp2|log|log2|sin|cos|tan|asin|acos|atan|fma|fract|mod|round|roundEven|sign|step|smoothstep|reflect|refract|inversesqrt|isnan|isinf|inverse|transpose)\s*\()"),
         "built-in function that devices compute differently; math.glsl has our own"},
        {std::regex(R"(\bprecise\b|\bdouble\b|\bfloat16_t\b)"),
         "not for this text: the build decorates NoContraction, and floats have 32 bits"},
        {std::regex(R"([^%]%[^%])"), "% of a negative number differs between devices"},
        {std::regex(R"((\w|\)|\])\.([xyzw]{2,4}|[rgba]{2,4})\b(?!\())"), "GLM has no swizzles by default"},
        {std::regex(R"(\b(in|out|inout)\s+(float|u?int|bool|u?vec\d|[A-Z]\w*)\s+\w)"),
         "write OUT(T) or INOUT(T): C++ knows no in, out and inout"},
        {std::regex(R"(INOUT\(\w+\)\s+\w+\[|OUT\(\w+\)\s+\w+\[|[(,]\s*(float|u?int|u?vec\d)\s+\w+\[\d*\w*\]\s*[,)])"),
         "an array parameter is copied in GLSL and a pointer in C++; wrap it in a struct"},
        {std::regex(R"(\bmat[234](x[234])?\b)"), "matrix products add in any order; write them out"},
        {std::regex(R"(\btexture\s*\(|\b(texelFetch|texture(Lod|Grad|Proj|Offset|Gather|Size|Query))\w*|\b[iu]?sampler([123]D|Cube|Buffer)\w*)"),
         "buffers are read through accessors"},
    };
    return all;
}

/// The line without its // comment.
std::string code(const std::string& line) { return line.substr(0, line.find("//")); }

/// Calls of a function with the same variable twice, where both may be written to.
bool passesOneVariableTwice(const std::string& line)
{
    static const std::regex call(R"((\w+)\(([^()]*)\))");
    static const std::regex declaration(R"(OUT\()");
    if (std::regex_search(line, declaration)) return false;
    for (auto it = std::sregex_iterator(line.begin(), line.end(), call); it != std::sregex_iterator(); ++it) {
        // Functions that take OUT or INOUT parameters are the ones called for their effect: the call is
        // the whole statement.
        std::string before = it->prefix().str();
        if (before.find_first_not_of(" \t") != std::string::npos) continue;
        std::vector<std::string> names;
        std::stringstream list((*it)[2].str());
        for (std::string name; std::getline(list, name, ',');) {
            name.erase(0, name.find_first_not_of(' '));
            for (const auto& other : names) {
                if (other == name && !name.empty()) return true;
            }
            names.push_back(name);
        }
    }
    return false;
}

}  // namespace

std::vector<std::string> lintText(const std::string& file, const std::string& text)
{
    std::vector<std::string> findings;
    std::istringstream lines(text);
    std::string line;
    for (int number = 1; std::getline(lines, line); number++) {
        std::string visible = code(line);
        if (visible.starts_with("#include")) continue;
        for (const Rule& rule : rules()) {
            if (std::regex_search(visible, rule.pattern)) {
                findings.push_back(fmt::format("{}:{}: {}", file, number, rule.advice));
            }
        }
        if (passesOneVariableTwice(visible)) {
            findings.push_back(fmt::format(
                "{}:{}: one variable for two parameters: GLSL copies, C++ aliases", file, number));
        }
    }
    return findings;
}

}  // namespace sahl::shader_step
