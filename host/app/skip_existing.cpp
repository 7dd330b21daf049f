#include "app/skip_existing.h"

#include "util/error.h"
#include "util/messages.h"

namespace sahl {

namespace {

std::string differenceOfHead(const ExpectedPart& expected, const FilmFile& file)
{
    const ExrDescription& head = file.description;
    if (head.width != expected.width || head.height != expected.height ||
        head.place != expected.place)
        return fmt::format("has another size or window: {} x {} pixels", head.width, head.height);
    for (const auto& [name, value] : expected.settings) {
        if (file.attribute(name) != value)
            return fmt::format("{} is \"{}\", not \"{}\"", name, file.attribute(name), value);
    }
    if (file.label.ranges != expected.label.ranges ||
        file.label.totalSamples != expected.label.totalSamples) {
        return fmt::format("has the samples {} of {}, not {} of {}", rangesText(file.label.ranges),
                           file.label.totalSamples, rangesText(expected.label.ranges),
                           expected.label.totalSamples);
    }
    if (file.layers().empty() == expected.firstHits)
        return "has not the layers of --aovs as asked for";
    return "";
}

}  // namespace

std::string differenceFrom(const ExpectedPart& expected, const fs::path& path)
{
    std::error_code ignored;
    if (!fs::exists(path, ignored)) return "is not there yet";
    try {
        const FilmFile file = openFilmFile(path);
        const std::string difference = differenceOfHead(expected, file);
        if (!difference.empty()) return difference;
        Film film(expected.width, expected.height);
        addFilmOf(file, film);
        return "";
    } catch (const Error& error) {
        if (error.kind != ErrorKind::badInput) throw;
        return fmt::format("cannot be used ({})", error.what());
    }
}

bool areFinished(const std::vector<fs::path>& paths, const ExpectedPart& expected)
{
    for (const fs::path& path : paths) {
        const std::string difference = differenceFrom(expected, path);
        if (difference.empty()) continue;
        if (!isQuiet()) say("{}: {}; rendering it\n", path.string(), difference);
        return false;
    }
    for (const fs::path& path : paths) {
        if (isQuiet()) continue;
        say("{}: is finished already; not rendered again\n", path.string());
        answer("{}\n", path.string());
    }
    return true;
}

}  // namespace sahl
