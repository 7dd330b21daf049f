// The sampler `sobol`: the net, its scrambling and shuffling, and what is left to chance.

#include "unit/sobol_points.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>

namespace sahl {
namespace {

using Kernel = reference::Kernel<>;

Kernel sobolKernel(uint seed = 1)
{
    Kernel kernel = {};
    kernel.frame.seed = seed;
    kernel.frame.samplerKind = SAMPLER_SOBOL;
    return kernel;
}

using Block = std::array<vec4, BLOCK_SIZE>;

Block blockOf(Kernel& kernel, uint pixel, uint block, uint dimension)
{
    return samplesOfBlock<BLOCK_SIZE>(kernel, pixel, block, dimension);
}

/// The digits of the net as numbers.
Block plainNet()
{
    Block points;
    for (uint i = 0; i < BLOCK_SIZE; i++) {
        const uint nets[4] = {Kernel::NET_X, Kernel::NET_Y, Kernel::NET_Z, Kernel::NET_W};
        for (int c = 0; c < 4; c++) points[i][c] = float(nets[c] >> (3 * i) & 7) / 8;
    }
    return points;
}

/// Coordinate of point `index` of Sobol's sequence in its first or second dimension, times 8, by
/// direction numbers m / 2^k: 1/2, 1/4, 1/8; and 1/2, 3/4, 5/8 of the polynomial x + 1.
uint sobolEighths(uint index, int dimension)
{
    const uint directions[2][3] = {{4, 2, 1}, {4, 6, 5}};
    uint x = 0;
    for (uint bit = 0; bit < 3; bit++) x ^= (index >> bit & 1) * directions[dimension][bit];
    return x;
}

TEST(SobolNet, beginsAsSobolsSequenceDoes)
{
    const float x[] = {0, .5f, .25f, .75f, .125f, .625f, .375f, .875f};
    const float y[] = {0, .5f, .75f, .25f, .625f, .125f, .375f, .875f};
    const Block net = plainNet();
    for (uint i = 0; i < BLOCK_SIZE; i++) {
        EXPECT_EQ(net[i].x, x[i]);
        EXPECT_EQ(net[i].y, y[i]);
        EXPECT_EQ(net[i].x, float(sobolEighths(i, 0)) / 8);
        EXPECT_EQ(net[i].y, float(sobolEighths(i, 1)) / 8);
        EXPECT_EQ(net[i].z, float(i) / 8);
    }
}

/// Every way to cut the axes into 8 equal cells of which the 8 points must fill all.
void expectStrata(const Block& points)
{
    constexpr int X = 0, Y = 1, Z = 2, W = 3;
    for (int c : {X, Y, Z, W}) {
        std::array<int, 4> cuts = {};
        cuts[size_t(c)] = 3;
        EXPECT_EQ(cellsMet(points, cuts), 8u) << "axis " << c;
    }
    for (int a : {X, Y, Z, W}) {
        for (int b : {X, Y, Z, W}) {
            if (a == b) continue;
            std::array<int, 4> cuts = {};
            cuts[size_t(a)] = 1;
            cuts[size_t(b)] = 1;
            EXPECT_EQ(cellsMet(points, cuts), 4u) << "halves of axes " << a << " and " << b;
            cuts[size_t(b)] = 2;
            const bool lacking = a == W && b == Y;
            EXPECT_EQ(cellsMet(points, cuts), lacking ? 4u : 8u)
                << "halves of axis " << a << " and quarters of " << b;
        }
    }
    EXPECT_EQ(cellsMet(points, {1, 1, 1, 0}), 8u);
    EXPECT_EQ(cellsMet(points, {1, 1, 0, 1}), 8u);
    EXPECT_EQ(cellsMet(points, {0, 1, 1, 1}), 8u);
}

TEST(SobolNet, hasItsStrata)
{
    expectStrata(plainNet());
}

TEST(SobolNet, hasItsStrataInEveryBlockHoweverItIsScrambled)
{
    Kernel kernel = sobolKernel();
    std::mt19937 random(5);
    for (int i = 0; i < 500; i++) {
        kernel.frame.seed = uint(random());
        expectStrata(
            blockOf(kernel, uint(random()), uint(random() % (1u << 21)), uint(random() % 999) * 4));
    }
}

TEST(SobolNet, noFourDimensionsCouldBeNetsInAllPairs)
{
    // A dimension of a digital net: the first digit is one of 7 sums of the index's digits, the
    // first two digits fix a line of 3 such sums. Quarters of one and halves of another are 8 cells
    // with a point each just where the other's first digit is not on the one's line.
    struct Dimension {
        uint first;
        std::set<uint> line;
    };
    std::vector<Dimension> all;
    for (uint first = 1; first < 8; first++) {
        for (uint second = 1; second < 8; second++) {
            if (second == first || second > (first ^ second)) continue;
            all.push_back({first, {first, second, first ^ second}});
        }
    }
    EXPECT_EQ(all.size(), 21u);
    auto agree = [](const Dimension& a, const Dimension& b) {
        return !a.line.contains(b.first) && !b.line.contains(a.first);
    };
    size_t triples = 0, quadruples = 0;
    for (const Dimension& a : all) {
        for (const Dimension& b : all) {
            for (const Dimension& c : all) {
                if (!agree(a, b) || !agree(a, c) || !agree(b, c)) continue;
                triples++;
                for (const Dimension& d : all)
                    quadruples += agree(a, d) && agree(b, d) && agree(c, d);
            }
        }
    }
    EXPECT_GT(triples, 0u);
    EXPECT_EQ(quadruples, 0u);
}

TEST(SobolScrambling, flipsDigitsByTheDigitsAboveThem)
{
    Kernel kernel = sobolKernel();
    std::set<std::array<uint, 8>> permutations;
    for (uint flips = 0; flips < 128; flips++) {
        std::array<uint, 8> to;  // in the order of the digits
        for (uint digits = 0; digits < 8; digits++)
            to[digits] = kernel.scrambledDigits(Kernel::NET_Z, digits, flips);
        permutations.insert(to);
        for (uint a = 0; a < 8; a++) {
            for (uint b = 0; b < 8; b++) {
                for (uint shift : {0u, 1u, 2u})
                    EXPECT_EQ(a >> shift == b >> shift, to[a] >> shift == to[b] >> shift);
            }
        }
    }
    EXPECT_EQ(permutations.size(), 128u) << "all there are";
}

/// Along each dimension the 8 samples of a block are 8 strata in some order. There are 56 shuffles
/// and 128 scramblings; the 8 that flip digits alike everywhere are both, so the orders are 56 times
/// 16.
TEST(SobolScrambling, andShufflingGiveEveryDimensionAllOrdersAlikeOften)
{
    Kernel kernel = sobolKernel();
    constexpr int N = 1 << 16, ORDERS = 56 * 128 / 8;
    std::array<std::map<uint, int>, 4> counts;
    for (uint i = 0; i < N; i++) {
        std::array<uint, 4> orders = {};
        for (const vec4& point : blockOf(kernel, 9, i, 4)) {
            for (int c = 0; c < 4; c++)
                orders[size_t(c)] = orders[size_t(c)] << 3 | uint(point[c] * 8);
        }
        for (size_t c = 0; c < 4; c++) counts[c][orders[c]]++;
    }
    for (const auto& ofDimension : counts) {
        EXPECT_EQ(ofDimension.size(), size_t{ORDERS});
        double chi2 = 0;
        for (const auto& [order, count] : ofDimension)
            chi2 += std::pow(count - double(N) / ORDERS, 2) / (double(N) / ORDERS);
        EXPECT_NEAR(chi2, ORDERS - 1, 4.5 * std::sqrt(2.0 * (ORDERS - 1)));
    }
}

TEST(SobolShuffle, takesAnyTwoSamplesToAnyTwoPointsAlikeOften)
{
    Kernel kernel = sobolKernel();
    for (uint a = 0; a < 8; a++) {
        for (uint b = 0; b < 8; b++) {
            if (a == b) continue;
            std::set<std::pair<uint, uint>> pairs;
            for (uint factor = 1; factor < 8; factor++) {
                for (uint offset = 0; offset < 8; offset++) {
                    pairs.emplace(kernel.shuffled8(a, factor, offset),
                                  kernel.shuffled8(b, factor, offset));
                }
            }
            EXPECT_EQ(pairs.size(), 56u);
        }
    }
}

// Chi-squared with 255 degrees of freedom: below 340 with probability 0.9997.
constexpr double CHI2_255 = 340;

TEST(Sobol, isUniformAlongPixelsBlocksAndRows)
{
    Kernel kernel = sobolKernel();
    constexpr int N = 1 << 17;
    for (int axis = 0; axis < 3; axis++) {
        for (uint inBlock : {0u, 5u}) {
            int counts[4][256] = {},
                low[4][256] = {};  // of the upper bits, and the lowest that floats have
            for (uint i = 0; i < N; i++) {
                const uvec4 bits = axis == 0   ? kernel.randomBits4(i, 24 + inBlock, 4)
                                   : axis == 1 ? kernel.randomBits4(12345, 8 * i + inBlock, 4)
                                               : kernel.randomBits4(12345, 24 + inBlock, 4 * i);
                for (int c = 0; c < 4; c++) {
                    counts[c][bits[c] >> 24]++;
                    low[c][bits[c] >> 8 & 255]++;
                }
            }
            for (int c = 0; c < 8; c++) {
                double chi2 = 0;
                for (int count : c < 4 ? counts[c] : low[c - 4])
                    chi2 += std::pow(count - N / 256.0, 2) / (N / 256.0);
                EXPECT_LT(chi2, CHI2_255) << "axis " << axis << ", sample " << inBlock;
            }
        }
    }
}

TEST(Sobol, hasNoCorrelationBetweenPixelsBlocksRowsSeedsAndSamplers)
{
    Kernel kernel = sobolKernel();
    Kernel reseeded = sobolKernel(2);
    Kernel independent = sobolKernel();
    independent.frame.samplerKind = SAMPLER_INDEPENDENT;
    constexpr int N = 1 << 16;
    // Samples of other blocks: variance 1/12. Means of blocks: of 8 strata, each of variance 1 /
    // (12 64).
    const double ofMean = 1.0 / (12 * 64 * 8);
    const double limit = 4.5 / (12 * std::sqrt(double(N)));
    const double limitOfMeans = 4.5 * ofMean / std::sqrt(double(N));
    double samples[6] = {}, means[6] = {};
    for (uint i = 0; i < N; i++) {
        const uint block = i % 7;
        const Block here = blockOf(kernel, i, block, 4);
        const Block others[] = {
            blockOf(kernel, i + 1, block, 4), blockOf(kernel, i, block + 1, 4),
            blockOf(kernel, i, block, 8),     blockOf(kernel, i, block + 1, 8),
            blockOf(reseeded, i, block, 4),   blockOf(independent, i, block, 4)};
        for (int k = 0; k < 6; k++) {
            samples[k] += (here[3].x - 0.5) * (others[k][3].x - 0.5);
            means[k] += double(meanOf(here).y) * double(meanOf(others[k]).y);
        }
    }
    for (int k = 0; k < 6; k++) {
        EXPECT_LT(std::abs(samples[k] / N), limit) << k;
        // The mean of independent samples varies 8 times as much.
        EXPECT_LT(std::abs(means[k] / N), k < 5 ? limitOfMeans : 8 * limitOfMeans) << k;
    }
}

TEST(Sobol, meansOfBlocksHaveTheVarianceOfStrata)
{
    Kernel kernel = sobolKernel();
    constexpr int N = 1 << 16;
    vec4 squares(0);
    for (uint i = 0; i < N; i++) {
        const vec4 mean = meanOf(blockOf(kernel, 77, i, 12));
        squares += mean * mean;
    }
    const double expected = 1.0 / (12 * 64 * 8);  // of independent samples 64 times that
    // The variance of a variance of N nearly normal numbers is 2 / N of it, squared.
    for (int c = 0; c < 4; c++)
        EXPECT_NEAR(squares[c] / N, expected, 4.5 * expected * std::sqrt(2.0 / N));
}

TEST(Sobol, rowsGoTogetherLikeRandomPermutations)
{
    // The mean over a block of a b, a = u - 1/2 and b = v - 1/2 of two rows. Two samples of a row
    // have E[a a'] = c with 8/12 + 56 c = 64 times the variance of the mean; so 8/144 + 56 c^2 = 64
    // times that of the mean of products. Pairs that stay together in both rows would show in c^2.
    Kernel kernel = sobolKernel();
    const double c = (64.0 / (12 * 64 * 8) - 8.0 / 12) / 56;
    const double expected = (8.0 / 144 + 56 * c * c) / 64;
    constexpr int N = 1 << 16;
    double squares[4][4] = {}, fourths[4][4] = {};
    for (uint i = 0; i < N; i++) {
        const Block a = blockOf(kernel, 5, i, 4), b = blockOf(kernel, 5, i, 8);
        for (int p = 0; p < 4; p++) {
            for (int q = 0; q < 4; q++) {
                double mean = 0;
                for (size_t k = 0; k < 8; k++) mean += (a[k][p] - 0.5) * (b[k][q] - 0.5) / 8;
                squares[p][q] += mean * mean / N;
                fourths[p][q] += std::pow(mean, 4) / N;
            }
        }
    }
    for (int p = 0; p < 4; p++) {
        for (int q = 0; q < 4; q++) {
            const double error = std::sqrt((fourths[p][q] - squares[p][q] * squares[p][q]) / N);
            EXPECT_NEAR(squares[p][q], expected, 4.5 * error) << p << " with " << q;
            EXPECT_LT(error, 0.01 * expected);
        }
    }
}

}  // namespace
}  // namespace sahl
