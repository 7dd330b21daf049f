#include "film/replicates.h"

#include "shared/film_types.h"
#include "shared/scene_types.h"

#include <algorithm>

namespace sahl {

namespace {

constexpr uint32_t REPLICATE_SIZES[] = {1, BLOCK_SIZE, 64};  // in the order of SAMPLER_*
static_assert(SAMPLER_INDEPENDENT == 0 && SAMPLER_SOBOL == 1 && SAMPLER_SOBOL64 == 2);

constexpr const char* VARIANCE_OVER[] = {"samples", "blocks", "blocks of 64"};

}  // namespace

uint32_t replicateSizeOf(uint32_t samplerKind)
{
    return REPLICATE_SIZES[samplerKind];
}

uint32_t blockOfReplicates(uint32_t replicateSize)
{
    return std::max(BLOCK_SIZE, replicateSize);
}

uint32_t replicatesIn(uint32_t samples, uint32_t replicateSize)
{
    return samples / replicateSize + (samples % replicateSize != 0 ? 1 : 0);
}

std::string varianceOver(uint32_t replicateSize)
{
    return VARIANCE_OVER[std::ranges::find(REPLICATE_SIZES, replicateSize) - std::begin(REPLICATE_SIZES)];
}

uint32_t replicateSizeIn(const std::string& varianceOver)
{
    const auto found = std::ranges::find(VARIANCE_OVER, varianceOver);
    return found == std::end(VARIANCE_OVER) ? 1 : REPLICATE_SIZES[found - std::begin(VARIANCE_OVER)];
}

}  // namespace sahl
