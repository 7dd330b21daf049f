// Statistics of a run as JSON; keys are documented in docs/stats.md.
#pragma once

#include "app/adaptive.h"
#include "device/device.h"
#include "film/film.h"
#include "render/prepare.h"

#include <nlohmann/json.hpp>

namespace sahl {

/// Wall time of each stage [s].
struct StageSeconds {
    double load = 0, build = 0, upload = 0, firstHits = 0, render = 0, write = 0, total = 0;
    double firstSample = 0;  ///< from the start until the first samples were there
};

nlohmann::ordered_json statisticsJson(const PreparedScene& prepared, const Film& film,
                                      Device& device, const StageSeconds& seconds);

/// What the tree looks like: the object "tree" of statistics.
nlohmann::ordered_json treeJson(const BvhStatistics& tree);

nlohmann::ordered_json countersJson(const Counters& counters);

/// Largest resident size of this process so far [bytes].
uint64_t peakMemory();

/// Seconds since an earlier call of the steady clock.
class Stopwatch {
public:
    double lap();  ///< seconds since the last lap or the start
    double total() const;

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    std::chrono::steady_clock::time_point lap_ = start_;
};

}  // namespace sahl
