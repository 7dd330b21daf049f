// The pictures that go along with the light: what camera rays met, sample counts, variance.
// docs/exr.md describes the layers for users.
#pragma once

#include "film/film.h"

#include <span>

namespace sahl {

/// Channels of an EXR file for `hits`, one a pixel, of which each holds `samples` samples:
///   albedo.R/G/B              mean over the samples, black where a sample met nothing
///   normal.X/Y/Z              mean shading normal, unit, on the viewer's side; 0 without a hit
///   geometricNormal.X/Y/Z     likewise
///   depth.Z                   mean distance along the rays that hit [m]; 0 without a hit
///   position.X/Y/Z            mean hit point, world space [m]; 0 without a hit
///   objectId.Y, materialId.Y  of the pixel's first sample, counted from 1; 0 without a hit
///   objectStarts  number of each object's first primitive, ascending
std::vector<ImageChannel> firstHitChannels(std::span<const FirstHits> hits, uint32_t samples,
                                           std::span<const uint32_t> objectStarts);

/// What the film knows of each pixel:
///   samples.Y         number of samples
///   variance.Y        of the mean luminance, estimated from the spread of the replicates; 0 with fewer than 2
///   error.Y           one standard error of the luminance by that, relative: see pixelErrors(); 0 with
///                     fewer than 2 replicates
///   nodeVisits.Y      inner nodes that the rays of all samples visited; a visit is two box tests, one of a
///                     wide node counts as two
///   primitiveTests.Y  triangles and spheres that they were tested against
std::vector<ImageChannel> statisticsChannels(const Film& film);

}  // namespace sahl
