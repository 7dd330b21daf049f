// A comparison as one page for a browser, for people who want to see where two pictures differ.
#pragma once

#include "compare/compare.h"

#include <string_view>

namespace sahl {

/// HTML that needs no network and no other file: A, B, their signed difference, FLIP and z with
/// linked zoom, histograms, and what was measured. Both pictures are in it with all their float
/// values.
///   json  the comparison as sahl compare --json gives it (docs/compare.md)
std::string reportPage(std::string_view json, const LoadedPicture& a, const LoadedPicture& b,
                       const Comparison& comparison);

}  // namespace sahl
