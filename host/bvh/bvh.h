// The bounding volume hierarchy: built on the host by the surface area heuristic, uploaded flat.
#pragma once

#include "shared/scene_types.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sahl {

enum class BvhBuild {
    automatic,  ///< sweep below 200,000 primitives, binned above
    sweep,      ///< every split on all three axes; then reinsertion, while it pays
    binned,     ///< 32 bins on each axis
    high,       ///< as automatic, then made better by reinsertion (bvh/reinsert.h)
};

struct BvhStatistics {
    uint64_t innerNodes = 0;
    uint64_t leaves = 0;
    uint32_t depth = 0;        ///< inner nodes on the longest way from the root to a leaf; with
                               ///< instances, of both levels and 1 for the step between them
    uint32_t largestLeaf = 0;  ///< primitives
    double sahCost = 0;        ///< expected box and primitive tests of a random ray that hits the
                               ///< root's box; 0 when that has no area
    uint64_t primitivesSeen = 0;  ///< by rays: those of an object once for each of its instances
    double seconds = 0;           ///< to build
    BvhBuild build = BvhBuild::sweep;
};

/// The tree, and the primitives in the order of its leaves. With instances (bvh/instances.h), the
/// world's tree and those of the objects one after the other.
struct Bvh {
    std::vector<BvhNode> nodes;
    std::vector<Primitive> primitives;
    std::vector<ObjectInstance> instances;
    uint rootRef = REF_NONE;
    BvhStatistics statistics;
};

/// Builds the tree. The result depends on the primitives and `build` alone, not on `threads`.
/// Depth is at most MAX_STACK_SIZE whatever the input (coincident primitives included).
/// Throws badInput above MAX_PRIMITIVES, for corners that are not finite, and for spheres whose
/// radius is not positive or whose box is not finite.
Bvh buildBvh(std::span<const Primitive> primitives, BvhBuild build, unsigned threads);

/// The same of primitives that nobody else needs: they are put in order where they are, which spares the
/// memory of a second array.
Bvh buildBvh(std::vector<Primitive>&& primitives, BvhBuild build, unsigned threads);

}  // namespace sahl
