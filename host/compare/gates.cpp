#include "compare/gates.h"

#include <fmt/format.h>

#include <algorithm>

namespace sahl {

namespace {

GateState stateOf(Verdict verdict)
{
    if (verdict == Verdict::differ) return GateState::failed;
    return verdict == Verdict::undecided ? GateState::undecided : GateState::passed;
}

GateResult limitOf(const std::string& option, const std::string& metric, double value, double limit,
                   const Comparison& comparison)
{
    GateResult result = {option, GateState::failed, ""};
    if (comparison.metrics.unmatchedPixels > 0) {
        result.finding = fmt::format("{} pixels are not finite in one file alone",
                                     comparison.metrics.unmatchedPixels);
        return result;
    }
    if (value <= limit) result.state = GateState::passed;
    result.finding = fmt::format("{} is {:.6g}, at most {:g} is allowed", metric, value, limit);
    return result;
}

}  // namespace

std::vector<GateResult> applyGates(const Gates& gates, const Comparison& comparison)
{
    std::vector<GateResult> results;
    if (gates.bitwise) {
        const bool same = comparison.metrics.differingPixels == 0;
        results.push_back(
            {"--bitwise", same ? GateState::passed : GateState::failed,
             fmt::format("{} pixels differ in their bits", comparison.metrics.differingPixels)});
    }
    if (gates.equivalent) {
        results.push_back({"--equivalent", stateOf(comparison.verdict), comparison.reason});
    }
    if (gates.maxFlip) {
        const bool linear = comparison.metrics.hdrFlip.has_value();
        const Flip& flip = linear ? *comparison.metrics.hdrFlip : comparison.metrics.ldrFlip;
        results.push_back(limitOf("--max-flip", linear ? "mean HDR-FLIP" : "mean LDR-FLIP",
                                  flip.mean.all, *gates.maxFlip, comparison));
    }
    if (gates.maxRelMse) {
        results.push_back(limitOf("--max-relmse", "relMSE", comparison.metrics.relMse.all,
                                  *gates.maxRelMse, comparison));
    }
    return results;
}

int exitCodeOf(const Comparison& comparison, const std::vector<GateResult>& gates)
{
    GateState worst = GateState::passed;
    if (gates.empty()) worst = stateOf(comparison.verdict);
    for (const GateResult& gate : gates) worst = std::max(worst, gate.state);
    return static_cast<int>(worst);
}

}  // namespace sahl
