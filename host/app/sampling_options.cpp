#include "app/sampling_options.h"

#include "app/option_kinds.h"
#include "film/replicates.h"
#include "scene/sampling.h"

namespace sahl {

void addSamplingOptions(CLI::App& command, SceneOptions& scene)
{
    auto setSampler = [&scene](const std::string& text) {
        scene.samplerKind = static_cast<uint32_t>(
            parseChoice("--sampler", text, {SAMPLERS.begin(), SAMPLERS.end()}));
    };
    command
        .add_option_function<std::string>(
            "--sampler", setSampler,
            withDefault(
                "independent, or spread evenly: sobol in blocks of 8 samples,\nsobol64 of 64 (docs/sampling.md)",
                "the scene's, else independent"))
        ->type_name("NAME")
        ->group("Picture");
    auto setRoulette = [&scene](const std::string& text) {
        scene.rouletteDepth = text == "off"
                                  ? NO_ROULETTE
                                  : parseNumber("--roulette-depth", text, {0, MAX_ROULETTE_DEPTH});
    };
    command
        .add_option_function<std::string>(
            "--roulette-depth", setRoulette,
            withDefault(fmt::format("scatterings after which paths that carry little end by\n"
                                    "chance (same mean), 0 to {}, or off",
                                    MAX_ROULETTE_DEPTH),
                        "the scene's, else off"))
        ->type_name("N")
        ->group("Picture");
    auto setClamp = [&scene](const std::string& text) {
        scene.clampIndirect = text == "off"
                                  ? 0.0f
                                  : static_cast<float>(parseReal("--clamp-indirect", text,
                                                                 CLAMP_RANGE.lo, CLAMP_RANGE.hi));
    };
    command
        .add_option_function<std::string>(
            "--clamp-indirect", setClamp,
            withDefault("most luminance that light scattered more than once adds\n"
                        "at a time, or off; biased: too dark",
                        "the scene's, else off"))
        ->type_name("X")
        ->group("Picture");
    auto setLights = [&scene](const std::string& text) {
        scene.lightSampling = static_cast<uint32_t>(
            parseChoice("--light-sampling", text, {LIGHT_SAMPLINGS.begin(), LIGHT_SAMPLINGS.end()}));
    };
    command
        .add_option_function<std::string>(
            "--light-sampling", setLights,
            withDefault("how paths find shapes that shine and the environment: mis\n"
                        "(both ways), lights (shadow rays alone) or bsdf (scattered\n"
                        "rays alone): docs/lights.md",
                        "the scene's, else mis"))
        ->type_name("WAY")
        ->group("Picture");
}

ImageMetadata describeSampling(const RenderSettings& settings)
{
    ImageMetadata entries = {
        {"sahl.sampler", samplerName(settings.samplerKind)},
        {"sahl.varianceOver", varianceOver(replicateSizeOf(settings.samplerKind))},
        {"sahl.lightSampling", lightSamplingName(settings.lightSampling)}};
    const bool roulette = settings.rouletteDepth != NO_ROULETTE, clamp = settings.clampIndirect > 0;
    // Always there, so that files with and without can be told apart.
    entries["sahl.rouletteDepth"] = roulette ? std::to_string(settings.rouletteDepth) : "off";
    entries["sahl.clampIndirect"] = clamp ? fmt::format("{}", settings.clampIndirect) : "off";
    if (clamp && settings.integrator == INTEGRATOR_PATH) entries["sahl.biased"] = "yes";
    return entries;
}

std::string clampSummary(const RenderSettings& settings, const Counters& counters)
{
    if (!(settings.clampIndirect > 0) || settings.integrator != INTEGRATOR_PATH) return "";
    return fmt::format("indirect light clamped to {:g} (biased): {} times, in {} samples",
                       settings.clampIndirect, counters.clamped, counters.cameraRays);
}

}  // namespace sahl
