// Replicates: the samples that a sampler ties together, one or a block of them. How they spread tells how noisy a picture
// is; halves of the film take them in turns, and no part of a picture tears one apart.
#pragma once

#include <cstdint>
#include <string>

namespace sahl {

/// Samples of a replicate: 1, 8 or 64.
///   samplerKind  one of SAMPLER_*
uint32_t replicateSizeOf(uint32_t samplerKind);

/// Samples that belong to the same half of the film: whole replicates, BLOCK_SIZE or more.
uint32_t blockOfReplicates(uint32_t replicateSize);

/// Replicates in so many samples, a begun one included.
uint32_t replicatesIn(uint32_t samples, uint32_t replicateSize);

/// As files say it (sahl.varianceOver): "samples", "blocks", which have 8, or "blocks of 64".
std::string varianceOver(uint32_t replicateSize);

/// What varianceOver() wrote; 1 for any other text.
uint32_t replicateSizeIn(const std::string& varianceOver);

}  // namespace sahl
