// EXR files with films in them for tests: whole ones, and ones that are altered before they are
// written.
#pragma once

#include "film/film_channels.h"
#include "film/film_file.h"
#include "film/layers.h"
#include "support/temporary_folder.h"
#include "util/error.h"
#include "util/hash.h"

#include <functional>
#include <random>

namespace sahl::testing {

/// The samples of these ranges with numbers that depend on pixel and block alone, so that films of
/// parts add up to that of the whole.
inline Film filmOfRanges(uint32_t width, uint32_t height, const SampleRanges& ranges)
{
    Film film(width, height);
    for (const SampleRange& range : ranges) {
        for (uint32_t first = range.first; first < range.end; first += BLOCK_SIZE) {
            std::mt19937 random(first + 1);
            std::vector<PixelBlock> blocks(size_t{width} * height);
            for (PixelBlock& block : blocks) {
                auto value = [&] {
                    return std::ldexp(static_cast<float>(random() >> 8), int(random() % 60) - 50);
                };
                block.samplesDone = std::min(BLOCK_SIZE, range.end - first);
                block.sum = vec3(value(), value(), value());
                block.sumY2 = value();
                block.digest = static_cast<uint32_t>(random());
                block.boxTests = static_cast<uint32_t>(random());  // some pixels saturate
                block.primitiveTests = static_cast<uint32_t>(random() % 1000);
                block.indirectRays = block.bounces = 3;
            }
            film.add(0, 0, width, height, first, blocks);
        }
    }
    return film;
}

/// A file with a film, before it is written.
struct FilmFileParts {
    Film film;
    ImageMetadata metadata;
    std::vector<ImageChannel> layers;
    std::vector<std::vector<uint32_t>>
        words;  ///< of the channels, in the order of filmChannelNames()
    std::vector<std::string> names = filmChannelNames();
    std::optional<ImagePlace> place;

    /// Words and hash as the film has them.
    void fromFilm(const FilmLabel& label)
    {
        words.clear();
        for (const IntegerChannel& channel : filmChannels(film)) {
            words.emplace_back(film.digest.size());
            for (size_t i = 0; i < film.digest.size(); i++)
                std::memcpy(&words.back()[i], channel.first + i * channel.stride, sizeof(uint32_t));
        }
        for (const auto& [name, text] : filmMetadata(film, label)) metadata[name] = text;
    }

    /// Makes the hash right after `words` were changed.
    void rehash()
    {
        Hash hash;
        for (const auto& channel : words) hash.add(std::as_bytes(std::span(channel)));
        metadata["sahl.filmHash"] = hashText(hash.value());
    }

    std::vector<uint8_t> encode() const
    {
        std::vector<IntegerChannel> integers;
        for (size_t i = 0; i < words.size(); i++) {
            integers.push_back(
                {names[i], reinterpret_cast<const std::byte*>(words[i].data()), sizeof(uint32_t)});
        }
        return encodeExr(meanImage(film), metadata, layers, place, integers);
    }
};

/// What sahl render would write for these ranges of 64 samples of a picture of 5 x 4 pixels.
inline FilmFileParts filmFileOf(const SampleRanges& ranges, uint32_t total = 64)
{
    FilmFileParts parts;
    parts.film = filmOfRanges(5, 4, ranges);
    parts.layers = statisticsChannels(parts.film);
    parts.metadata = {{"sahl.version", "0.1.0"},
                      {"sahl.scene", "a.json"},
                      {"sahl.seed", "0"},
                      {"sahl.maxBounces", "8"},
                      {"sahl.integrator", "path"},
                      {"sahl.sampler", "independent"},
                      {"sahl.sceneHash", "0123456789abcdef"},
                      {"sahl.treeHash", "fedcba9876543210"},
                      {"sahl.device", "CPU"},
                      {"sahl.driver", "gcc"},
                      {"sahl.interrupted", "no"}};
    parts.fromFilm({ranges, total});
    return parts;
}

}  // namespace sahl::testing
