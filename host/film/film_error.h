// How far a film may be from the picture it converges to.
#pragma once

#include "film/film.h"

namespace sahl {

/// One standard error of a pixel's luminance, root mean square over all pixels, relative to the mean
/// luminance of the picture. From the spread of the single samples. 0 with fewer than 2 samples a
/// pixel or for a black picture.
double relativeError(const Film& film);

}  // namespace sahl
