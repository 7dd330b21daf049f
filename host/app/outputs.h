// The pictures that a command writes.
#pragma once

#include "app/tone_options.h"
#include "film/film.h"
#include "util/files.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sahl {

struct OutputOptions {
    std::vector<fs::path> paths;  ///< .exr, .pfm (linear) or .png (tone mapped)
    ToneOptions tone;
    bool firstHits = false;  ///< albedo, normals, depth and so on as layers of EXR files
    std::optional<ImagePlace> place;  ///< of a window of the picture, told by EXR files
    bool film = false;                ///< the exact film as channels of EXR files
};

/// Whether the name ends in .exr, in capitals or not.
bool isExrPath(const fs::path& path);

/// Refuses pictures that cannot be written, before anything is read or rendered: unknown extensions
/// (usage), unwritable files (cannotWrite).
void checkPicturePaths(const std::vector<fs::path>& paths);

/// Refuses `path` unless it ends in .png (usage), cannot be written (cannotWrite), or is one of
/// `others` (usage). `option` is what it was given by.
void checkPngPath(const std::string& option, const fs::path& path, const std::vector<fs::path>& others);

/// Refuses outputs that are files which were read so far: writing would destroy them (usage).
void refuseToReplaceInputs(const std::vector<fs::path>& outputs);

/// Writes a picture, in the format that the extension names.
///   channels, integers  beside the picture, in an EXR only
void writeImage(const Image& image, const OutputOptions& options, const fs::path& path,
                const ImageMetadata& metadata, std::span<const ImageChannel> channels = {},
                std::span<const IntegerChannel> integers = {});

/// Writes the film's mean picture to every path, each file complete or not at all. When one fails
/// the others are still written; then the first failure is thrown. A linear picture that none of
/// them holds is then put into the folder for temporary files, and the failure's text says so.
void writeOutputs(const Film& film, const OutputOptions& options, const ImageMetadata& metadata,
                  std::span<const ImageChannel> channels);

/// The same for a picture that is not finished: nothing is rescued.
void writePartialOutputs(const Film& film, const OutputOptions& options,
                         const ImageMetadata& metadata, std::span<const ImageChannel> channels);

}  // namespace sahl
