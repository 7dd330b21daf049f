// Whether two pictures were made with the same random numbers, by what their files say.
#pragma once

#include "image/image.h"

namespace sahl {

enum class Correlation {
    none,      ///< other seeds, other samples, or files that do not say
    possible,  ///< the same random numbers in scenes of different names
    certain,   ///< equal seed, sampler and scene, and samples in common
};

Correlation correlationOf(const ImageMetadata& a, const ImageMetadata& b);

}  // namespace sahl
