// Options that say how a linear picture becomes an 8-bit one: for every command that writes PNGs.
#pragma once

#include "image/tone_map.h"
#include "util/files.h"

#include <CLI/CLI.hpp>

namespace sahl {

struct ToneOptions {
    ToneMap map;
    bool exposureGiven = false;
    fs::path histogram;  ///< empty: none
};

/// Adds the option that names the operator (`name`: "--tone-map" where there are other things to
/// do),
/// --exposure, --gamma and --histogram.
void addToneOptions(CLI::App& command, const std::string& name, ToneOptions& options);

/// Refuses options that contradict each other (usage).
void checkToneOptions(const ToneOptions& options);

/// "percentile" and so on, as on the command line.
std::string nameOf(ToneOperator op);
std::string nameOfGamma(double gamma);  ///< "srgb", "1", "2.2"

/// Plots of the picture's RGB values and of what the tone map makes of them, as a PNG.
void writeHistogram(const Image& image, const ToneOptions& options, const ImageMetadata& metadata);

}  // namespace sahl
