#include "film/film_file.h"

#include "film/film_channels.h"
#include "film/layers.h"
#include "film/replicates.h"
#include "util/error.h"
#include "util/hash.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <set>

namespace sahl {

namespace {

const char* const FORMAT = "1";  // of channels and attributes

struct NamedCounter {
    const char* name;
    uint64_t Counters::*value;
};

constexpr std::array COUNTERS = {
    NamedCounter{"cameraRays", &Counters::cameraRays},
    NamedCounter{"indirectRays", &Counters::indirectRays},
    NamedCounter{"shadowRays", &Counters::shadowRays},
    NamedCounter{"boxTests", &Counters::boxTests},
    NamedCounter{"primitiveTests", &Counters::primitiveTests},
    NamedCounter{"bounces", &Counters::bounces},
    NamedCounter{"badSamples", &Counters::badSamples},
    NamedCounter{"clamped", &Counters::clamped},
};

/// "cameraRays=3072 indirectRays=..."
std::string countersText(const Counters& counters)
{
    std::string text;
    for (const NamedCounter& counter : COUNTERS) {
        text +=
            fmt::format("{}{}={}", text.empty() ? "" : " ", counter.name, counters.*counter.value);
    }
    return text;
}

/// All of `text` as a number.
std::optional<uint64_t> numberIn(std::string_view text, int base = 10)
{
    uint64_t number = 0;
    const char* end = text.data() + text.size();
    const auto [stopped, error] = std::from_chars(text.data(), end, number, base);
    if (error != std::errc() || stopped != end) return {};
    return number;
}

/// What countersText() wrote; nothing for any other text.
std::optional<Counters> parseCounters(const std::string& text)
{
    Counters counters;
    std::string_view rest = text;
    for (const NamedCounter& counter : COUNTERS) {
        const std::string_view entry = rest.substr(0, rest.find(' '));
        rest.remove_prefix(std::min(rest.size(), entry.size() + 1));
        const auto number = numberIn(entry.substr(std::min(entry.size(), entry.find('=') + 1)));
        if (!number) return {};
        counters.*counter.value = *number;
    }
    if (countersText(counters) != text) return {};
    return counters;
}

Error wrongAttribute(const FilmFile& file, const std::string& name, const std::string& expected)
{
    const auto found = file.description.metadata.find(name);
    if (found == file.description.metadata.end()) {
        return badInput("{}: attribute {} is missing; it should be {}", file.name(), name,
                        expected);
    }
    return badInput("{}: attribute {} is {}; it should be {}", file.name(), name,
                    printable(found->second), expected);
}

void requireFilm(const FilmFile& file)
{
    if (file.attribute("sahl.version").empty()) {
        throw badInput("{}: is no picture by sahl render", file.name());
    }
    if (const std::string& rule = file.attribute("sahl.adaptive");
        !rule.empty() && rule != "none") {
        throw badInput(
            "{}: attribute sahl.adaptive is {}: adaptive sampling decides how many samples a "
            "pixel gets from all of its samples together, so films of parts do not add up to "
            "that of one run; render the parts with --adaptive none",
            file.name(), printable(rule));
    }
    if (file.attribute("sahl.film").empty()) {
        throw badInput("{}: has no exact film in it; render it with --shard, --sample-range or "
                       "--keep-film",
                       file.name());
    }
    if (file.attribute("sahl.film") != FORMAT) {
        throw wrongAttribute(file, "sahl.film", fmt::format("\"{}\"", FORMAT));
    }
}

void readLabel(FilmFile& file)
{
    const auto ranges = parseRanges(file.attribute("sahl.sampleRanges"));
    if (!ranges) {
        throw wrongAttribute(file, "sahl.sampleRanges",
                             fmt::format("ascending ranges such as \"0:64,128:192\", each from a "
                                         "multiple of {} on, up to {}",
                                         BLOCK_SIZE, MAX_SAMPLES));
    }
    const auto total = numberIn(file.attribute("sahl.totalSamples"));
    if (!total || *total < ranges->back().end || *total > MAX_SAMPLES) {
        throw wrongAttribute(
            file, "sahl.totalSamples",
            fmt::format("a number from {} to {}", ranges->back().end, MAX_SAMPLES));
    }
    file.label = {*ranges, static_cast<uint32_t>(*total)};
    const uint32_t blockSize = blockOfReplicates(file.replicateSize());
    if (!beginWithBlocks(*ranges, blockSize)) {
        throw wrongAttribute(file, "sahl.sampleRanges",
                             fmt::format("ranges that begin with blocks of {} samples, as sahl.varianceOver says", blockSize));
    }

    const std::string& hash = file.attribute("sahl.filmHash");
    const auto value = numberIn(hash, 16);
    if (!value || hashText(*value) != hash) {
        throw wrongAttribute(file, "sahl.filmHash", "16 hexadecimal digits");
    }
    file.hash = *value;

    const auto counters = parseCounters(file.attribute("sahl.filmCounters"));
    if (!counters) {
        throw wrongAttribute(file, "sahl.filmCounters", "as in \"" + countersText({}) + '"');
    }
    file.counters = *counters;
    const uint64_t samples =
        uint64_t{file.description.width} * file.description.height * samplesIn(file.label.ranges);
    if (counters->cameraRays != samples) {
        throw badInput(
            "{}: attribute sahl.filmCounters has {} camera rays, but {} x {} pixels with the "
            "samples {} have {}",
            file.name(), counters->cameraRays, file.description.width, file.description.height,
            rangesText(file.label.ranges), samples);
    }
}

const char* kindName(ExrKind kind)
{
    if (kind == ExrKind::integer) return "uint";
    return kind == ExrKind::half ? "half" : "float";
}

void requireChannel(const FilmFile& file, const std::string& name, ExrKind kind)
{
    const auto found = file.description.channels.find(name);
    if (found == file.description.channels.end()) {
        throw badInput("{}: channel {} is missing: the film is not complete; render it again",
                       file.name(), name);
    }
    if (found->second.kind != kind) {
        throw badInput(
            "{}: channel {} is of type {}, not {}: the file was converted; render it again",
            file.name(), name, kindName(found->second.kind), kindName(kind));
    }
    if (!found->second.fullResolution) {
        throw badInput("{}: channel {} is stored at a lower resolution", file.name(), name);
    }
}

std::set<std::string> namesOf(const std::vector<ImageChannel>& channels)
{
    std::set<std::string> names;
    for (const ImageChannel& channel : channels) names.insert(channel.name);
    return names;
}

const std::set<std::string>& firstHitNames()
{
    static const std::set<std::string> names = namesOf(firstHitChannels({}, 1, {}));
    return names;
}

/// Every channel is the film's, made from it, or the same in all parts; nothing is dropped in
/// silence.
void requireKnownChannels(const FilmFile& file)
{
    std::set<std::string> known = namesOf(statisticsChannels(Film()));
    known.insert(filmChannelNames().begin(), filmChannelNames().end());
    known.insert(firstHitNames().begin(), firstHitNames().end());
    known.insert({"R", "G", "B"});
    for (const auto& [name, channel] : file.description.channels) {
        if (!known.contains(name)) {
            throw badInput("{}: channel {} cannot be merged; it is none that sahl render writes",
                           file.name(), printable(name));
        }
    }
}

}  // namespace

ImageMetadata filmMetadata(const Film& film, const FilmLabel& label)
{
    return {{"sahl.film", FORMAT},
            {"sahl.sampleRanges", rangesText(label.ranges)},
            {"sahl.totalSamples", std::to_string(label.totalSamples)},
            {"sahl.filmHash", hashText(filmHash(film))},
            {"sahl.filmCounters", countersText(film.counters)}};
}

const std::string& FilmFile::attribute(const std::string& attributeName) const
{
    static const std::string none;
    const auto found = description.metadata.find(attributeName);
    return found == description.metadata.end() ? none : found->second;
}

uint32_t FilmFile::replicateSize() const
{
    return replicateSizeIn(attribute("sahl.varianceOver"));
}

std::vector<std::string> FilmFile::layers() const
{
    std::vector<std::string> names;
    for (const auto& [name, channel] : description.channels) {
        if (firstHitNames().contains(name)) names.push_back(name);
    }
    return names;
}

FilmFile openFilmFile(const fs::path& path)
{
    FilmFile file;
    file.path = path;
    file.description = describeExr(path);
    requireFilm(file);
    readLabel(file);
    for (const std::string& name : filmChannelNames()) requireChannel(file, name, ExrKind::integer);
    for (const std::string& name : file.layers()) requireChannel(file, name, ExrKind::real);
    requireKnownChannels(file);
    return file;
}

void addFilmOf(const FilmFile& file, Film& film)
{
    const ExrPlanes planes = readExrPlanes(file.path, file.description, filmChannelNames());
    const uint64_t hash = hashOfBytes(std::as_bytes(planes.words()));
    if (hash != file.hash) {
        throw badInput(
            "{}: the hash of its film is {}, attribute sahl.filmHash is {}: the file was "
            "altered; render it again",
            file.name(), hashText(hash), hashText(file.hash));
    }
    const uint32_t blockSize = blockOfReplicates(file.replicateSize());
    const uint32_t samplesA = samplesOfHalf(file.label.ranges, 0, blockSize);
    const uint32_t samplesB = samplesOfHalf(file.label.ranges, 1, blockSize);
    if (const auto pixel = pixelWithOtherCounts(planes.words(), samplesA, samplesB)) {
        throw badInput(
            "{}: pixel {}, {} has not the {} and {} samples in halves A and B that the range "
            "{} means",
            file.name(), *pixel % film.width, *pixel / film.width, samplesA, samplesB,
            rangesText(file.label.ranges));
    }
    addFilmWords(film, planes.words());
    film.counters.add(file.counters);
}

}  // namespace sahl
