// EXR files that carry the exact film of some of a picture's samples: what is written beside it,
// and reading it back. docs/exr.md describes the attributes for users.
#pragma once

#include "film/film.h"
#include "film/sample_ranges.h"
#include "image/exr_layers.h"

namespace sahl {

/// Which part of a picture a film is.
struct FilmLabel {
    SampleRanges ranges;
    uint32_t totalSamples = 0;  ///< of a pixel of the whole picture

    bool isWhole() const { return ranges == SampleRanges{{0, totalSamples}}; }
};

/// The attributes that say so.
ImageMetadata filmMetadata(const Film& film, const FilmLabel& label);

/// A file whose head has been read and found right.
struct FilmFile {
    fs::path path;
    ExrDescription description;
    FilmLabel label;
    Counters counters;
    uint64_t hash = 0;

    std::string name() const { return path.string(); }
    const std::string& attribute(const std::string& name) const;  ///< "" where there is none
    uint32_t replicateSize() const;                               ///< of its sampler
    std::vector<std::string> layers() const;  ///< names of the channels of what camera rays met
};

/// Reads what stands before the pixels. Throws badInput, naming the attribute or channel and what
/// it should be, for a file without a film and for one that cannot be added to another.
FilmFile openFilmFile(const fs::path& path);

/// Adds the film of a file to one of the same size. Throws badInput when it is not what the head
/// says; `film` is of no use then.
void addFilmOf(const FilmFile& file, Film& film);

}  // namespace sahl
