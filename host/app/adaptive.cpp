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
        scene.adaptive = static_cast<uint32_t>(parseChoice("--adaptive", text, {"none", "report"}));
    };
    static_assert(ADAPTIVE_NONE == 0 && ADAPTIVE_REPORT == 1);
    command
        .add_option_function<std::string>(
            "--adaptive", setRule,
            withDefault(
                "none or report: stop at a pixel when a sample hardly moves\nits mean; biased "
                "(docs/adaptive.md)",
                "the scene's"))
        ->type_name("NAME")
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
              "adaptive: least samples", "the scene's, else 20")
        ->group("Picture");
    addNumber(command, "--max-spp", scene.maxSpp, {1, 1 << 24},
              "adaptive: most samples", "the scene's, else 1000")
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
    return fmt::format(
        "adaptive: rule {} (biased), epsilon {:g}, {} to {} samples per pixel: {:.1f} on average, "
        "{:.1f} % of the pixels met the criterion, {:.1f} % of the samples saved",
        adaptiveRuleName(rule.rule), rule.epsilon, rule.minSamples, rule.maxSamples,
        report.meanSamples(), 100 * report.convergedShare(), 100 * report.savedShare());
}

ImageMetadata adaptiveMetadata(const AdaptiveReport& report)
{
    const AdaptiveRule& rule = report.rule;
    return {{"sahl.adaptive", adaptiveRuleName(rule.rule)},
            {"sahl.biased", "yes"},
            {"sahl.epsilon", shortest(rule.epsilon)},
            {"sahl.minSamples", std::to_string(rule.minSamples)},
            {"sahl.maxSamples", std::to_string(rule.maxSamples)},
            {"sahl.meanSamples", fmt::format("{:.6g}", report.meanSamples())},
            {"sahl.convergedShare", fmt::format("{:.6g}", report.convergedShare())},
            {"sahl.savedShare", fmt::format("{:.6g}", report.savedShare())}};
}

nlohmann::ordered_json adaptiveJson(const AdaptiveReport& report)
{
    const AdaptiveRule& rule = report.rule;
    return {{"rule", adaptiveRuleName(rule.rule)},
            {"biased", true},
            {"epsilon", std::stod(shortest(rule.epsilon))},
            {"minSamples", rule.minSamples},
            {"maxSamples", rule.maxSamples},
            {"meanSamples", report.meanSamples()},
            {"convergedPixels", report.outcome.converged},
            {"pixelsAtMaximum", report.outcome.atMaximum},
            {"convergedShare", report.convergedShare()},
            {"savedShare", report.savedShare()}};
}

}  // namespace sahl
