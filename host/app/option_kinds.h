// The kinds of options that subcommands are made of. Each says its range and default in --help, and
// refuses other values naming the option, what was given and what would be right.
#pragma once

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sahl {

struct NumberRange {
    uint32_t lo, hi;
};

/// Throws a CLI::ValidationError that names `option` unless `text` is a number in the range.
uint32_t parseNumber(const std::string& option, const std::string& text, NumberRange range);
double parseReal(const std::string& option, const std::string& text, double lo, double hi);

/// The place of `text` in `names`; a CLI::ValidationError suggests a near one.
size_t parseChoice(const std::string& option, const std::string& text,
                   const std::vector<std::string>& names);

/// `text` with the default, as --help shows it.
std::string withDefault(const std::string& text, const std::string& standard);

/// "a, b or c"
std::string enumeration(const std::vector<std::string>& names);

/// --name N. `standard`: what holds when the option is not given, in words.
template <class Target>
CLI::Option* addNumber(CLI::App& command, const std::string& name, Target& target,
                       NumberRange range, const std::string& help, const std::string& standard)
{
    std::string option = name.substr(0, name.find(','));
    auto set = [&target, option, range](const std::string& text) {
        target = parseNumber(option, text, range);
    };
    std::string text = fmt::format("{}, {} to {}", help, range.lo, range.hi);
    return command.add_option_function<std::string>(name, set, withDefault(text, standard))
        ->type_name("N");
}

/// --name NAME, one of `choices`; the target's present value is the default.
template <class Target>
CLI::Option* addChoice(CLI::App& command, const std::string& name, Target& target,
                       const std::vector<std::pair<std::string, Target>>& choices,
                       const std::string& help)
{
    std::vector<std::string> names;
    std::string standard;
    for (const auto& [word, value] : choices) {
        names.push_back(word);
        if (value == target) standard = word;
    }
    auto set = [&target, name, choices, names](const std::string& text) {
        target = choices[parseChoice(name, text, names)].second;
    };
    return command.add_option_function<std::string>(name, set, withDefault(help, standard))
        ->type_name("NAME");
}

/// --name, without a value.
CLI::Option* addFlag(CLI::App& command, const std::string& name, bool& target,
                     const std::string& help);

/// --name NAME, one of `names`, kept as text.
template <class Target>
CLI::Option* addWord(CLI::App& command, const std::string& name, Target& target,
                     const std::vector<std::string>& names, const std::string& help,
                     const std::string& standard)
{
    auto set = [&target, name, names](const std::string& text) {
        target = names[parseChoice(name, text, names)];
    };
    return command.add_option_function<std::string>(name, set, withDefault(help, standard))
        ->type_name("NAME");
}

}  // namespace sahl
