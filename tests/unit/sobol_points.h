// What tests of the samplers `sobol` and `sobol64` share: cells of the unit cube and the points in them.
#pragma once

#include "reference/kernel.h"

#include <array>
#include <cmath>
#include <set>
#include <span>

namespace sahl {

/// Samples of a block, N of them, that begins at block * N.
template <size_t N>
std::array<vec4, N> samplesOfBlock(reference::Kernel<>& kernel, uint pixel, uint block, uint dimension)
{
    std::array<vec4, N> points;
    for (uint i = 0; i < N; i++) points[i] = kernel.random4(pixel, block * uint(N) + i, dimension);
    return points;
}

/// Cells of 2^cuts[c] equal parts along each axis that hold a point.
inline size_t cellsMet(std::span<const vec4> points, const std::array<int, 4>& cuts)
{
    std::set<std::array<int, 4>> cells;
    for (const vec4& point : points) {
        std::array<int, 4> cell;
        for (int c = 0; c < 4; c++) cell[size_t(c)] = int(std::ldexp(point[c], cuts[size_t(c)]));
        cells.insert(cell);
    }
    return cells.size();
}

/// Mean of (u - 1/2) over the samples of a block.
inline vec4 meanOf(std::span<const vec4> points)
{
    vec4 sum(0);
    for (const vec4& point : points) sum += point - 0.5f;
    return sum / float(points.size());
}

}  // namespace sahl
