#include "compare/correlation.h"

#include <charconv>
#include <string_view>
#include <vector>

namespace sahl {

namespace {

std::string_view textIn(const ImageMetadata& metadata, const std::string& name)
{
    const auto found = metadata.find(name);
    return found == metadata.end() ? std::string_view() : std::string_view(found->second);
}

/// Both say it, and say the same.
bool agree(const ImageMetadata& a, const ImageMetadata& b, const std::string& name)
{
    return !textIn(a, name).empty() && textIn(a, name) == textIn(b, name);
}

struct Range {
    uint64_t first = 0, end = 0;
};

bool parseNumber(std::string_view text, uint64_t& number)
{
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return !text.empty() && error == std::errc{} && end == text.data() + text.size();
}

/// sahl.sampleRanges ("0:64,128:192") where the file has it, else one range of sahl.firstSample and
/// sahl.sampleCount. Everything where a file says nothing that can be read.
std::vector<Range> samplesOf(const ImageMetadata& metadata)
{
    constexpr Range all = {0, UINT64_MAX};
    std::string_view text = textIn(metadata, "sahl.sampleRanges");
    if (text.empty()) {
        Range range;
        if (!parseNumber(textIn(metadata, "sahl.firstSample"), range.first) ||
            !parseNumber(textIn(metadata, "sahl.sampleCount"), range.end)) {
            return {all};
        }
        range.end += range.first;
        return {range};
    }
    std::vector<Range> ranges;
    while (!text.empty()) {
        const std::string_view word = text.substr(0, text.find(','));
        text.remove_prefix(std::min(text.size(), word.size() + 1));
        const size_t colon = word.find(':');
        Range range;
        if (colon == std::string_view::npos || !parseNumber(word.substr(0, colon), range.first) ||
            !parseNumber(word.substr(colon + 1), range.end)) {
            return {all};
        }
        ranges.push_back(range);
    }
    return ranges;
}

bool overlap(const std::vector<Range>& a, const std::vector<Range>& b)
{
    for (const Range& x : a) {
        for (const Range& y : b) {
            if (x.first < y.end && y.first < x.end) return true;
        }
    }
    return false;
}

}  // namespace

Correlation correlationOf(const ImageMetadata& a, const ImageMetadata& b)
{
    if (!agree(a, b, "sahl.seed") || !agree(a, b, "sahl.sampler")) return Correlation::none;
    if (!overlap(samplesOf(a), samplesOf(b))) return Correlation::none;
    const bool sameScene = agree(a, b, "sahl.scene") || agree(a, b, "sahl.sceneHash");
    return sameScene ? Correlation::certain : Correlation::possible;
}

}  // namespace sahl
