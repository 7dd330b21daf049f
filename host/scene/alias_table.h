// Alias tables: one of n things is chosen by its weight in constant time (AliasEntry in
// shared/scene_types.h says how an entry is read).
#pragma once

#include "shared/scene_types.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sahl {

/// Masses of the things that are chosen among: integers that add up to n 2^32, in proportion to the
/// weights up to rounding. Only a weight of 0 has a mass of 0. Chances are masses over n 2^32.
///   weights  finite, none negative, not all 0
std::vector<uint64_t> massesOf(std::span<const double> weights);

/// The table that chooses thing i with a chance of exactly masses[i] / (n 2^32), given uniform
/// random numbers without end; pathtrace/light_choice.glsl has 56 bits of one. Walker 1977, "An
/// Efficient Method for Generating Discrete Random Variables with General Distributions", ACM TOMS
/// 3(3); filled in one sweep as by Huebschle-Schneider and Sanders 2022, "Parallel Weighted Random
/// Sampling", ACM TOMS 48(3).
std::vector<AliasEntry> makeAliasTable(std::span<const uint64_t> masses);

}  // namespace sahl
