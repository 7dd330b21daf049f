#include "app/outputs.h"

#include "film/film_channels.h"
#include "util/error.h"

#include <optional>
#include <random>

namespace sahl {

namespace {

std::string extensionOf(const fs::path& path)
{
    std::string extension = path.extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return extension;
}

using Integers = std::span<const IntegerChannel>;

/// Keeps the result of long work whose outputs failed. Returns what to tell the user.
std::string rescue(const Image& image, const OutputOptions& options, const ImageMetadata& metadata,
                   Integers film)
{
    std::error_code ignored;
    fs::path path = fs::temp_directory_path(ignored);
    path /= fmt::format("sahl-rescued-{:08x}.exr", std::random_device{}());
    try {
        writeFileAtomically(path, encodeExr(image, metadata, {}, options.place, film));
    } catch (const Error&) {
        return "";
    }
    return fmt::format("; the picture was saved as {}", path.string());
}

/// Writes to every path and returns the first failure.
std::optional<Error> writeEach(const Image& image, const OutputOptions& options,
                               const ImageMetadata& metadata,
                               std::span<const ImageChannel> channels, Integers film,
                               bool& linearWritten)
{
    std::optional<Error> failure;
    linearWritten = false;
    for (const fs::path& path : options.paths) {
        try {
            writeImage(image, options, path, metadata, channels, film);
            const bool holdsFilm = film.empty() || isExrPath(path);
            linearWritten = linearWritten || (extensionOf(path) != ".png" && holdsFilm);
        } catch (const Error& error) {
            if (!failure) failure = error;
        }
    }
    return failure;
}

std::vector<IntegerChannel> filmOf(const Film& film, const OutputOptions& options)
{
    return options.film ? filmChannels(film) : std::vector<IntegerChannel>();
}

}  // namespace

bool isExrPath(const fs::path& path)
{
    return extensionOf(path) == ".exr";
}

void checkPicturePaths(const std::vector<fs::path>& paths)
{
    for (const fs::path& path : paths) {
        std::string extension = extensionOf(path);
        if (extension != ".exr" && extension != ".png" && extension != ".pfm") {
            throw usageError(
                "output '{}': the name must end in .exr, .pfm (linear) or .png (tone mapped)",
                path.string());
        }
        requireWritable(path);
    }
}

void checkPngPath(const std::string& option, const fs::path& path, const std::vector<fs::path>& others)
{
    if (extensionOf(path) != ".png") {
        throw usageError("{} '{}': the name must end in .png", option, path.string());
    }
    for (const fs::path& other : others) {
        if (other.lexically_normal() != path.lexically_normal()) continue;
        throw usageError("{}: is written already; name another file for {}", path.string(), option);
    }
    requireWritable(path);
}

void refuseToReplaceInputs(const std::vector<fs::path>& outputs)
{
    for (const fs::path& output : outputs) {
        for (const fs::path& input : filesRead()) {
            std::error_code ignored;
            if (fs::equivalent(output, input, ignored)) {
                throw usageError(
                    "{}: is an input; writing it would destroy it; name another output",
                    output.string());
            }
        }
    }
}

void writeImage(const Image& image, const OutputOptions& options, const fs::path& path,
                const ImageMetadata& metadata, std::span<const ImageChannel> channels,
                std::span<const IntegerChannel> integers)
{
    std::string extension = extensionOf(path);
    if (extension == ".exr") {
        writeFileAtomically(path, encodeExr(image, metadata, channels, options.place, integers));
    } else if (extension == ".pfm") {
        writeFileAtomically(path, encodePfm(image));
    } else {
        writeFileAtomically(path, encodePng(toneMap(image, options.tone.map), metadata));
    }
}

void writeOutputs(const Film& film, const OutputOptions& options, const ImageMetadata& metadata,
                  std::span<const ImageChannel> channels)
{
    Image image = meanImage(film);
    const std::vector<IntegerChannel> integers = filmOf(film, options);
    bool linearWritten = false;
    std::optional<Error> failure =
        writeEach(image, options, metadata, channels, integers, linearWritten);
    if (!failure) return;
    std::string rescued = linearWritten ? "" : rescue(image, options, metadata, integers);
    throw Error(failure->kind, failure->what() + rescued);
}

void writePartialOutputs(const Film& film, const OutputOptions& options,
                         const ImageMetadata& metadata, std::span<const ImageChannel> channels)
{
    bool ignored = false;
    std::optional<Error> failure =
        writeEach(meanImage(film), options, metadata, channels, filmOf(film, options), ignored);
    if (failure) throw Error(*failure);
}

}  // namespace sahl
