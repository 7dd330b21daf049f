#include "app/option_kinds.h"

#include "util/error.h"

#include <charconv>
#include <cmath>

namespace sahl {

namespace {

/// All of `text` as a number, whatever the locale.
template <class Number>
std::errc parseWhole(const std::string& text, Number& number)
{
    const char* end = text.data() + text.size();
    auto [stopped, error] = std::from_chars(text.data(), end, number);
    return error == std::errc() && stopped != end ? std::errc::invalid_argument : error;
}

/// Whether `text` is a whole number, of any size and sign.
bool isWhole(const std::string& text)
{
    size_t digits = text.starts_with('-') ? 1 : 0;
    return text.size() > digits &&
           text.find_first_not_of("0123456789", digits) == std::string::npos;
}

}  // namespace

uint32_t parseNumber(const std::string& option, const std::string& text, NumberRange range)
{
    uint32_t number = 0;
    if (!isWhole(text)) {
        throw CLI::ValidationError(
            fmt::format("{} '{}' is not a whole number; give one from {} to {}", option, text,
                        range.lo, range.hi));
    }
    std::errc error = parseWhole(text, number);
    if (error != std::errc() || number < range.lo || number > range.hi) {
        throw CLI::ValidationError(fmt::format("{} {} is out of range; give a number from {} to {}",
                                               option, text, range.lo, range.hi));
    }
    return number;
}

double parseReal(const std::string& option, const std::string& text, double lo, double hi)
{
    double number = 0;
    std::errc error = parseWhole(text, number);
    if (error == std::errc::invalid_argument || !std::isfinite(number)) {
        throw CLI::ValidationError(
            fmt::format("{} '{}' is not a number; give one from {} to {}", option, text, lo, hi));
    }
    if (error != std::errc() || number < lo || number > hi) {
        throw CLI::ValidationError(fmt::format("{} {} is out of range; give a number from {} to {}",
                                               option, text, lo, hi));
    }
    return number;
}

size_t parseChoice(const std::string& option, const std::string& text,
                   const std::vector<std::string>& names)
{
    auto found = std::find(names.begin(), names.end(), text);
    if (found != names.end()) return static_cast<size_t>(found - names.begin());
    std::string near = suggestion(text, names);
    std::string hint = near.empty() ? "choose " + enumeration(names) : "did you mean " + near + "?";
    throw CLI::ValidationError(fmt::format("{} '{}' is not known; {}", option, text, hint));
}

CLI::Option* addFlag(CLI::App& command, const std::string& name, bool& target,
                     const std::string& help)
{
    return command.add_flag(name, target, help)->disable_flag_override();
}

std::string withDefault(const std::string& text, const std::string& standard)
{
    return fmt::format("{} (default: {})", text, standard);
}

std::string enumeration(const std::vector<std::string>& names)
{
    std::string text;
    for (size_t i = 0; i < names.size(); i++) {
        if (i > 0) text += i + 1 == names.size() ? " or " : ", ";
        text += names[i];
    }
    return text;
}

}  // namespace sahl
