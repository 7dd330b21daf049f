// Films of parts of a picture, added up to the film of all of it: the bits of one run, whatever the
// order of the parts.
#pragma once

#include "film/film_file.h"

namespace sahl {

struct MergedFilm {
    Film film;
    FilmLabel label;
    ImageMetadata metadata;  ///< as one run has them, without those of the label
    ImagePlace place;
    std::vector<ImageChannel> firstHits;  ///< what camera rays met, where the parts have that
};

/// Adds the films up, one file in memory at a time. Throws badInput, naming the files, what differs
/// and both values, unless all are parts of one picture and no two have a sample in common; also
/// when a sample is missing, unless `allowGaps`. Throws deviceLost when there is no memory for the
/// film and a file.
MergedFilm mergeFilms(std::vector<FilmFile> files, bool allowGaps);

}  // namespace sahl
