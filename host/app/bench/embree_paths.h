// A small path tracer for the common work, one ray at a time on Embree: what the traversal of others
// would make of the same paths.
#pragma once

#include "app/bench/embree.h"
#include "scene/scene.h"

namespace sahl {

struct EmbreePaths {
    double seconds = 0;
    double mean = 0;  ///< of the picture
    double raysPerSample = 0;
};

/// Renders a scene that makeCommonWork() made, at its size. Directions and sums are in float32, as ours.
EmbreePaths renderOnEmbree(const EmbreeScene& embree, const Scene& scene, uint32_t spp, unsigned threads);

}  // namespace sahl
