// The sampler `sobol64`: the net, its scrambling and shuffling, and what is left to chance.

#include "unit/sobol_points.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <set>

namespace sahl {
namespace {

using Kernel = reference::Kernel<>;

constexpr uint N64 = 64;

Kernel sobol64Kernel(uint seed = 1)
{
    Kernel kernel = {};
    kernel.frame.seed = seed;
    kernel.frame.samplerKind = SAMPLER_SOBOL64;
    return kernel;
}

using Block = std::array<vec4, N64>;

Block blockOf(Kernel& kernel, uint pixel, uint block, uint dimension)
{
    return samplesOfBlock<N64>(kernel, pixel, block, dimension);
}

/// The digits of the net as numbers.
Block plainNet()
{
    Block points;
    for (uint i = 0; i < N64; i++) {
        const uint digits = Kernel{}.net64(i);
        for (int c = 0; c < 4; c++) points[i][c] = float(digits >> (18 - 6 * c) & 63) / 64;
    }
    return points;
}

/// Every way to cut two axes, or the first three, into 64 equal cells: the 64 points fill all.
void expectStrata(const Block& points)
{
    for (size_t a = 0; a < 4; a++) {
        for (size_t b = a + 1; b < 4; b++) {
            for (int cut = 0; cut <= 6; cut++) {
                std::array<int, 4> cuts = {};
                cuts[a] = cut;
                cuts[b] = 6 - cut;
                ASSERT_EQ(cellsMet(points, cuts), size_t{N64}) << "axes " << a << ", " << b << ", cut " << cut;
            }
        }
    }
    for (int x = 0; x <= 6; x++) {
        for (int y = 0; x + y <= 6; y++)
            ASSERT_EQ(cellsMet(points, {x, y, 6 - x - y, 0}), size_t{N64}) << x << ", " << y;
    }
}

TEST(Sobol64Net, beginsAsSobolsSequenceDoesAndCountsItsPoints)
{
    // By the recursion of the polynomial x + 1: m_k = 2 m_(k-1) ^ m_(k-1), direction numbers m_k / 2^k.
    std::array<uint, 6> y;
    uint m = 1;
    for (uint k = 0; k < 6; k++, m ^= 2 * m) y[k] = m << (5 - k);
    const Block net = plainNet();
    for (uint i = 0; i < N64; i++) {
        uint inX = 0, inY = 0;
        for (uint k = 0; k < 6; k++) {
            if ((i >> k & 1) == 0) continue;
            inX ^= 32u >> k;
            inY ^= y[k];
        }
        EXPECT_EQ(net[i].x * 64, float(inX));
        EXPECT_EQ(net[i].y * 64, float(inY));
        EXPECT_EQ(net[i].z * 64, float(i));
    }
}

TEST(Sobol64Net, hasItsStrata)
{
    expectStrata(plainNet());
}

TEST(Sobol64Net, hasItsStrataInEveryBlockHoweverItIsScrambled)
{
    Kernel kernel = sobol64Kernel();
    std::mt19937 random(6);
    for (int i = 0; i < 200; i++) {
        kernel.frame.seed = uint(random());
        expectStrata(blockOf(kernel, uint(random()), uint(random() % (1u << 18)), uint(random() % 999) * 4));
        if (HasFatalFailure()) return;
    }
}

TEST(Sobol64Scrambling, flipsDigitsByTheDigitsAboveThem)
{
    Kernel kernel = sobol64Kernel();
    std::mt19937 random(7);
    for (int i = 0; i < 200; i++) {
        const uint word = uint(random());
        for (uint a = 0; a < N64; a++) {
            for (uint b = 0; b < N64; b++) {
                for (uint shift = 0; shift < 6; shift++)
                    ASSERT_EQ(a >> shift == b >> shift,
                              kernel.scrambledSix(a, word) >> shift == kernel.scrambledSix(b, word) >> shift);
            }
        }
    }
}

// Each of the 63 places in the tree of digits flips by itself: alone in half of the scramblings, of any two both in a quarter.
TEST(Sobol64Scrambling, flipsEveryPlaceAsOftenAsNotWhateverTheOthersDo)
{
    Kernel kernel = sobol64Kernel();
    std::mt19937 random(8);
    constexpr int N = 1 << 16;
    constexpr size_t PLACES = 63;
    std::vector<int> both(PLACES * PLACES);
    for (int i = 0; i < N; i++) {
        const uint word = uint(random());
        std::vector<size_t> flipped;
        for (size_t depth = 0; depth < 6; depth++) {
            for (uint above = 0; above < 1u << depth; above++) {
                const uint digits = above << (6 - depth);  // the digit at this place is 0 unless it is flipped
                if ((kernel.scrambledSix(digits, word) >> (5 - depth) & 1) != 0) flipped.push_back((1u << depth) - 1 + above);
            }
        }
        for (size_t a : flipped) {
            for (size_t b : flipped) both[a * PLACES + b]++;
        }
    }
    for (size_t a = 0; a < PLACES; a++) {
        for (size_t b = 0; b <= a; b++) {
            const double share = a == b ? 0.5 : 0.25;
            // 2,016 counts: 5 standard errors are exceeded by chance once in 900 runs of this kind
            EXPECT_NEAR(both[a * PLACES + b], N * share, 5 * std::sqrt(N * share * (1 - share))) << a << ", " << b;
        }
    }
}

TEST(Sobol64Shuffle, takesAnyTwoSamplesToAnyTwoPointsAlikeOften)
{
    Kernel kernel = sobol64Kernel();
    for (uint a = 0; a < N64; a++) {
        for (uint b = a % 13; b < N64; b += 13) {
            if (a == b) continue;
            std::set<std::pair<uint, uint>> pairs;
            for (uint factor = 1; factor < N64; factor++) {
                for (uint offset = 0; offset < N64; offset++)
                    pairs.emplace(kernel.shuffled64(a, factor, offset), kernel.shuffled64(b, factor, offset));
            }
            ASSERT_EQ(pairs.size(), 63u * 64u);
        }
    }
}

// Chi-squared with 255 degrees of freedom: below 340 with probability 0.9997.
constexpr double CHI2_255 = 340;

TEST(Sobol64, isUniformAlongPixelsBlocksAndRows)
{
    Kernel kernel = sobol64Kernel();
    constexpr int N = 1 << 17;
    for (int axis = 0; axis < 3; axis++) {
        for (uint inBlock : {0u, 37u}) {
            int counts[4][256] = {}, low[4][256] = {};  // of the upper bits, and the lowest that floats have
            for (uint i = 0; i < N; i++) {
                const uvec4 bits = axis == 0   ? kernel.randomBits4(i, 192 + inBlock, 4)
                                   : axis == 1 ? kernel.randomBits4(12345, N64 * i + inBlock, 4)
                                               : kernel.randomBits4(12345, 192 + inBlock, 4 * i);
                for (int c = 0; c < 4; c++) {
                    counts[c][bits[c] >> 24]++;
                    low[c][bits[c] >> 8 & 255]++;
                }
            }
            for (int c = 0; c < 8; c++) {
                double chi2 = 0;
                for (int count : c < 4 ? counts[c] : low[c - 4]) chi2 += std::pow(count - N / 256.0, 2) / (N / 256.0);
                EXPECT_LT(chi2, CHI2_255) << "axis " << axis << ", sample " << inBlock;
            }
        }
    }
}

// Of the mean of 64 strata, each of variance 1 / (12 64^2); of independent samples 64^2 times that.
constexpr double OF_MEAN = 1.0 / (12.0 * N64 * N64 * N64);

TEST(Sobol64, hasNoCorrelationBetweenPixelsBlocksRowsSeedsAndSamplers)
{
    Kernel kernel = sobol64Kernel();
    Kernel reseeded = sobol64Kernel(2);
    Kernel independent = sobol64Kernel(), small = sobol64Kernel();
    independent.frame.samplerKind = SAMPLER_INDEPENDENT;
    small.frame.samplerKind = SAMPLER_SOBOL;
    constexpr int N = 1 << 14;
    const double limit = 4.5 / (12 * std::sqrt(double(N)));
    const double limitOfMeans = 4.5 * OF_MEAN / std::sqrt(double(N));
    double samples[7] = {}, means[7] = {};
    for (uint i = 0; i < N; i++) {
        const uint block = i % 7;
        const Block here = blockOf(kernel, i, block, 4);
        const Block others[] = {blockOf(kernel, i + 1, block, 4),   blockOf(kernel, i, block + 1, 4),
                                blockOf(kernel, i, block, 8),       blockOf(kernel, i, block + 1, 8),
                                blockOf(reseeded, i, block, 4),     blockOf(independent, i, block, 4),
                                blockOf(small, i, block, 4)};
        for (int k = 0; k < 7; k++) {
            samples[k] += (here[3].x - 0.5) * (others[k][3].x - 0.5);
            means[k] += double(meanOf(here).y) * double(meanOf(others[k]).y);
        }
    }
    for (int k = 0; k < 7; k++) {
        EXPECT_LT(std::abs(samples[k] / N), limit) << k;
        // The mean of independent samples deviates 64 times as much, that of eight blocks of 8 strata 8 times.
        EXPECT_LT(std::abs(means[k] / N), limitOfMeans * (k < 5 ? 1 : k == 5 ? 64 : 8)) << k;
    }
}

TEST(Sobol64, meansOfBlocksHaveTheVarianceOfStrata)
{
    Kernel kernel = sobol64Kernel();
    constexpr int N = 1 << 14;
    glm::dvec4 squares(0);
    for (uint i = 0; i < N; i++) {
        const glm::dvec4 mean(meanOf(blockOf(kernel, 77, i, 12)));
        squares += mean * mean;
    }
    // The variance of a variance of N nearly normal numbers is 2 / N of it, squared.
    for (int c = 0; c < 4; c++) EXPECT_NEAR(squares[c] / N, OF_MEAN, 4.5 * OF_MEAN * std::sqrt(2.0 / N));
}

TEST(Sobol64, rowsGoTogetherLikeRandomPermutations)
{
    // As in text_sobol.cpp: two samples of a row have E[a a'] = c with 64/12 + 64 63 c = 64^2 times the variance of the mean.
    Kernel kernel = sobol64Kernel();
    const double c = (N64 * N64 * OF_MEAN - N64 / 12.0) / (N64 * (N64 - 1));
    const double expected = (N64 / 144.0 + N64 * (N64 - 1) * c * c) / (N64 * N64);
    constexpr int N = 1 << 16;
    double squares[4][4] = {}, fourths[4][4] = {};
    for (uint i = 0; i < N; i++) {
        const Block a = blockOf(kernel, 5, i, 4), b = blockOf(kernel, 5, i, 8);
        for (int p = 0; p < 4; p++) {
            for (int q = 0; q < 4; q++) {
                double mean = 0;
                for (size_t k = 0; k < N64; k++) mean += (a[k][p] - 0.5) * (b[k][q] - 0.5) / N64;
                squares[p][q] += mean * mean / N;
                fourths[p][q] += std::pow(mean, 4) / N;
            }
        }
    }
    for (int p = 0; p < 4; p++) {
        for (int q = 0; q < 4; q++) {
            const double error = std::sqrt((fourths[p][q] - squares[p][q] * squares[p][q]) / N);
            EXPECT_NEAR(squares[p][q], expected, 4.5 * error) << p << " with " << q;
            EXPECT_LT(error, 0.025 * expected);
        }
    }
}

}  // namespace
}  // namespace sahl
