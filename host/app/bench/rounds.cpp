#include "app/bench/rounds.h"

#include "util/interrupt.h"

#include <algorithm>
#include <cstdlib>

namespace sahl {

namespace {

double medianOf(std::vector<double> values)
{
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    const size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

}  // namespace

double Timing::median() const
{
    return medianOf(seconds);
}

double Timing::spread() const
{
    const double middle = median();
    if (!(middle > 0)) return 0;
    const auto [least, most] = std::minmax_element(seconds.begin(), seconds.end());
    return (*most - *least) / middle;
}

std::vector<Timing> runRounds(const std::vector<Contestant>& contestants, uint32_t rounds)
{
    std::vector<Timing> timings;
    for (const Contestant& contestant : contestants) timings.push_back({contestant.name, {}});
    for (uint32_t round = 0; round < rounds; round++) {
        for (size_t i = 0; i < contestants.size(); i++) {
            if (interruptSignal() != 0) return timings;
            timings[i].seconds.push_back(contestants[i].run());
        }
    }
    return timings;
}

double medianRatio(const Timing& of, const Timing& to)
{
    std::vector<double> ratios;
    for (size_t i = 0; i < std::min(of.seconds.size(), to.seconds.size()); i++)
        if (to.seconds[i] > 0) ratios.push_back(of.seconds[i] / to.seconds[i]);
    return medianOf(ratios);
}

double loadAverage()
{
    double load = 0;
    return getloadavg(&load, 1) == 1 ? load : 0;
}

}  // namespace sahl
