#include "scene/adaptive.h"

#include "scene/scene_reading.h"
#include "util/error.h"

namespace sahl {

namespace {

constexpr Range EPSILON = {1e-30, 1e30};

/// Empty, or the option that was given though it says nothing under the rule, and why.
std::string uselessOption(const RenderSettings& settings, const SceneOptions& options)
{
    if (settings.adaptive.rule != ADAPTIVE_NONE) {
        if (!options.spp) return "";
        return "--spp says nothing under adaptive sampling, where --min-spp and --max-spp bound "
               "the "
               "samples; or add --adaptive none";
    }
    const char* option = options.epsilon  ? "--epsilon"
                         : options.minSpp ? "--min-spp"
                         : options.maxSpp ? "--max-spp"
                                          : nullptr;
    if (option == nullptr) return "";
    return fmt::format("{} says nothing without adaptive sampling; add --adaptive report", option);
}

}  // namespace

const char* adaptiveRuleName(uint32_t rule)
{
    return rule == ADAPTIVE_REPORT ? "report" : "none";
}

void readAdaptive(const JsonDocument& document, const JsonNode& node, RenderSettings& settings)
{
    JsonObject object(document, node, "\"adaptive\" of the integrator", "adaptive");
    AdaptiveRule& rule = settings.adaptive;
    rule.rule =
        object.choice("rule", {"none", "report"}) == "report" ? ADAPTIVE_REPORT : ADAPTIVE_NONE;
    rule.epsilon = static_cast<float>(object.number("epsilon", double{rule.epsilon}, EPSILON));
    rule.minSamples = object.uint("minSamples", rule.minSamples, 1, MAX_SAMPLES);
    rule.maxSamples = object.uint("maxSamples", rule.maxSamples, 1, MAX_SAMPLES);
    if (rule.minSamples > rule.maxSamples) {
        throw errorAt(document, node,
                      fmt::format("minSamples is {}, above maxSamples, which is {}",
                                  rule.minSamples, rule.maxSamples));
    }
}

void applyAdaptiveOptions(RenderSettings& settings, const SceneOptions& options)
{
    AdaptiveRule& rule = settings.adaptive;
    rule.rule = options.adaptive.value_or(rule.rule);
    rule.epsilon = options.epsilon.value_or(rule.epsilon);
    rule.minSamples = options.minSpp.value_or(rule.minSamples);
    rule.maxSamples = options.maxSpp.value_or(rule.maxSamples);
    std::string useless = uselessOption(settings, options);
    if (!useless.empty()) throw usageError("{}", useless);
    if (rule.rule != ADAPTIVE_NONE && rule.minSamples > rule.maxSamples) {
        throw usageError(
            "at least {} samples per pixel and at most {} contradict each other; change --min-spp "
            "or --max-spp",
            rule.minSamples, rule.maxSamples);
    }
}

}  // namespace sahl
