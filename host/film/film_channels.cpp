#include "film/film_channels.h"

#include "util/hash.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>

namespace sahl {

// A fixed-point number is two words of 64 bits in memory, and four of 32 in the file, lowest first.
static_assert(std::endian::native == std::endian::little,
              "the words of a film are read where they lie");

namespace {

constexpr size_t SUMS = 4;   // red, green, blue, squared luminance
constexpr size_t WORDS = 4;  // of a sum
constexpr size_t OF_HALF = SUMS * WORDS + 1;
constexpr size_t SAMPLES = SUMS * WORDS;  // place of the count among a half's channels
constexpr size_t DIGEST = 2 * OF_HALF, BOX_TESTS = DIGEST + 1, PRIMITIVE_TESTS = DIGEST + 2;
constexpr size_t CHANNELS = DIGEST + 3;

std::vector<std::string> makeNames()
{
    std::vector<std::string> names;
    for (const char* half : {"A", "B"}) {
        for (const char* sum : {"red", "green", "blue", "squares"}) {
            for (size_t word = 0; word < WORDS; word++)
                names.push_back(fmt::format("film.{}.{}{}", half, sum, word));
        }
        names.push_back(fmt::format("film.{}.samples", half));
    }
    for (const char* name : {"film.digest", "film.boxTests", "film.primitiveTests"})
        names.push_back(name);
    return names;
}

/// Where the values of the channels lie in the first pixel, and the distance to the next one's.
struct Place {
    const void* first;
    size_t stride;
};

std::vector<Place> placesIn(const Film& film)
{
    std::vector<Place> places;
    for (const ZeroedVector<HalfPixel>& half : film.half) {
        const HalfPixel& pixel = half[0];
        for (const Fixed64x64* sum : {&pixel.sum[0], &pixel.sum[1], &pixel.sum[2], &pixel.sumY2}) {
            for (const uint64_t* number : {&sum->fraction, &sum->whole}) {
                const auto* low = reinterpret_cast<const std::byte*>(number);
                places.push_back({low, sizeof(HalfPixel)});
                places.push_back({low + sizeof(uint32_t), sizeof(HalfPixel)});
            }
        }
        places.push_back({&pixel.samples, sizeof(HalfPixel)});
    }
    places.push_back({&film.digest[0], sizeof(uint32_t)});
    places.push_back({&film.work[0].boxTests, sizeof(PixelWork)});
    places.push_back({&film.work[0].primitiveTests, sizeof(PixelWork)});
    return places;
}

/// Words of one pixel in channels that lie one behind another.
struct PixelWords {
    std::span<const uint32_t> words;
    size_t pixels, pixel;

    uint32_t at(size_t channel) const { return words[channel * pixels + pixel]; }
    uint64_t pair(size_t channel) const { return uint64_t{at(channel + 1)} << 32 | at(channel); }
    Fixed64x64 sum(size_t channel) const { return {pair(channel + 2), pair(channel)}; }
};

void addHalf(HalfPixel& half, const PixelWords& words, size_t channel)
{
    for (size_t c = 0; c < 3; c++) half.sum[c].add(words.sum(channel + c * WORDS));
    half.sumY2.add(words.sum(channel + 3 * WORDS));
    half.samples += words.at(channel + SAMPLES);
}

}  // namespace

const std::vector<std::string>& filmChannelNames()
{
    static const std::vector<std::string> names = makeNames();
    return names;
}

std::vector<IntegerChannel> filmChannels(const Film& film)
{
    assert(!film.digest.empty());
    std::vector<IntegerChannel> channels;
    for (const Place& place : placesIn(film)) {
        channels.push_back({filmChannelNames()[channels.size()],
                            static_cast<const std::byte*>(place.first), place.stride});
    }
    assert(channels.size() == CHANNELS);
    return channels;
}

uint64_t filmHash(const Film& film)
{
    constexpr size_t PIECE = 4096;  // pixels
    Hash hash;
    std::vector<uint32_t> words(PIECE);
    for (const IntegerChannel& channel : filmChannels(film)) {
        for (size_t begin = 0; begin < film.digest.size(); begin += PIECE) {
            const size_t count = std::min(PIECE, film.digest.size() - begin);
            for (size_t i = 0; i < count; i++) {
                std::memcpy(&words[i], channel.first + (begin + i) * channel.stride,
                            sizeof(uint32_t));
            }
            hash.add(std::as_bytes(std::span(words).first(count)));
        }
    }
    return hash.value();
}

void addFilmWords(Film& film, std::span<const uint32_t> words)
{
    const size_t pixels = film.digest.size();
    assert(words.size() == CHANNELS * pixels);
    for (size_t i = 0; i < pixels; i++) {
        const PixelWords pixel = {words, pixels, i};
        addHalf(film.half[0][i], pixel, 0);
        addHalf(film.half[1][i], pixel, OF_HALF);
        film.digest[i] += pixel.at(DIGEST);
        film.work[i].add({pixel.at(BOX_TESTS), pixel.at(PRIMITIVE_TESTS)});
    }
}

std::optional<size_t> pixelWithOtherCounts(std::span<const uint32_t> words, uint32_t samplesA,
                                           uint32_t samplesB)
{
    const size_t pixels = words.size() / CHANNELS;
    for (size_t i = 0; i < pixels; i++) {
        const PixelWords pixel = {words, pixels, i};
        if (pixel.at(SAMPLES) != samplesA || pixel.at(OF_HALF + SAMPLES) != samplesB) return i;
    }
    return {};
}

}  // namespace sahl
