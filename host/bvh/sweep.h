// The sweep builder on a part of a scene, for the binned builder's lower levels.
#pragma once

#include "bvh/draft.h"

#include <array>

namespace sahl {

/// What all parts of a build share. Parts write to disjoint elements.
struct SweepShared {
    std::span<const Box> boxes;  ///< by number of the primitive
    std::span<uint8_t> onLeft;   ///< by number of the primitive: side of the current split
    std::span<DraftNode> nodes;  ///< by slot
};

/// The primitives of one subtree; all spans have its length.
struct SweepRange {
    std::array<std::span<uint>, 3> sorted;  ///< by centre along each axis, ties by number
    std::span<uint> scratch;
    std::span<double> areas;  ///< scratch
};

/// Builds a subtree down to its leaves. Afterwards range.sorted[0] is in the order of the leaves.
/// Returns its cost: half areas times COST_NODE or COST_PRIMITIVE.
double sweepSubtree(const SweepShared& shared, const SweepRange& range, const Subtree& tree);

/// `numbers` (ascending) into `sorted`, by centre of the box along `axis`, ties by number.
void sortByCentre(std::span<const Box> boxes, std::span<const uint> numbers, int axis,
                  std::span<uint> sorted);

}  // namespace sahl
