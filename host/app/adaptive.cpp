#include "app/adaptive.h"

#include "app/option_kinds.h"
#include "scene/adaptive.h"

namespace sahl {

namespace {

double ratio(double part, double whole)
{
    return whole > 0 ? part / whole : 0;
}

/// A float as people wrote it: 0.0001 rather than 9.9999997e-05.
std::string shortest(float number)
{
    return fmt::format("{}", number);
}

}  // namespace

bool isAdaptive(const RenderSettings& settings)
{
    return settings.adaptive.rule != ADAPTIVE_NONE;
}

uint32_t mostSamples(const RenderSettings& settings)
{
    return isAdaptive(settings) ? settings.adaptive.maxSamples : settings.spp;
}

std::string samplesText(const RenderSettings& settings)
{
    if (!isAdaptive(settings)) return fmt::format("{} spp", settings.spp);
    const AdaptiveRule& rule = settings.adaptive;
    return fmt::format("{} to {} spp by the rule {}", rule.minSamples, rule.maxSamples,
                       adaptiveRuleName(rule.rule));
}

void addAdaptiveOptions(CLI::App& command, SceneOptions& scene)
{
    auto setRule = [&scene](const std::string& text) {
        scene.adaptive = static_cast<uint32_t>(parseChoice("--adaptive", text, {ADAPTIVE_RULES.begin(), ADAPTIVE_RULES.end()}));
    };
    static_assert(ADAPTIVE_NONE == 0 && ADAPTIVE_REPORT == 1 && ADAPTIVE_CROSSED == 2 && ADAPTIVE_JOINT == 3);
    command
        .add_option_function<std::string>(
            "--adaptive", setRule,
            withDefault("none, crossed (unbiased), joint (quieter, biased) or\nreport (biased): how pixels "
                        "come to their number of\nsamples (docs/adaptive.md)",
                        "the scene's"))
        ->type_name("NAME")
        ->group("Picture");
    auto setTarget = [&scene](const std::string& text) {
        scene.targetError = static_cast<float>(parseReal("--target-error", text, 1e-6, 1));
    };
    command
        .add_option_function<std::string>(
            "--target-error", setTarget,
            withDefault("of crossed and joint: one standard error of a pixel,\nrelative to its luminance",
                        "the scene's, else 0.05"))
        ->type_name("X")
        ->group("Picture");
    auto setEpsilon = [&scene](const std::string& text) {
        scene.epsilon = static_cast<float>(parseReal("--epsilon", text, 1e-30, 1e30));
    };
    command
        .add_option_function<std::string>(
            "--epsilon", setEpsilon,
            withDefault("of report: movement of the mean", "the scene's, else 1e-4"))
        ->type_name("X")
        ->group("Picture");
    addNumber(command, "--min-spp", scene.minSpp, {1, 1 << 24},
              "adaptive: least samples", "the scene's or rule's")
        ->group("Picture");
    addNumber(command, "--max-spp", scene.maxSpp, {1, 1 << 24},
              "adaptive: most samples", "the scene's or rule's")
        ->group("Picture");
}

double AdaptiveReport::meanSamples() const
{
    return ratio(double(samples), double(outcome.pixels));
}

double AdaptiveReport::convergedShare() const
{
    return ratio(double(outcome.converged), double(outcome.pixels));
}

double AdaptiveReport::savedShare() const
{
    return 1 - ratio(double(samples), double(outcome.pixels) * rule.maxSamples);
}

std::string adaptiveSummary(const AdaptiveReport& report)
{
    const AdaptiveRule& rule = report.rule;
    const std::string what =
        fmt::format("adaptive: rule {} ({}), ", adaptiveRuleName(rule.rule), isBiased(rule.rule) ? "biased" : "unbiased");
    const std::string samples =
        fmt::format("{} to {} samples per pixel: {:.1f} on average, ", rule.minSamples, rule.maxSamples,
                    report.meanSamples());
    const std::string saved = fmt::format("{:.1f} % of the samples saved", 100 * report.savedShare());
    if (rule.rule == ADAPTIVE_REPORT) {
        return fmt::format("{}epsilon {:g}, {}{:.1f} % of the pixels met the criterion, {}", what, rule.epsilon,
                           samples, 100 * report.convergedShare(), saved);
    }
    return fmt::format("{}target error {:g}, {}{:.1f} % of the pixels reached it, {}; error of the frame's "
                       "mean {:.2g} %",
                       what, rule.targetError, samples, 100 * report.error.reachedShare, saved,
                       100 * report.error.ofFrameMean);
}

ImageMetadata adaptiveMetadata(const AdaptiveReport& report)
{
    const AdaptiveRule& rule = report.rule;
    ImageMetadata metadata = {{"sahl.adaptive", adaptiveRuleName(rule.rule)},
                              {"sahl.biased", isBiased(rule.rule) ? "yes" : "no"},
                              {"sahl.minSamples", std::to_string(rule.minSamples)},
                              {"sahl.maxSamples", std::to_string(rule.maxSamples)},
                              {"sahl.meanSamples", fmt::format("{:.6g}", report.meanSamples())},
                              {"sahl.convergedShare", fmt::format("{:.6g}", report.convergedShare())},
                              {"sahl.savedShare", fmt::format("{:.6g}", report.savedShare())},
                              {"sahl.frameError", fmt::format("{:.6g}", report.error.ofFrameMean)}};
    if (rule.rule == ADAPTIVE_REPORT) {
        metadata["sahl.epsilon"] = shortest(rule.epsilon);
    } else {
        metadata["sahl.targetError"] = shortest(rule.targetError);
        metadata["sahl.reachedShare"] = fmt::format("{:.6g}", report.error.reachedShare);
    }
    return metadata;
}

nlohmann::ordered_json adaptiveJson(const AdaptiveReport& report)
{
    const AdaptiveRule& rule = report.rule;
    const bool byEpsilon = rule.rule == ADAPTIVE_REPORT;
    nlohmann::ordered_json json = {{"rule", adaptiveRuleName(rule.rule)}, {"biased", isBiased(rule.rule)}};
    // What says nothing under the rule is null, so that readers find the same keys always.
    json["epsilon"] = nullptr;
    json["targetError"] = nullptr;
    json[byEpsilon ? "epsilon" : "targetError"] =
        std::stod(shortest(byEpsilon ? rule.epsilon : rule.targetError));
    json["minSamples"] = rule.minSamples;
    json["maxSamples"] = rule.maxSamples;
    json["meanSamples"] = report.meanSamples();
    json["convergedPixels"] = report.outcome.converged;
    json["pixelsAtMaximum"] = report.outcome.atMaximum;
    json["convergedShare"] = report.convergedShare();
    json["savedShare"] = report.savedShare();
    json["reachedShare"] = nullptr;
    if (!byEpsilon) json["reachedShare"] = report.error.reachedShare;
    json["frameError"] = report.error.ofFrameMean;
    return json;
}

}  // namespace sahl
