// Conditions that a comparison has to meet, and the exit code that follows.
#pragma once

#include "compare/compare.h"

namespace sahl {

struct Gates {
    bool bitwise = false;
    std::optional<double> equivalent;  ///< of the mean luminance
    std::optional<double> maxFlip;     ///< mean HDR-FLIP of linear pictures, else mean LDR-FLIP
    std::optional<double> maxRelMse;
};

enum class GateState { passed, undecided, failed };

struct GateResult {
    std::string name;  ///< as on the command line
    GateState state = GateState::failed;
    std::string finding;  ///< a sentence
};

/// One result for each gate that is set. A gate of a metric fails where pixels are not finite in
/// one picture alone: the metric does not see them.
std::vector<GateResult> applyGates(const Gates& gates, const Comparison& comparison);

/// 0 same or equivalent, 1 undecided, 2 different. Where there are gates they alone decide.
int exitCodeOf(const Comparison& comparison, const std::vector<GateResult>& gates);

}  // namespace sahl
