// What is measured: generated scenes, so that nobody needs a file, and those that the user names.
#pragma once

#include "app/bench/bench.h"
#include "scene/mesh.h"

namespace sahl {

/// A closed torus with waves of three sizes, about `triangles` of them: a thing seen from outside, most of
/// whose scattered rays leave.
Mesh makeWavyTorus(uint32_t triangles);

/// A courtyard open to the sky between two storeys of columns, about `triangles` of them: an inside, in
/// which a path is scattered many times.
Mesh makeCourtyard(uint32_t triangles);

/// Grey lambert (0.7) under white light from everywhere that is found by scattered rays alone, at most 6
/// scatterings, no roulette, size x size pixels: what renderers are compared by.
void makeCommonWork(Scene& scene, uint32_t size, uint32_t spp);

/// The torus or the courtyard as common work.
Scene torusScene(uint32_t triangles, uint32_t size, uint32_t spp);
Scene courtyardScene(uint32_t triangles, uint32_t size, uint32_t spp);

/// options.scenes, or without any the torus and the courtyard, as common work seen from their own
/// cameras. Throws badInput for scenes with instances, whose hits have no normals of their own here.
std::vector<Scene> commonScenes(const BenchOptions& options);

}  // namespace sahl
