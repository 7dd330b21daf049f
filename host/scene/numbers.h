// Numbers on their way from text to the device: read without regard to the locale, rounded once.
#pragma once

#include "shared/interop.h"

#include <string_view>

namespace sahl {

/// Magnitudes below this become 0 on load: some devices flush denormals, and none may see any.
constexpr double SMALLEST_MAGNITUDE = 1e-30;

/// How reading a number went.
enum class NumberText {
    fine,
    notANumber,  ///< not a decimal number as a whole
    notFinite,   ///< inf, nan, or beyond the range of a float
};

/// Reads all of `text` as a decimal number ("-1.5e3", a leading '+' is allowed) whatever the
/// locale. What lies below the range of a double becomes 0.
NumberText parseNumber(std::string_view text, double& value);

/// Nearest float; magnitudes below SMALLEST_MAGNITUDE become +0.
float toFloat(double value);
vec3 toFloat(const glm::dvec3& value);

bool isFinite(const glm::dvec3& v);

}  // namespace sahl
