#include "scene/numbers.h"

#include <charconv>
#include <cmath>
#include <limits>

namespace sahl {

namespace {

/// from_chars does not say whether "out of range" means too large or too small.
bool isTooSmall(std::string_view text)
{
    size_t exponent = text.find_first_of("eE");
    if (exponent != std::string_view::npos && exponent + 1 < text.size()) {
        return text[exponent + 1] == '-';
    }
    return text.substr(0, text.find('.')).find_first_of("123456789") == std::string_view::npos;
}

}  // namespace

NumberText parseNumber(std::string_view text, double& value)
{
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    const char* end = text.data() + text.size();
    auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error == std::errc::invalid_argument || stop != end) return NumberText::notANumber;
    if (error == std::errc::result_out_of_range) {
        if (!isTooSmall(text)) return NumberText::notFinite;
        value = 0;
    }
    if (!(std::abs(value) <= std::numeric_limits<float>::max())) return NumberText::notFinite;
    return NumberText::fine;
}

float toFloat(double value)
{
    return std::abs(value) < SMALLEST_MAGNITUDE ? 0.0f : static_cast<float>(value);
}

vec3 toFloat(const glm::dvec3& value)
{
    return vec3(toFloat(value.x), toFloat(value.y), toFloat(value.z));
}

bool isFinite(const glm::dvec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace sahl
