#include "compare/noise.h"

#include "compare/distributions.h"
#include "compare/luminance.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sahl {

namespace {

constexpr double CONFIDENCE = 0.95;  // of the equivalence test, on each side
constexpr double POWER = 0.8;        // chance to find a bias that is called detectable

// Relative to the luminance: what float32 values cannot tell apart.
constexpr double ROUNDING = 1.0 / (1 << 22);

/// Of a pixel in both files.
struct PixelPair {
    bool usable = false;
    double a = 0, b = 0;                  // luminance
    double varianceA = 0, varianceB = 0;  // of it
    double pooled = 0;                    // variance of a - b if both files' samples are alike
};

/// What a file knows of a pixel's noise.
struct PixelNoise {
    double variance = 0;  // of the mean
    double samples = 0;
    double replicates = 0;

    double freedom() const { return std::max(replicates - 1, 0.0); }
    double ofOneSample() const { return variance * samples; }
};

/// Variance of the difference of two means, from the spread of all replicates together.
double pooledVariance(const PixelNoise& a, const PixelNoise& b)
{
    const double freedom = a.freedom() + b.freedom();
    if (!(freedom > 0) || !(a.samples > 0) || !(b.samples > 0)) return 0;
    const double ofOneSample =
        (a.freedom() * a.ofOneSample() + b.freedom() * b.ofOneSample()) / freedom;
    return ofOneSample * (1 / a.samples + 1 / b.samples);
}

PixelPair pairAt(const LoadedPicture& a, const LoadedPicture& b, size_t i)
{
    PixelPair p;
    p.a = luminance(a.image.rgb.data() + 3 * i);
    p.b = luminance(b.image.rgb.data() + 3 * i);
    p.varianceA = a.variance[i];
    p.varianceB = b.variance[i];
    p.usable = std::isfinite(p.a) && std::isfinite(p.b) && std::isfinite(p.varianceA) &&
               std::isfinite(p.varianceB) && p.varianceA >= 0 && p.varianceB >= 0;
    if (p.usable && !a.samples.empty() && !b.samples.empty()) {
        // A single replicate has no spread: its 0 says nothing, and light that it met by chance is no
        // error.
        const PixelNoise ofA = {p.varianceA, a.samples[i], a.replicates(i)};
        const PixelNoise ofB = {p.varianceB, b.samples[i], b.replicates(i)};
        p.usable = ofA.replicates >= 2 && ofB.replicates >= 2;
        p.pooled = pooledVariance(ofA, ofB);
    }
    return p;
}

/// Sums over pixels, from which a test of their mean follows.
struct Sums {
    double pixels = 0, a = 0, b = 0, absolute = 0;
    double variance = 0;  // of the sum of a - b
    double pooled = 0;
    double squares = 0;  // of the single variances

    void add(const PixelPair& p)
    {
        pixels += 1;
        a += p.a;
        b += p.b;
        absolute += 0.5 * (std::fabs(p.a) + std::fabs(p.b));
        variance += p.varianceA + p.varianceB;
        pooled += p.pooled;
        squares += p.varianceA * p.varianceA + p.varianceB * p.varianceB;
    }
    void add(const Sums& other)
    {
        pixels += other.pixels;
        a += other.a;
        b += other.b;
        absolute += other.absolute;
        variance += other.variance;
        pooled += other.pooled;
        squares += other.squares;
    }
};

/// Standard error and degrees of freedom (docs/compare.md, "How sure").
///
/// Variance: the larger one of two estimates. The sum of both files' own is right for any two
/// pictures, but small where one file has few samples and none of them met rare light; the pooled
/// one knows such light from the other file.
///
/// Degrees of freedom: a sum V of independent estimates v has 2 V^2 / sum of Var(v) (Satterthwaite
/// 1946). How much a variance itself varies depends on the fourth moment of the samples, which is
/// unknown and large for rare bright light; but Var(v) <= E[v^2] always.
MeanTest testOf(const Sums& sums, double toleratedOfMean)
{
    if (!(sums.variance > 0) || !(sums.pixels > 0)) return {};
    const double rounding = ROUNDING * sums.absolute;
    const double variance = std::max(sums.variance, sums.pooled) + rounding * rounding;
    const double freedom = 2 * sums.variance * sums.variance / sums.squares;
    return testMean((sums.a - sums.b) / sums.pixels, std::sqrt(variance) / sums.pixels, freedom,
                    toleratedOfMean);
}

/// Level of each of `tests` tests that leaves `level` for all of them. Sidak 1967: it holds for
/// normal variables however they depend on each other.
double sidak(double level, double tests)
{
    return -std::expm1(std::log1p(-level) / tests);
}

void addPixel(const PixelPair& p, size_t i, Statistics& s, double& noEvidenceLargest,
              double& noEvidenceSum)
{
    if (!p.usable) {
        s.excludedPixels++;
        return;
    }
    const double variance = p.varianceA + p.varianceB;
    if (variance > 0) {
        s.z[i] = static_cast<float>((p.a - p.b) / std::sqrt(variance));
        return;
    }
    s.noEvidencePixels++;
    const double distance = std::fabs(p.a - p.b);
    if (!(distance > ROUNDING * std::max(std::fabs(p.a), std::fabs(p.b)))) return;
    s.noEvidenceDiffering++;
    noEvidenceLargest = std::max(noEvidenceLargest, distance);
    noEvidenceSum += distance;
}

/// Detectable where a test at this level finds it with probability POWER.
double detectable(const MeanTest& test, double level, double tolerated)
{
    return tolerated + (studentCritical(level, test.degreesOfFreedom) + normalQuantile(POWER)) *
                           test.standardError;
}

void judgeBlocks(const std::vector<Sums>& sums, double mean, const CompareOptions& options,
                 Statistics& s)
{
    for (size_t i = 0; i < sums.size(); i++) {
        if (sums[i].pixels > 0 && sums[i].variance > 0) s.testedBlocks++;
        s.blocks[i].tested = sums[i].pixels > 0 && sums[i].variance > 0;
    }
    s.blockLevel = sidak(sidak(options.level, 2), std::max(1.0, double(s.testedBlocks)));
    std::vector<const MeanTest*> tested;
    for (size_t i = 0; i < sums.size(); i++) {
        BlockTest& block = s.blocks[i];
        if (!block.tested) continue;
        const double own = 0.5 * (sums[i].a + sums[i].b) / sums[i].pixels;
        block.mean = testOf(sums[i], options.tolerated * std::max(std::fabs(own), mean));
        block.differs = block.mean.p < s.blockLevel;
        if (block.differs) s.differingBlocks++;
        tested.push_back(&block.mean);
    }
    if (tested.empty()) return;
    const auto middle = tested.begin() + static_cast<std::ptrdiff_t>(tested.size() / 2);
    std::nth_element(
        tested.begin(), middle, tested.end(),
        [](const MeanTest* x, const MeanTest* y) { return x->standardError < y->standardError; });
    s.detectableBlock = detectable(**middle, s.blockLevel, options.tolerated * mean) / mean;
}

void judgeFrame(const Sums& frame, double mean, const CompareOptions& options, Statistics& s)
{
    s.frameLevel = sidak(options.level, 2);
    s.frame = testOf(frame, options.tolerated * mean);
    if (!(s.frame.standardError > 0)) return;
    s.frameDiffers = s.frame.p < s.frameLevel;
    const double oneSided = studentCritical(2 * (1 - CONFIDENCE), s.frame.degreesOfFreedom);
    s.confidenceBound = (std::fabs(s.frame.difference) + oneSided * s.frame.standardError) / mean;
    s.equivalent = s.confidenceBound < options.margin;
    s.detectableBias = detectable(s.frame, s.frameLevel, options.tolerated * mean) / mean;
    // As many as would make a bias of the margin detectable: then either answer can be given.
    const double needed =
        (normalQuantile(1 - s.frameLevel / 2) + normalQuantile(POWER)) * s.frame.standardError;
    s.moreSamples = std::max(2.0, std::pow(needed / (options.margin * mean), 2));
}

}  // namespace

MeanTest testMean(double difference, double standardError, double degreesOfFreedom,
                  double tolerated)
{
    MeanTest test = {difference, standardError, degreesOfFreedom, 0, 1};
    const double beyond = std::max(0.0, std::fabs(difference) - tolerated);
    test.z = std::copysign(beyond / standardError, difference);
    test.p = studentTwoSided(test.z, degreesOfFreedom);
    return test;
}

Statistics testDifferences(const LoadedPicture& a, const LoadedPicture& b,
                           const CompareOptions& options)
{
    const uint32_t width = a.image.width, height = a.image.height;
    assert(a.variance.size() == size_t{width} * height && b.variance.size() == a.variance.size());
    Statistics s;
    s.z.assign(a.variance.size(), std::numeric_limits<float>::quiet_NaN());
    std::vector<Sums> sums;
    Sums frame;
    double noEvidenceLargest = 0, noEvidenceSum = 0;
    for (uint32_t top = 0; top < height; top += COMPARE_BLOCK) {
        for (uint32_t left = 0; left < width; left += COMPARE_BLOCK) {
            BlockTest block;
            block.x = left;
            block.y = top;
            block.width = std::min(COMPARE_BLOCK, width - left);
            block.height = std::min(COMPARE_BLOCK, height - top);
            Sums sum;
            for (uint32_t y = top; y < top + block.height; y++) {
                for (uint32_t x = left; x < left + block.width; x++) {
                    const size_t i = size_t{y} * width + x;
                    const PixelPair pair = pairAt(a, b, i);
                    addPixel(pair, i, s, noEvidenceLargest, noEvidenceSum);
                    if (pair.usable) sum.add(pair);
                }
            }
            frame.add(sum);
            sums.push_back(sum);
            s.blocks.push_back(block);
        }
    }
    if (!(frame.pixels > 0)) return s;
    s.meanA = frame.a / frame.pixels;
    s.meanB = frame.b / frame.pixels;
    const double mean = std::fabs(0.5 * (s.meanA + s.meanB));
    if (!(mean > 0)) return s;
    s.noEvidenceLargest = noEvidenceLargest / mean;
    s.noEvidenceShare = noEvidenceSum / (mean * frame.pixels);
    judgeFrame(frame, mean, options, s);
    judgeBlocks(sums, mean, options, s);
    return s;
}

PairedDifferences pairDifferences(const LoadedPicture& a, const LoadedPicture& b)
{
    const uint32_t width = a.image.width, height = a.image.height;
    PairedDifferences paired;
    double sum = 0, squares = 0, luminances = 0, blocks = 0;
    for (uint32_t top = 0; top < height; top += COMPARE_BLOCK) {
        for (uint32_t left = 0; left < width; left += COMPARE_BLOCK) {
            double difference = 0, both = 0, pixels = 0;
            for (uint32_t y = top; y < std::min(height, top + COMPARE_BLOCK); y++) {
                for (uint32_t x = left; x < std::min(width, left + COMPARE_BLOCK); x++) {
                    const size_t i = 3 * (size_t{y} * width + x);
                    const double ya = luminance(a.image.rgb.data() + i);
                    const double yb = luminance(b.image.rgb.data() + i);
                    if (!std::isfinite(ya) || !std::isfinite(yb)) continue;
                    difference += ya - yb;
                    both += 0.5 * (ya + yb);
                    pixels += 1;
                }
            }
            if (!(pixels > 0)) continue;
            difference /= pixels;
            sum += difference;
            squares += difference * difference;
            luminances += both / pixels;
            blocks += 1;
            paired.largest = std::max(paired.largest, std::fabs(difference));
        }
    }
    if (!(blocks > 0) || !(std::fabs(luminances) > 0)) return paired;
    const double mean = std::fabs(luminances / blocks);
    const double average = sum / blocks;
    paired.mean = average / mean;
    if (blocks > 1) {
        paired.spread =
            std::sqrt(std::max(0.0, squares / blocks - average * average) / (blocks - 1)) / mean;
    }
    paired.largest /= mean;
    return paired;
}

}  // namespace sahl
