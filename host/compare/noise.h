// What noise alone can explain: differences of luminance between two pictures, summed over blocks
// and over the frame, against the variances that their files state.
#pragma once

#include "compare/compare.h"

namespace sahl {

constexpr uint32_t COMPARE_BLOCK = 8;  ///< side of a block [pixels]

/// All of Statistics. Both pictures must have variances.
Statistics testDifferences(const LoadedPicture& a, const LoadedPicture& b,
                           const CompareOptions& options);

/// Without any use of the variances.
PairedDifferences pairDifferences(const LoadedPicture& a, const LoadedPicture& b);

/// What a hypothesis test of equal means says of a difference.
///   tolerated  differences up to this, absolute, are none
MeanTest testMean(double difference, double standardError, double degreesOfFreedom,
                  double tolerated);

}  // namespace sahl
