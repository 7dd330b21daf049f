#include "film/merge.h"

#include "film/film_channels.h"
#include "util/error.h"
#include "util/memory.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <set>

namespace sahl {

namespace {

/// Attributes that parts of one picture need not have in common.
bool mayDiffer(const std::string& name)
{
    static const std::set<std::string> names = {
        "sahl.device",       "sahl.driver",       "sahl.filmCounters", "sahl.filmHash",
        "sahl.firstSample",  "sahl.interrupted",  "sahl.partial",      "sahl.passes",
        "sahl.sampleCount",  "sahl.sampleRanges", "sahl.scene",        "sahl.shard",
        "sahl.stopped",      "sahl.totalSamples",
    };
    return names.contains(name) || !name.starts_with("sahl.");
}

/// What an unequal attribute means, for those whose value says little.
std::string meaningOf(const std::string& name)
{
    if (name == "sahl.sceneHash") return " (another scene)";
    if (name == "sahl.treeHash")
        return " (another tree; its work does not add up: use one --bvh-build)";
    return "";
}

std::string valueIn(const FilmFile& file, const std::string& name)
{
    return file.description.metadata.contains(name) ? printable(file.attribute(name)) : "missing";
}

bool sameIn(const FilmFile& a, const FilmFile& b, const std::string& name)
{
    return a.description.metadata.contains(name) == b.description.metadata.contains(name) &&
           a.attribute(name) == b.attribute(name);
}

std::string sizeText(const FilmFile& file)
{
    const ImagePlace& place = file.description.place;
    return fmt::format("{} x {} pixels at {},{} of {} x {}", file.description.width,
                       file.description.height, place.left, place.top, place.fullWidth,
                       place.fullHeight);
}

void requireSameSize(const FilmFile& file, const FilmFile& first)
{
    if (sizeText(file) == sizeText(first)) return;
    throw badInput("{}: has {}, {} has {}; parts of one picture have the same size", file.name(),
                   sizeText(file), first.name(), sizeText(first));
}

void requireSameSettings(const FilmFile& file, const FilmFile& first)
{
    // Another version may mean other attributes, so it is told first and alone.
    std::vector<std::string> differing;
    auto compare = [&](const std::string& name) {
        if (!mayDiffer(name) && !sameIn(file, first, name)) differing.push_back(name);
    };
    compare("sahl.version");
    if (differing.empty()) {
        ImageMetadata all = file.description.metadata;
        all.insert(first.description.metadata.begin(), first.description.metadata.end());
        for (const auto& [name, value] : all) compare(name);
    }
    if (differing.empty()) return;
    constexpr size_t MOST = 4;
    std::string text;
    for (size_t i = 0; i < std::min(MOST, differing.size()); i++) {
        const std::string& name = differing[i];
        text +=
            fmt::format("{}{} is {}, that of {} is {}{}", i == 0 ? "" : "; ", name,
                        valueIn(file, name), first.name(), valueIn(first, name), meaningOf(name));
    }
    if (differing.size() > MOST) text += fmt::format("; and {} more", differing.size() - MOST);
    throw badInput("{}: {}; only parts of one picture can be merged", file.name(), text);
}

void requireSameLayers(const FilmFile& file, const FilmFile& first)
{
    auto refuseFirstOf = [](const FilmFile& with, const FilmFile& without) {
        const std::vector<std::string> theirs = without.layers();
        for (const std::string& name : with.layers()) {
            if (std::find(theirs.begin(), theirs.end(), name) != theirs.end()) continue;
            throw badInput(
                "{}: has the channel {}, {} has not; render all parts with --aovs, or none",
                with.name(), name, without.name());
        }
    };
    refuseFirstOf(file, first);
    refuseFirstOf(first, file);
}

void requireDisjoint(std::span<const FilmFile> files)
{
    std::vector<std::pair<SampleRange, const FilmFile*>> ranges;
    for (const FilmFile& file : files) {
        for (const SampleRange& range : file.label.ranges) ranges.emplace_back(range, &file);
    }
    // Files that have the same range keep their order.
    std::stable_sort(ranges.begin(), ranges.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (size_t i = 1; i < ranges.size(); i++) {
        const auto& [range, file] = ranges[i];
        const auto& [before, other] = ranges[i - 1];
        if (range.first >= before.end) continue;
        throw badInput("{} and {} both have the samples {}; each sample may be there once",
                       other->name(), file->name(),
                       rangeText({range.first, std::min(range.end, before.end)}));
    }
}

std::string someOf(SampleRanges ranges)
{
    constexpr size_t MOST = 8;
    const bool more = ranges.size() > MOST;
    if (more) ranges.resize(MOST);
    return rangesText(ranges) + (more ? " and more" : "");
}

FilmLabel labelOfAll(std::span<const FilmFile> files)
{
    FilmLabel label;
    for (const FilmFile& file : files) {
        label.ranges.insert(label.ranges.end(), file.label.ranges.begin(), file.label.ranges.end());
        label.totalSamples = std::max(label.totalSamples, file.label.totalSamples);
    }
    label.ranges = unionOf(label.ranges);
    return label;
}

void requireWhole(const FilmLabel& label, bool allowGaps)
{
    const SampleRanges gaps = gapsIn(label.ranges, label.totalSamples);
    if (gaps.empty()) return;
    if (!allowGaps) {
        throw badInput(
            "samples {} of {} are missing; render them with --sample-range {}, or do without "
            "them by --allow-gaps",
            someOf(gaps), label.totalSamples, rangeText(gaps[0]));
    }
    warn(fmt::format("samples {} of {} are missing; the picture is the mean of the others",
                     someOf(gaps), label.totalSamples));
}

/// Values of an attribute that differs from part to part: each once.
std::string allValues(std::span<const FilmFile> files, const std::string& name)
{
    std::set<std::string> values;
    for (const FilmFile& file : files) values.insert(file.attribute(name));
    return fmt::format("{}", fmt::join(values, "; "));
}

/// Why samples are missing: of the first part that says so.
std::string stoppedBy(std::span<const FilmFile> files, bool isWhole)
{
    for (const FilmFile& file : files) {
        const std::string& stopped = file.attribute("sahl.stopped");
        if (!isWhole && !stopped.empty() && stopped != "no") return stopped;
    }
    return "no";
}

ImageMetadata metadataOfAll(std::span<const FilmFile> files, const FilmLabel& label)
{
    ImageMetadata metadata;
    for (const auto& [name, value] : files[0].description.metadata) {
        if (!mayDiffer(name) && name != "sahl.film") metadata[name] = value;
    }
    const bool interrupted = std::any_of(files.begin(), files.end(), [](const FilmFile& file) {
        return file.attribute("sahl.interrupted") == "yes";
    });
    metadata["sahl.scene"] = files[0].attribute("sahl.scene");
    metadata["sahl.firstSample"] = std::to_string(label.ranges[0].first);
    metadata["sahl.sampleCount"] = std::to_string(samplesIn(label.ranges));
    metadata["sahl.passes"] = std::to_string(blocksIn(label.ranges));
    metadata["sahl.interrupted"] = interrupted && !label.isWhole() ? "yes" : "no";
    if (!files[0].attribute("sahl.stopped").empty()) metadata["sahl.stopped"] = stoppedBy(files, label.isWhole());
    metadata["sahl.device"] = allValues(files, "sahl.device");
    metadata["sahl.driver"] = allValues(files, "sahl.driver");
    return metadata;
}

std::vector<ImageChannel> readFirstHits(const FilmFile& file)
{
    const std::vector<std::string> names = file.layers();
    if (names.empty()) return {};
    const ExrPlanes planes = readExrPlanes(file.path, file.description, names);
    std::vector<ImageChannel> channels;
    for (size_t i = 0; i < names.size(); i++) {
        const std::span<const uint32_t> plane = planes.plane(i);
        channels.push_back({names[i], std::vector<float>(plane.size())});
        std::memcpy(channels.back().values.data(), plane.data(), plane.size_bytes());
    }
    return channels;
}

/// For the film, and at a time for the channels of a file or the pictures that are written.
void requireMergeMemory(const FilmFile& file)
{
    const uint64_t words = filmChannelNames().size() + 2 * file.layers().size() + 12;
    const uint64_t pixels = uint64_t{file.description.width} * file.description.height;
    requireMemory(filmBytes(file.description.width, file.description.height, file.replicateSize()) +
                      pixels * words * sizeof(uint32_t),
                  fmt::format("merging pictures of {} x {} pixels", file.description.width,
                              file.description.height),
                  "merge windows of it (--crop)");
}

}  // namespace

MergedFilm mergeFilms(std::vector<FilmFile> files, bool allowGaps)
{
    assert(!files.empty());
    for (const FilmFile& file : files) {
        requireSameSize(file, files[0]);
        requireSameSettings(file, files[0]);
        requireSameLayers(file, files[0]);
    }
    requireDisjoint(files);
    MergedFilm merged;
    merged.label = labelOfAll(files);
    requireWhole(merged.label, allowGaps);
    requireMergeMemory(files[0]);

    std::sort(files.begin(), files.end(), [](const FilmFile& a, const FilmFile& b) {
        return a.label.ranges[0] < b.label.ranges[0];
    });
    const ExrDescription& first = files[0].description;
    merged.metadata = metadataOfAll(files, merged.label);
    merged.place = first.place;
    merged.film = Film(first.width, first.height);
    merged.film.replicateSize = files[0].replicateSize();
    for (const FilmFile& file : files) addFilmOf(file, merged.film);
    merged.firstHits = readFirstHits(files[0]);
    return merged;
}

}  // namespace sahl
