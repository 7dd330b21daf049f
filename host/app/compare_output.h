// What sahl compare says: a page of text, or JSON (docs/compare.md).
#pragma once

#include "compare/gates.h"

#include <nlohmann/json.hpp>

namespace sahl {

struct ComparedPictures {
    const LoadedPicture& a;
    const LoadedPicture& b;
    const Comparison& comparison;
    const CompareOptions& options;
    const std::vector<GateResult>& gates;
};

/// "same", "equivalent", "undecided" or "differ".
std::string nameOf(Verdict verdict);

nlohmann::ordered_json comparisonJson(const ComparedPictures& compared);

/// To stdout.
void printComparison(const ComparedPictures& compared);

}  // namespace sahl
