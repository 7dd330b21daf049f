// Things that are timed against each other: in turns, so that what else the machine does meets all alike.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace sahl {

struct Contestant {
    std::string name;
    std::function<double()> run;  ///< does the work once and returns the seconds that count [s]
};

struct Timing {
    std::string name;
    std::vector<double> seconds;  ///< of each round

    double median() const;
    /// (largest - smallest) / median: how far to trust it.
    double spread() const;
};

/// Runs all contestants once a round, in order. Stops early once a signal has arrived.
std::vector<Timing> runRounds(const std::vector<Contestant>& contestants, uint32_t rounds);

/// Median of the ratios, round by round, of what `of` took to what `to` took.
double medianRatio(const Timing& of, const Timing& to);

/// Processes that ran or waited over the last minute, on average.
double loadAverage();

}  // namespace sahl
