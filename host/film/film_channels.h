// The exact film as channels of an EXR file: every number in it as words of 32 bits. docs/exr.md
// lists them.
#pragma once

#include "film/film.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sahl {

/// All of the film but its counters, as views into it: film.A.red0 and so on.
std::vector<IntegerChannel> filmChannels(const Film& film);

/// Their names, in the same order.
const std::vector<std::string>& filmChannelNames();

/// XXH3 of the words of all channels, one channel behind another.
uint64_t filmHash(const Film& film);

/// Adds what the channels of a file hold: its words in that order, width * height of each. All but
/// the counters.
void addFilmWords(Film& film, std::span<const uint32_t> words);

/// Number of the first pixel that has not these numbers of samples in its halves, in such words.
std::optional<size_t> pixelWithOtherCounts(std::span<const uint32_t> words, uint32_t samplesA,
                                           uint32_t samplesB);

}  // namespace sahl
