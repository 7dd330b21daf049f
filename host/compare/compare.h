// Two pictures against each other: how far apart they are, by metrics with exact definitions, and
// whether noise explains it, by the variance that Sahl's EXR files carry. Plain data for whoever
// shows it; docs/compare.md has the definitions.
#pragma once

#include "image/image.h"

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace sahl {

/// A picture with what its file says about it.
struct LoadedPicture {
    std::string name;    ///< the file's, as the user wrote it
    std::string format;  ///< "EXR", "HDR", "PFM" or "PNG"
    Image image;         ///< linear; the sRGB values of a PNG decoded
    bool displayReferred =
        false;  ///< a PNG: clipped and encoded for a display before it was stored
    std::vector<float>
        variance;  ///< of each pixel's mean luminance (variance.Y); empty: not in the file
    std::vector<float> samples;  ///< of each pixel (samples.Y); empty: not in the file
    ImageMetadata metadata;      ///< string attributes of an EXR, texts of a PNG

    /// Replicates of a pixel, whose spread its variance is from: samples, or blocks of them where the file
    /// says so (sahl.varianceOver). `samples` must be there.
    double replicates(size_t pixel) const;
};

/// Reads EXR, HDR, PFM or PNG. Throws badInput naming the file and what is wrong with it.
LoadedPicture loadPicture(const fs::path& path);

struct CompareOptions {
    double level = 0.01;    ///< chance that the verdict calls equal scenes different
    double margin = 0.001;  ///< of the mean luminance: what equivalence means
    double tolerated = 0;   ///< of the mean luminance: differences below it do not count as such
    double exposure = 0;    ///< stops; linear pictures for PSNR, SSIM and LDR-FLIP
    double pixelsPerDegree = 67.0206;  ///< FLIP: of the visual field
    unsigned threads = 1;
};

/// NaN stands for "not defined", for example SSIM of a picture smaller than its window.
constexpr double UNDEFINED = std::numeric_limits<double>::quiet_NaN();

/// A metric over everything, and without the 0.1 % of the values (pixels, windows) that are worst.
struct Measure {
    double all = UNDEFINED;
    double trimmed = UNDEFINED;
};

/// Of one channel of one file.
struct ValueCounts {
    uint64_t nan = 0, infinite = 0, negative = 0;
};

/// A pixel's place and what is there.
struct Extreme {
    uint32_t x = 0, y = 0;
    double value = 0;
};

struct Flip {
    Measure mean;
    double weightedMedian = UNDEFINED;
    double largest = UNDEFINED;
    std::vector<float> map;         ///< of each pixel, in [0,1]; NaN where a picture is not finite
    std::vector<double> exposures;  ///< HDR-FLIP: in stops, the largest value over them counts
};

/// Values are R, G and B of the pixels that are finite in both pictures.
struct Metrics {
    uint64_t pixels = 0;                    ///< that the metrics are over
    uint64_t excludedPixels = 0;            ///< not finite in a picture
    uint64_t unmatchedPixels = 0;           ///< of them, not finite in one picture alone
    uint64_t differingPixels = 0;           ///< in any bit of R, G or B
    Extreme largestDifference;              ///< |a - b| over the channels
    Measure mae, mse, rmse, relMse, smape;  ///< linear values
    Measure psnr, ssim;                     ///< display-referred values; psnr in dB
    Flip ldrFlip;
    std::optional<Flip> hdrFlip;  ///< only of two linear pictures
};

/// A difference of mean luminances, A - B, and how sure it is.
struct MeanTest {
    double difference = 0;
    double standardError = 0;     ///< 0: no pixel has spread in either file, nothing can be said
    double degreesOfFreedom = 0;  ///< of the standard error
    double z = 0;  ///< difference beyond what is tolerated, in standard errors; signed
    double p = 1;  ///< chance of this or more by noise alone
};

struct BlockTest {
    uint32_t x = 0, y = 0, width = 0, height = 0;  ///< [pixels]
    bool tested = false;                           ///< false: no spread, or no finite pixel
    bool differs = false;
    MeanTest mean;
};

/// What the variances of both files allow to say. Luminance (Rec. 709) throughout.
struct Statistics {
    double meanA = 0, meanB = 0;       ///< over the pixels that are finite in both files
    uint64_t excludedPixels = 0;       ///< luminance or variance not finite in a file
    uint64_t noEvidencePixels = 0;     ///< variance 0 in both files: no z, nothing by themselves
    uint64_t noEvidenceDiffering = 0;  ///< of them, with values that differ
    double noEvidenceLargest = 0;      ///< the largest of these differences, relative to the mean
    double noEvidenceShare = 0;        ///< all of these differences together, relative to all light

    MeanTest frame;
    bool frameDiffers = false;
    std::vector<BlockTest> blocks;  ///< 8 x 8 pixels, row by row
    uint64_t testedBlocks = 0, differingBlocks = 0;
    double frameLevel = 0, blockLevel = 0;  ///< of the single tests; together options.level

    double confidenceBound = 0;  ///< |A - B| is at most this, 95 % sure, relative to the mean
    bool equivalent = false;     ///< that bound is below the margin
    double detectableBias = 0;   ///< of the frame, relative to the mean: found in 4 of 5 cases
    double detectableBlock = 0;  ///< the same of the middle one of all tested blocks
    double moreSamples = 0;      ///< factor of the sample counts that would decide in 4 of 5 cases
    std::vector<float> z;        ///< of each pixel, signed; NaN where there is no evidence
};

/// Of pictures that share random numbers: their noise is shared, too, and tests nothing.
struct PairedDifferences {
    double mean = 0;     ///< of luminance, A - B, relative to the mean of both
    double spread = 0;   ///< standard error of it, from the spread between 8 x 8 blocks
    double largest = 0;  ///< of a block, absolute, relative to the mean of both
};

enum class Verdict {
    sameBits,    ///< every value of R, G and B
    sameValues,  ///< to 1e-6
    equivalent,  ///< no difference found, and the means agree within the margin
    undecided,
    differ,
};

struct Comparison {
    uint32_t width = 0, height = 0;
    std::array<ValueCounts, 3> countsA, countsB;
    Metrics metrics;
    std::vector<float> signedError;  ///< a - b of R, G, B of each pixel; as it is where not finite

    /// Empty where a file has no variance, or where both share random numbers.
    std::optional<Statistics> statistics;
    /// Only where both share random numbers.
    std::optional<PairedDifferences> paired;

    Verdict verdict = Verdict::undecided;
    std::string reason;              ///< of the verdict, a sentence for the user
    std::vector<std::string> notes;  ///< what else one should know, sentences
};

/// Both pictures must be of the same size.
Comparison compare(const LoadedPicture& a, const LoadedPicture& b, const CompareOptions& options);

}  // namespace sahl
