// Polygons with any number of corners, cut into triangles.
#pragma once

#include "shared/interop.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace sahl {

/// Cuts a polygon into corners.size() - 2 triangles of corner numbers, same winding. Convex
/// polygons become a fan around corner 0; others lose an ear at a time, up to MAX_EARS corners,
/// above which they become a fan too. `corners` in order around the polygon, at least 3.
///   isFan  set to true when a polygon that is not convex had to become a fan
std::vector<std::array<uint32_t, 3>> triangulate(std::span<const vec3> corners, bool& isFan);

/// Cutting ears takes time proportional to the cube of the number of corners at worst.
constexpr size_t MAX_EARS = 400;

}  // namespace sahl
