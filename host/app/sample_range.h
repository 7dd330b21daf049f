// --sample-range, --shard and --keep-film: rendering some of a picture's samples, to be merged
// later.
#pragma once

#include "app/job_array.h"
#include "film/film_file.h"
#include "scene/scene.h"

#include <CLI/CLI.hpp>

namespace sahl {

struct RangeOptions {
    std::optional<SampleRange> range;
    std::optional<ArrayTask> shard;
    bool keepFilm = false;

    bool isPart() const { return range || shard; }
    bool wantsFilm() const { return isPart() || keepFilm; }
};

/// Adds the options, in the group "Parts".
void addRangeOptions(CLI::App& command, RangeOptions& options);

/// Refuses options that contradict each other, and outputs of which none can hold the film (usage).
void checkRangeOptions(const RangeOptions& options, const std::vector<fs::path>& outputs);

/// What the options name, of a picture with these settings: all of its samples without them. Throws
/// usage where that is not possible, with what is.
SampleRange rangeOf(const RangeOptions& options, const RenderSettings& settings);

/// "3/8"
std::string shardText(const ArrayTask& shard);

/// "-shard-3-of-8", "-samples-64-128" or "", for the name of a file.
std::string partSuffix(const RangeOptions& options);

}  // namespace sahl
