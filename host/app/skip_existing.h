// --skip-existing: parts that an earlier run finished are not rendered again.
#pragma once

#include "film/film_file.h"

namespace sahl {

/// What a finished part is.
struct ExpectedPart {
    ImageMetadata settings;  ///< attributes that it has
    FilmLabel label;
    uint32_t width = 0, height = 0;
    ImagePlace place;
    bool firstHits = false;  ///< has the layers of what camera rays meet
};

/// What keeps the file from being that part, whole and unaltered, in words; "" when nothing does.
std::string differenceFrom(const ExpectedPart& expected, const fs::path& path);

/// Whether all of the files are that part. Says so, or which is not and why.
bool areFinished(const std::vector<fs::path>& paths, const ExpectedPart& expected);

}  // namespace sahl
