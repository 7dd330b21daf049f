#include "film/sample_ranges.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <charconv>

namespace sahl {

namespace {

/// Takes a number off the front of the text.
std::optional<uint32_t> takeNumber(std::string_view& text)
{
    uint32_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || number > MAX_SAMPLES) return {};
    text.remove_prefix(static_cast<size_t>(end - text.data()));
    return number;
}

bool takeCharacter(std::string_view& text, char character)
{
    if (!text.starts_with(character)) return false;
    text.remove_prefix(1);
    return true;
}

}  // namespace

std::string rangeText(const SampleRange& range)
{
    return fmt::format("{}:{}", range.first, range.end);
}

std::string rangesText(const SampleRanges& ranges)
{
    std::string text;
    for (const SampleRange& range : ranges) {
        if (!text.empty()) text += ',';
        text += rangeText(range);
    }
    return text;
}

std::optional<SampleRanges> parseRanges(std::string_view text)
{
    SampleRanges ranges;
    do {
        const auto first = takeNumber(text);
        if (!first || !takeCharacter(text, ':')) return {};
        const auto end = takeNumber(text);
        if (!end || *first >= *end || *first % BLOCK_SIZE != 0) return {};
        if (!ranges.empty() && *first <= ranges.back().end) return {};
        ranges.push_back({*first, *end});
    } while (takeCharacter(text, ','));
    if (!text.empty()) return {};
    return ranges;
}

SampleRanges unionOf(SampleRanges ranges)
{
    std::sort(ranges.begin(), ranges.end());
    SampleRanges joined;
    for (const SampleRange& range : ranges) {
        if (!joined.empty() && joined.back().end == range.first) {
            joined.back().end = range.end;
        } else {
            joined.push_back(range);
        }
    }
    return joined;
}

SampleRanges gapsIn(const SampleRanges& ranges, uint32_t total)
{
    SampleRanges gaps;
    uint32_t next = 0;
    for (const SampleRange& range : ranges) {
        if (range.first > next) gaps.push_back({next, range.first});
        next = range.end;
    }
    if (next < total) gaps.push_back({next, total});
    return gaps;
}

uint32_t samplesIn(const SampleRanges& ranges)
{
    return samplesOfHalf(ranges, 0) + samplesOfHalf(ranges, 1);
}

uint32_t samplesOfHalf(const SampleRanges& ranges, int half, uint32_t blockSize)
{
    // Of the samples below n: whole pairs of blocks, and what is left over.
    auto below = [half, blockSize](uint32_t n) {
        const uint32_t rest = n % (2 * blockSize);
        const uint32_t restOfA = std::min(rest, blockSize);
        return n / (2 * blockSize) * blockSize + (half == 0 ? restOfA : rest - restOfA);
    };
    uint32_t samples = 0;
    for (const SampleRange& range : ranges) samples += below(range.end) - below(range.first);
    return samples;
}

bool beginWithBlocks(const SampleRanges& ranges, uint32_t blockSize)
{
    return std::ranges::all_of(ranges, [=](const SampleRange& range) { return range.first % blockSize == 0; });
}

uint32_t blocksIn(uint32_t samples, uint32_t blockSize)
{
    return samples / blockSize + (samples % blockSize != 0 ? 1 : 0);
}

uint32_t blocksIn(const SampleRanges& ranges)
{
    uint32_t blocks = 0;
    for (const SampleRange& range : ranges) blocks += blocksIn(range.end - range.first);
    return blocks;
}

SampleRange shardOf(uint32_t index, uint32_t count, uint32_t total, uint32_t blockSize)
{
    const uint64_t blocks = blocksIn(total, blockSize);
    assert(index < count && count <= blocks);
    auto border = [&](uint64_t part) {
        const auto sample = static_cast<uint32_t>(part * blocks / count * blockSize);
        return std::min(sample, total);
    };
    return {border(index), border(uint64_t{index} + 1)};
}

}  // namespace sahl
