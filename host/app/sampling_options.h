// Options that choose how samples are drawn and weighed, and what files and summaries say of it.
#pragma once

#include "film/film.h"
#include "image/image.h"
#include "scene/scene.h"

#include <CLI/CLI.hpp>

#include <string>

namespace sahl {

/// --sampler, --roulette-depth, --clamp-indirect, --light-sampling, in the group "Picture".
void addSamplingOptions(CLI::App& command, SceneOptions& scene);

/// What the metadata of a picture say about them.
ImageMetadata describeSampling(const RenderSettings& settings);

/// A line about light that was clamped; "" where clamping is off.
std::string clampSummary(const RenderSettings& settings, const Counters& counters);

}  // namespace sahl
