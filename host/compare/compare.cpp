// Puts metrics and tests together, and says what follows from them.
#include "compare/compare.h"

#include "compare/correlation.h"
#include "compare/metrics.h"
#include "compare/noise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sahl {

namespace {

constexpr double SAME_VALUES = 1e-6;

std::string percent(double share)
{
    return fmt::format("{:.3g} %", 100 * share);
}

/// Whether no finite values differ by more than 1e-6 of the larger one, or of the mean of all.
bool haveSameValues(const Image& a, const Image& b)
{
    double sum = 0, count = 0;
    for (size_t i = 0; i < a.rgb.size(); i++) {
        if (!std::isfinite(a.rgb[i]) || !std::isfinite(b.rgb[i])) continue;
        sum += 0.5 * (std::fabs(double(a.rgb[i])) + std::fabs(double(b.rgb[i])));
        count += 1;
    }
    const double mean = count > 0 ? sum / count : 0;
    for (size_t i = 0; i < a.rgb.size(); i++) {
        const double x = a.rgb[i], y = b.rgb[i];
        if (!std::isfinite(x) || !std::isfinite(y)) continue;
        const double scale = std::max({mean, std::fabs(x), std::fabs(y)});
        if (std::fabs(x - y) > SAME_VALUES * scale) return false;
    }
    return true;
}

std::vector<float> signedErrorOf(const Image& a, const Image& b)
{
    std::vector<float> error(a.rgb.size());
    for (size_t i = 0; i < error.size(); i++) error[i] = a.rgb[i] - b.rgb[i];
    return error;
}

/// Which of the two cannot be judged, for a sentence.
std::string withoutVariance(const LoadedPicture& a, const LoadedPicture& b)
{
    if (a.variance.empty() && b.variance.empty()) return "neither file has";
    return (a.variance.empty() ? a.name : b.name) + " has not";
}

struct Judgement {
    Verdict verdict;
    std::string reason;
};

Judgement judgeStatistics(const Statistics& s, const CompareOptions& options)
{
    if (s.frameDiffers || s.differingBlocks > 0) {
        std::string what;
        if (s.frameDiffers) {
            const double mean = 0.5 * (s.meanA + s.meanB);
            what =
                fmt::format("the mean luminances differ by {}", percent(s.frame.difference / mean));
        }
        if (s.differingBlocks > 0) {
            what += fmt::format("{}{} of {} blocks differ", what.empty() ? "" : ", and ",
                                s.differingBlocks, s.testedBlocks);
        }
        return {Verdict::differ, fmt::format("{}, more than noise{} explains (level {})", what,
                                             options.tolerated > 0 ? " and the tolerance" : "",
                                             percent(options.level))};
    }
    if (s.excludedPixels == s.z.size()) {
        return {Verdict::undecided,
                "no pixel has a usable variance in both files, which takes at least 2 "
                "samples a pixel, more than 8 by the sampler sobol, more than 64 by sobol64"};
    }
    if (!(s.frame.standardError > 0)) {
        return {Verdict::undecided,
                "no pixel of either file has any spread between its samples, so "
                "noise cannot be told from error"};
    }
    if (s.equivalent && !(s.noEvidenceShare > options.margin)) {
        return {
            Verdict::equivalent,
            fmt::format("no difference found, and the means agree within {} of the mean luminance "
                        "(95 % sure)",
                        percent(s.confidenceBound))};
    }
    if (s.equivalent) {
        return {
            Verdict::undecided,
            fmt::format("the means agree, but {} pixels differ that have no spread in either file, "
                        "by {} of all light",
                        s.noEvidenceDiffering, percent(s.noEvidenceShare))};
    }
    return {Verdict::undecided,
            fmt::format("no difference found, but one of {} would not be seen either: about {:.3g} "
                        "times as many samples would decide",
                        percent(options.margin), s.moreSamples)};
}

Judgement judge(const LoadedPicture& a, const LoadedPicture& b, const Comparison& c,
                const CompareOptions& options)
{
    if (c.metrics.differingPixels == 0)
        return {Verdict::sameBits, "all values are the same, bit for bit"};
    if (c.metrics.unmatchedPixels > 0) {
        return {Verdict::differ, fmt::format("{} pixels are not finite in one file alone",
                                             c.metrics.unmatchedPixels)};
    }
    if (haveSameValues(a.image, b.image)) {
        return {
            Verdict::sameValues,
            fmt::format("no values differ by more than {:g} of them or of the mean", SAME_VALUES)};
    }
    if (a.variance.empty() || b.variance.empty()) {
        return {Verdict::differ, "values differ, and " + withoutVariance(a, b) +
                                     " variances to tell noise from error"};
    }
    if (c.paired) {
        return {Verdict::undecided,
                "both files have equal seed, sampler and scene, so their noise is "
                "the same and tests nothing; render one with another --seed"};
    }
    return judgeStatistics(*c.statistics, options);
}

std::string textIn(const ImageMetadata& metadata, const std::string& name)
{
    const auto found = metadata.find(name);
    return found == metadata.end() ? "" : found->second;
}

std::vector<std::string> notesOn(const LoadedPicture& a, const LoadedPicture& b,
                                 const Comparison& c, Correlation correlation)
{
    std::vector<std::string> notes;
    if (c.metrics.excludedPixels > 0) {
        notes.push_back(
            fmt::format("{} pixels are not finite in a file: metrics and tests leave them "
                        "out",
                        c.metrics.excludedPixels));
    }
    for (const LoadedPicture* picture : {&a, &b}) {
        if (textIn(picture->metadata, "sahl.biased") != "yes") continue;
        const std::string clamp = textIn(picture->metadata, "sahl.clampIndirect");
        const std::string rule = textIn(picture->metadata, "sahl.adaptive");
        notes.push_back(fmt::format(
            "{} says that it is biased ({}): a difference is to be expected", picture->name,
            clamp.empty() || clamp == "off" ? rule : "indirect light clamped to " + clamp));
    }
    if (textIn(a.metadata, "sahl.crop") != textIn(b.metadata, "sahl.crop")) {
        notes.push_back("the files are windows of larger pictures, and not the same ones");
    }
    if (correlation == Correlation::possible) {
        notes.push_back(
            "both files have equal seed and sampler: their noise may be correlated; other "
            "seeds make the test a fair one");
    }
    if (!c.statistics) return notes;
    const Statistics& s = *c.statistics;
    if (s.excludedPixels > c.metrics.excludedPixels) {
        notes.push_back(fmt::format(
            "{} pixels have no usable variance (it takes 2 samples, under sobol 2 blocks of 8): tests leave them out",
            s.excludedPixels - c.metrics.excludedPixels));
    }
    if (s.noEvidenceDiffering > 0) {
        notes.push_back(
            fmt::format("{} of {} pixels without spread in either file differ, by up to {} "
                        "of the mean: noise or error, their variances cannot tell",
                        s.noEvidenceDiffering, s.noEvidencePixels, percent(s.noEvidenceLargest)));
    }
    return notes;
}

}  // namespace

Comparison compare(const LoadedPicture& a, const LoadedPicture& b, const CompareOptions& options)
{
    assert(a.image.width == b.image.width && a.image.height == b.image.height);
    Comparison c;
    c.width = a.image.width;
    c.height = a.image.height;
    c.countsA = countValues(a.image);
    c.countsB = countValues(b.image);
    c.metrics = computeMetrics(a, b, options);
    c.signedError = signedErrorOf(a.image, b.image);
    const Correlation correlation = correlationOf(a.metadata, b.metadata);
    if (correlation == Correlation::certain) {
        c.paired = pairDifferences(a, b);
    } else if (!a.variance.empty() && !b.variance.empty()) {
        c.statistics = testDifferences(a, b, options);
    }
    const Judgement judgement = judge(a, b, c, options);
    c.verdict = judgement.verdict;
    c.reason = judgement.reason;
    c.notes = notesOn(a, b, c, correlation);
    return c;
}

}  // namespace sahl
