// Pearson's chi-squared test: do counts come from the probabilities that they should come from?
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

namespace sahl::testing {

/// Probability that chi-squared with `degrees` of freedom exceeds x: the upper incomplete gamma
/// function by its series or, beyond its bulk, by its continued fraction (Abramowitz and Stegun 6.5.29
/// and 6.5.31).
inline double chiSquaredTail(double x, double degrees)
{
    const double a = degrees / 2, half = x / 2;
    if (!(half > 0)) return 1;
    const double scale = std::exp(a * std::log(half) - half - std::lgamma(a));
    if (half < a + 1) {
        double term = 1 / a, sum = term;
        for (int n = 1; term > 1e-16 * sum; n++) {
            term *= half / (a + n);
            sum += term;
        }
        return std::max(0.0, 1 - scale * sum);
    }
    // From the tail of the fraction upwards: 1/(x+) (1-a)/(1+) 1/(x+) (2-a)/(1+) 2/(x+) ...
    double fraction = 0;
    for (int n = 2000; n > 0; n--) fraction = (n - a) / (1 + n / (half + fraction));
    return scale / (half + fraction);
}

struct ChiSquared {
    double value = 0;  ///< sum of (found - expected)^2 / expected
    int degrees = 0;   ///< of freedom: cells less one
    double p = 1;      ///< probability of such a value or a larger one
};

/// Cells in which fewer than 5 are expected are taken together until they have as many. `expected`
/// and `found` have the same sum.
inline ChiSquared chiSquaredTest(std::span<const double> expected, std::span<const double> found)
{
    constexpr double FEWEST = 5;
    std::vector<size_t> order(expected.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::sort(order.begin(), order.end(),
              [&](size_t a, size_t b) { return expected[a] < expected[b]; });
    ChiSquared test;
    double pooledExpected = 0, pooledFound = 0;
    int cells = 0;
    for (size_t i : order) {
        pooledExpected += expected[i];
        pooledFound += found[i];
        if (pooledExpected < FEWEST) continue;
        const double difference = pooledFound - pooledExpected;
        test.value += difference * difference / pooledExpected;
        pooledExpected = pooledFound = 0;
        cells++;
    }
    test.degrees = cells - 1;
    test.p = cells > 1 ? chiSquaredTail(test.value, test.degrees) : 1;
    return test;
}

/// Level of each of m independent tests that gives all of them together the level `family`: 1 - (1 -
/// family)^(1/m), after Sidak 1967.
inline double sidakLevel(double family, size_t tests)
{
    return -std::expm1(std::log1p(-family) / static_cast<double>(tests));
}

}  // namespace sahl::testing
