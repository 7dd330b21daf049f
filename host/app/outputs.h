// The pictures that a command writes.
#pragma once

#include "film/film.h"
#include "util/files.h"

#include <string>
#include <vector>

namespace sahl {

struct OutputOptions {
    std::vector<fs::path> paths;  ///< .exr, .pfm (linear) or .png (tone mapped)
    ToneMap toneMap = ToneMap::percentile;
    float exposure = 0;  ///< [stops]
};

/// Refuses what cannot work, before anything is rendered: unknown extensions and outputs that are one
/// of the inputs (usage), unwritable ones (cannotWrite).
void checkOutputs(const std::vector<fs::path>& outputs, const std::vector<fs::path>& inputs);

/// Writes a picture, in the format that the extension names.
void writeImage(const Image& image, const OutputOptions& options, const fs::path& path,
                const ImageMetadata& metadata);

/// Writes the film's mean picture to every path, each file complete or not at all. When one fails the
/// others are still written; then the first failure is thrown.
void writeOutputs(const Film& film, const OutputOptions& options, const ImageMetadata& metadata);

}  // namespace sahl
