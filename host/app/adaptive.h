// Adaptive sampling on the command line: its options, and what is said about a picture made with
// it.
#pragma once

#include "film/film_error.h"
#include "image/image.h"
#include "render/render_adaptive.h"
#include "scene/scene.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <string>

namespace sahl {

/// Adds --adaptive, --target-error and the options that go with it, in the group "Picture".
void addAdaptiveOptions(CLI::App& command, SceneOptions& scene);

bool isAdaptive(const RenderSettings& settings);

/// Samples that a pixel gets at most.
uint32_t mostSamples(const RenderSettings& settings);

/// "64 spp", "20 to 1000 spp by the rule report"
std::string samplesText(const RenderSettings& settings);

/// What there is to say about a picture made by a rule.
struct AdaptiveReport {
    AdaptiveRule rule;
    AdaptiveOutcome outcome;
    uint64_t samples = 0;  ///< of all pixels
    FilmError error = {};

    double meanSamples() const;     ///< of a pixel
    double convergedShare() const;  ///< of the pixels: those that the rule stopped, in [0,1]
    double savedShare()
        const;  ///< of the samples that maxSamples in every pixel would be, in [0,1]
};

/// A line for the summary of a run.
std::string adaptiveSummary(const AdaptiveReport& report);

/// Attributes of an EXR file; see docs/exr.md.
ImageMetadata adaptiveMetadata(const AdaptiveReport& report);

/// "adaptive" of the statistics; see docs/stats.md.
nlohmann::ordered_json adaptiveJson(const AdaptiveReport& report);

}  // namespace sahl
