#include "scene/adaptive.h"

#include "scene/scene_reading.h"
#include "util/error.h"

#include <algorithm>
#include <utility>

namespace sahl {

namespace {

constexpr Range EPSILON = {1e-30, 1e30};
constexpr Range TARGET = {1e-6, 1};

/// Least and most samples where nothing is said.
void takeDefaultBounds(AdaptiveRule& rule)
{
    const bool inBlocks = rule.rule == ADAPTIVE_CROSSED || rule.rule == ADAPTIVE_JOINT;
    rule.minSamples = inBlocks ? 64 : 20;
    rule.maxSamples = inBlocks ? 1024 : 1000;
}

/// Empty, or what is wrong with a rule and its bounds, which go by the names `least` and `most`.
std::string wrongBounds(const RenderSettings& settings, const char* least, const char* most)
{
    const AdaptiveRule& rule = settings.adaptive;
    if (rule.rule == ADAPTIVE_REPORT && settings.samplerKind == SAMPLER_SOBOL) {
        return "the rule report looks at single samples, and the sampler sobol ties 8 of them together; take "
               "crossed or joint, or the sampler independent";
    }
    if (rule.rule != ADAPTIVE_NONE && settings.samplerKind == SAMPLER_SOBOL64) {
        return fmt::format("the rule {} takes 8 samples at a time, and the sampler sobol64 ties 64 of them together; take "
                           "the sampler sobol or independent",
                           adaptiveRuleName(rule.rule));
    }
    if (rule.minSamples > rule.maxSamples) {
        return fmt::format("{} is {}, above {}, which is {}", least, rule.minSamples, most, rule.maxSamples);
    }
    const uint32_t unit = rule.rule == ADAPTIVE_CROSSED ? 2 * BLOCK_SIZE
                          : rule.rule == ADAPTIVE_JOINT ? BLOCK_SIZE
                                                        : 1;
    for (auto [name, samples] : {std::pair{least, rule.minSamples}, std::pair{most, rule.maxSamples}}) {
        if (samples % unit == 0) continue;
        const uint32_t below = samples / unit * unit;
        return fmt::format("{} is {}, and {} takes samples in blocks of 8{}; give a multiple of {}, such as {}",
                           name, samples, adaptiveRuleName(rule.rule),
                           unit == BLOCK_SIZE ? "" : ", as many in each half", unit,
                           below > 0 ? below : unit);
    }
    // Of a single block nothing tells how noisy it is.
    if (settings.samplerKind == SAMPLER_SOBOL && unit > 1 && rule.minSamples < 2 * unit) {
        return fmt::format("{} is {}, and by the sampler sobol {} needs 2 blocks of 8 samples{} to see noise; give "
                           "{} at least",
                           least, rule.minSamples, adaptiveRuleName(rule.rule),
                           unit == BLOCK_SIZE ? "" : " in each half", 2 * unit);
    }
    return "";
}

/// Empty, or the option that was given though it says nothing under the rule, and why.
std::string uselessOption(const RenderSettings& settings, const SceneOptions& options)
{
    const uint32_t rule = settings.adaptive.rule;
    if (rule != ADAPTIVE_NONE && options.spp) {
        return "--spp says nothing under adaptive sampling, where --min-spp and --max-spp bound "
               "the "
               "samples; or add --adaptive none";
    }
    if (options.epsilon && rule != ADAPTIVE_NONE && rule != ADAPTIVE_REPORT) {
        return fmt::format("--epsilon says nothing under the rule {}, whose accuracy is --target-error",
                           adaptiveRuleName(rule));
    }
    if (options.targetError && (rule == ADAPTIVE_NONE || rule == ADAPTIVE_REPORT)) {
        return fmt::format("--target-error says nothing under the rule {}; add --adaptive crossed (unbiased) "
                           "or --adaptive joint",
                           adaptiveRuleName(rule));
    }
    if (rule != ADAPTIVE_NONE) return "";
    const char* option = options.epsilon  ? "--epsilon"
                         : options.minSpp ? "--min-spp"
                         : options.maxSpp ? "--max-spp"
                                          : nullptr;
    if (option == nullptr) return "";
    return fmt::format("{} says nothing without adaptive sampling; add --adaptive {}", option,
                       options.epsilon ? "report" : "crossed");
}

}  // namespace

const char* adaptiveRuleName(uint32_t rule)
{
    return std::data(ADAPTIVE_RULES)[rule];
}

bool isBiased(uint32_t rule)
{
    return rule == ADAPTIVE_REPORT || rule == ADAPTIVE_JOINT;
}

void readAdaptive(const JsonDocument& document, const JsonNode& node, RenderSettings& settings)
{
    JsonObject object(document, node, "\"adaptive\" of the integrator", "adaptive");
    AdaptiveRule& rule = settings.adaptive;
    const std::string name = object.choice("rule", ADAPTIVE_RULES);
    rule.rule = static_cast<uint32_t>(std::ranges::find(ADAPTIVE_RULES, name) - ADAPTIVE_RULES.begin());
    takeDefaultBounds(rule);
    rule.epsilon = static_cast<float>(object.number("epsilon", double{rule.epsilon}, EPSILON));
    rule.targetError = static_cast<float>(object.number("targetError", double{rule.targetError}, TARGET));
    rule.minSamples = object.uint("minSamples", rule.minSamples, 1, MAX_SAMPLES);
    rule.maxSamples = object.uint("maxSamples", rule.maxSamples, 1, MAX_SAMPLES);
    const std::string wrong = wrongBounds(settings, "minSamples", "maxSamples");
    if (!wrong.empty()) throw errorAt(document, node, wrong);
}

void applyAdaptiveOptions(RenderSettings& settings, const SceneOptions& options)
{
    AdaptiveRule& rule = settings.adaptive;
    const uint32_t before = std::exchange(rule.rule, options.adaptive.value_or(rule.rule));
    // Bounds that are meant for other rules are no bounds for those that look at errors, nor theirs for others.
    auto looksAtErrors = [](uint32_t r) { return r == ADAPTIVE_CROSSED || r == ADAPTIVE_JOINT; };
    if (looksAtErrors(rule.rule) != looksAtErrors(before)) takeDefaultBounds(rule);
    rule.epsilon = options.epsilon.value_or(rule.epsilon);
    rule.targetError = options.targetError.value_or(rule.targetError);
    rule.minSamples = options.minSpp.value_or(rule.minSamples);
    rule.maxSamples = options.maxSpp.value_or(rule.maxSamples);
    std::string useless = uselessOption(settings, options);
    if (!useless.empty()) throw usageError("{}", useless);
    if (rule.rule == ADAPTIVE_NONE) return;
    const std::string wrong = wrongBounds(settings, "--min-spp", "--max-spp");
    if (!wrong.empty()) throw usageError("{}", wrong);
}

}  // namespace sahl
