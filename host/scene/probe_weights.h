// What light sampling chooses a probe's texels by.
#pragma once

#include "shared/scene_types.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sahl {

/// Whether all texels of the probe are the same: the light from everywhere.
bool isConstant(const Probe& probe, std::span<const vec4> texels);

/// How bright the texels are for whom looks them up, one number for each: luminance times the solid
/// angle of its share of the picture [W m^-2]. They add up to the integral of the luminance over
/// all directions, nearly.
///   texels  of all probes
std::vector<double> texelPowers(const Probe& probe, std::span<const vec4> texels);

/// Sum of the texels' powers times the directions that they are seen in, in the world.
glm::dvec3 powerMoment(const Probe& probe, std::span<const double> powers);

/// Writes into the fourth component of each texel of the probe by how much it is likelier to be
/// chosen than it would be by chance alone: looked up like the colours, these are the density with
/// which points of the picture (of area 1) are sampled.
///   masses  of its texels, see massesOf()
void writeTexelWeights(const Probe& probe, std::span<const uint64_t> masses,
                       std::span<vec4> texels);

/// Whether the texels have these weights already.
bool hasTexelWeights(const Probe& probe, std::span<const uint64_t> masses,
                     std::span<const vec4> texels);

}  // namespace sahl
