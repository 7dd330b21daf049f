// Alias tables hand out exactly what the masses say.
#include "scene/alias_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

namespace sahl {
namespace {

constexpr uint64_t FULL = uint64_t{1} << 32;

/// What a table hands out to each thing, in parts of n 2^32.
std::vector<uint64_t> handedOut(const std::vector<AliasEntry>& entries)
{
    std::vector<uint64_t> parts(entries.size());
    for (size_t i = 0; i < entries.size(); i++) {
        parts[i] += entries[i].threshold;
        parts.at(entries[i].alias) += FULL - entries[i].threshold;
    }
    return parts;
}

void expectExact(const std::vector<double>& weights)
{
    const std::vector<uint64_t> masses = massesOf(weights);
    EXPECT_EQ(std::accumulate(masses.begin(), masses.end(), uint64_t{0}), weights.size() * FULL);
    EXPECT_TRUE(handedOut(makeAliasTable(masses)) == masses);
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    const double total = static_cast<double>(weights.size()) * 0x1p32;
    for (size_t i = 0; i < weights.size(); i++) {
        ASSERT_EQ(masses[i] > 0, weights[i] > 0) << i;
        // Within a rounding at either end, and one at the largest for each of those that got their
        // 1 from it
        ASSERT_NEAR(static_cast<double>(masses[i]), weights[i] / sum * total, 2 + 1e-9 * total)
            << i;
    }
}

TEST(AliasTable, handsOutTheMassesExactly)
{
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (size_t count : {1u, 2u, 3u, 10u, 1000u, 100000u}) {
        std::vector<double> weights(count);
        for (double& weight : weights) weight = uniform(random);
        expectExact(weights);
        for (double& weight : weights) weight = std::pow(10.0, 20 * uniform(random) - 10);
        expectExact(weights);
        for (double& weight : weights) weight = 1;
        expectExact(weights);
    }
}

TEST(AliasTable, neverTakesWhatHasNoWeight)
{
    expectExact({0, 1});
    expectExact({1, 0});
    expectExact({0, 0, 5, 0, 0, 0, 2, 0});
    const std::vector<uint64_t> masses = massesOf(std::vector<double>{0, 3, 0});
    EXPECT_EQ(masses[1], 3 * FULL);
}

TEST(AliasTable, leavesNothingOutThatHasSomeWeight)
{
    // 1e-30 of all is far below the smallest chance that there is, which it gets instead.
    const std::vector<uint64_t> masses = massesOf(std::vector<double>{1e-30, 1, 1e-30});
    EXPECT_EQ(masses[0], 1u);
    EXPECT_EQ(masses[2], 1u);
    EXPECT_EQ(masses[1], 3 * FULL - 2);
}

}  // namespace
}  // namespace sahl
