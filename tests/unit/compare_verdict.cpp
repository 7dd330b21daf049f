// What follows from metrics and tests: verdicts, notes, gates, exit codes.
#include "compare/correlation.h"
#include "compare/gates.h"
#include "support/noisy_pictures.h"

#include <gtest/gtest.h>

namespace sahl::testing {
namespace {

ImageMetadata madeBy(const std::string& seed, const std::string& first, const std::string& count,
                     const std::string& scene = "a.json")
{
    return {{"sahl.seed", seed},
            {"sahl.sampler", "independent"},
            {"sahl.scene", scene},
            {"sahl.firstSample", first},
            {"sahl.sampleCount", count}};
}

TEST(CompareCorrelation, sameSeedAndSamples_areCorrelated)
{
    const ImageMetadata a = madeBy("7", "0", "64");
    EXPECT_EQ(correlationOf(a, a), Correlation::certain);
    EXPECT_EQ(correlationOf(a, madeBy("7", "0", "16")), Correlation::certain);
    EXPECT_EQ(correlationOf(a, madeBy("7", "63", "16")), Correlation::certain);
    EXPECT_EQ(correlationOf(a, madeBy("7", "64", "16")), Correlation::none);
    EXPECT_EQ(correlationOf(a, madeBy("8", "0", "64")), Correlation::none);
    EXPECT_EQ(correlationOf(a, madeBy("7", "0", "64", "b.json")), Correlation::possible);
    EXPECT_EQ(correlationOf(a, {}), Correlation::none);
    EXPECT_EQ(correlationOf({}, {}), Correlation::none);
}

TEST(CompareCorrelation, rangesOfMergedFiles_countWhereTheyAreKnown)
{
    ImageMetadata a = madeBy("7", "0", "128"), b = madeBy("7", "64", "64");
    a["sahl.sampleRanges"] = "0:64,128:192";
    EXPECT_EQ(correlationOf(a, b), Correlation::none);
    b["sahl.sampleRanges"] = "64:129";
    EXPECT_EQ(correlationOf(a, b), Correlation::certain);
    b["sahl.sampleRanges"] = "nonsense";
    EXPECT_EQ(correlationOf(a, b), Correlation::certain);
    a["sahl.sceneHash"] = b["sahl.sceneHash"] = "0123";
    b["sahl.scene"] = "renamed.json";
    EXPECT_EQ(correlationOf(a, b), Correlation::certain);
}

TEST(CompareVerdict, bitsComeFirst)
{
    LoadedPicture a = statedPicture(8, 8, 1, 0.01f, 4), b = a;
    a.metadata = b.metadata = madeBy("7", "0", "4");
    EXPECT_EQ(compare(a, b, {}).verdict, Verdict::sameBits);
    b.image.rgb[5] = std::nextafter(1.0f, 2.0f);
    const Comparison c = compare(a, b, {});
    EXPECT_EQ(c.verdict, Verdict::sameValues);
    EXPECT_EQ(c.metrics.differingPixels, 1u);
    EXPECT_EQ(
        exitCodeOf(
            c, applyGates({.bitwise = true, .equivalent = {}, .maxFlip = {}, .maxRelMse = {}}, c)),
        2);
    EXPECT_EQ(exitCodeOf(c, {}), 0);
}

TEST(CompareVerdict, zerosOfBothSigns_haveOtherBitsAndTheSameValue)
{
    const LoadedPicture a = statedPicture(8, 8, 0.0f, 0, 4), b = statedPicture(8, 8, -0.0f, 0, 4);
    EXPECT_EQ(compare(a, b, {}).verdict, Verdict::sameValues);
}

TEST(CompareVerdict, correlatedFiles_getNone)
{
    LoadedPicture a = statedPicture(8, 8, 1, 0.01f, 4), b = statedPicture(8, 8, 2, 0.01f, 4);
    a.metadata = b.metadata = madeBy("7", "0", "4");
    Comparison c = compare(a, b, {});
    EXPECT_EQ(c.verdict, Verdict::undecided);
    EXPECT_FALSE(c.statistics);
    ASSERT_TRUE(c.paired);
    EXPECT_NEAR(c.paired->mean, -1 / 1.5, 1e-6);
    b.metadata = madeBy("8", "0", "4");
    c = compare(a, b, {});
    EXPECT_EQ(c.verdict, Verdict::differ);
    EXPECT_FALSE(c.paired);
    b.metadata = madeBy("7", "0", "4", "other.json");
    c = compare(a, b, {});
    EXPECT_EQ(c.verdict, Verdict::differ);
    EXPECT_EQ(c.notes.size(), 1u);
}

TEST(CompareVerdict, withoutVariance_anyDifferenceCounts)
{
    LoadedPicture a = statedPicture(8, 8, 1, 0.01f, 4), b = statedPicture(8, 8, 1.01f, 0.01f, 4);
    EXPECT_EQ(compare(a, b, {}).verdict, Verdict::undecided);
    b.variance.clear();
    const Comparison c = compare(a, b, {});
    EXPECT_EQ(c.verdict, Verdict::differ);
    EXPECT_FALSE(c.statistics);
}

TEST(CompareVerdict, pixelsWithoutSpreadThatDiffer_forbidEquivalence)
{
    // Half of the frame is noise that agrees, half of it lamps that moved.
    LoadedPicture a = statedPicture(64, 64, 1, 1e-8f, 1024), b = a;
    for (size_t i = 2048; i < 4096; i++) {
        a.variance[i] = b.variance[i] = 0;
        for (size_t c = 0; c < 3; c++) a.image.rgb[3 * i + c] = i % 2 ? 1.5f : 0.5f;
    }
    const Comparison c = compare(a, b, {});
    EXPECT_TRUE(c.statistics->equivalent);
    EXPECT_EQ(c.verdict, Verdict::undecided);
    EXPECT_EQ(c.statistics->noEvidenceDiffering, 2048u);
}

TEST(CompareVerdict, oneSampleAPixel_isUndecided)
{
    const LoadedPicture a = statedPicture(16, 16, 1, 0, 1), b = statedPicture(16, 16, 9, 0.1f, 64);
    const Comparison c = compare(a, b, {});
    EXPECT_EQ(c.verdict, Verdict::undecided);
    EXPECT_EQ(c.statistics->excludedPixels, 256u);
}

TEST(CompareVerdict, biasedFiles_areNamed)
{
    LoadedPicture a = statedPicture(8, 8, 1, 0.01f, 4), b = statedPicture(8, 8, 1.01f, 0.01f, 4);
    a.name = "quiet.exr";
    a.metadata = {{"sahl.biased", "yes"}, {"sahl.adaptive", "report"}};
    const Comparison c = compare(a, b, {});
    ASSERT_EQ(c.notes.size(), 1u);
    EXPECT_EQ(c.notes[0],
              "quiet.exr says that it is biased (report): a difference is to be expected");
}

TEST(CompareVerdict, nonFinitePixelsInOneFileAlone_areADifference)
{
    LoadedPicture a = statedPicture(16, 16, 1, 0.01f, 4),
                  b = statedPicture(16, 16, 1.0001f, 0.01f, 4);
    a.image.rgb[9] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(compare(a, b, {}).verdict, Verdict::differ);
    b.image.rgb[10] = std::numeric_limits<float>::infinity();  // the same pixel
    EXPECT_EQ(compare(a, b, {}).verdict, Verdict::undecided);
}

TEST(CompareGates, theWorstGateDecides)
{
    const LoadedPicture a = statedPicture(16, 16, 1, 0.01f, 4);
    const LoadedPicture b = statedPicture(16, 16, 1.01f, 0.01f, 4);
    const Comparison c = compare(a, b, {});
    Gates gates;
    gates.maxFlip = 0.5;
    EXPECT_EQ(exitCodeOf(c, applyGates(gates, c)), 0);
    gates.equivalent = 0.001;
    EXPECT_EQ(exitCodeOf(c, applyGates(gates, c)), 1);
    gates.maxRelMse = 0;
    EXPECT_EQ(exitCodeOf(c, applyGates(gates, c)), 2);
    EXPECT_EQ(applyGates(gates, c).size(), 3u);
}

TEST(CompareGates, undefinedMetrics_passNoGate)
{
    LoadedPicture a = statedPicture(4, 4, std::numeric_limits<float>::quiet_NaN(), 0, 4), b = a;
    b.image.rgb[0] = std::numeric_limits<float>::infinity();
    const Comparison c = compare(a, b, {});
    Gates gates;
    gates.maxRelMse = 1e9;
    EXPECT_EQ(exitCodeOf(c, applyGates(gates, c)), 2);
}

}  // namespace
}  // namespace sahl::testing
