// Which samples of every pixel a film has: ranges of sample numbers, and how a picture is shared
// out.
#pragma once

#include "shared/film_types.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sahl {

constexpr uint32_t MAX_SAMPLES = 1u << 24;  ///< of a pixel

/// Samples first, first + 1, ..., end - 1 of every pixel.
struct SampleRange {
    uint32_t first = 0;
    uint32_t end = 0;
    bool operator==(const SampleRange&) const = default;
    auto operator<=>(const SampleRange&) const = default;
};

/// Ascending, none empty, no two with a sample in common; each begins at a multiple of BLOCK_SIZE,
/// so that no block of samples is torn apart, and ranges that meet are one.
using SampleRanges = std::vector<SampleRange>;

/// "0:64,128:192"
std::string rangesText(const SampleRanges& ranges);
std::string rangeText(const SampleRange& range);

/// What rangesText() wrote; nothing for any other text.
std::optional<SampleRanges> parseRanges(std::string_view text);

/// All of these ranges, which have no sample in common.
SampleRanges unionOf(SampleRanges ranges);

/// Samples of 0 ... total-1 that are in none of the ranges.
SampleRanges gapsIn(const SampleRanges& ranges, uint32_t total);

/// Samples of a pixel, and of one half of it (0: A, even blocks of `blockSize` samples; 1: B).
uint32_t samplesIn(const SampleRanges& ranges);
uint32_t samplesOfHalf(const SampleRanges& ranges, int half, uint32_t blockSize = BLOCK_SIZE);

/// Whether all begin with a block of so many samples. (They end with one, or where some picture did.)
bool beginWithBlocks(const SampleRanges& ranges, uint32_t blockSize);

/// Blocks of a pixel, begun ones included.
uint32_t blocksIn(const SampleRanges& ranges);
uint32_t blocksIn(uint32_t samples, uint32_t blockSize = BLOCK_SIZE);

/// Part `index` of `count` of a picture with `total` samples a pixel: blocks index*B/count up to
/// (index+1)*B/count of its B blocks. count is at most B, so no part is empty.
SampleRange shardOf(uint32_t index, uint32_t count, uint32_t total, uint32_t blockSize = BLOCK_SIZE);

}  // namespace sahl
