// The tree while it is being built: ranges of primitives, without boxes. flatten.cpp makes the
// device's nodes of it. Read by the files of this folder only.
#pragma once

#include "bvh/box.h"
#include "bvh/bvh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sahl {

/// A subtree of n primitives owns 2n - 1 consecutive slots: its root, those of its left child,
/// those of its right child. So every thread knows where to write without asking the others, and
/// the left child of slot s is s + 1.
struct DraftNode {
    uint first = 0;  ///< its primitives are order[first .. first + count)
    uint count = 0;
    uint right = 0;  ///< slot of the right child; 0 for a leaf
};

struct Draft {
    std::vector<DraftNode> nodes;
    std::vector<uint> order;  ///< numbers of the primitives, leaf after leaf
};

/// Expected cost of a node and of a primitive for a ray that reaches them, relative to each other.
/// A node is one read of 64 bytes and two box tests of about 20 operations, a primitive one read of
/// 48 bytes and one test of about 40: near enough to equal on CPUs and GPUs alike.
constexpr double COST_NODE = 1.0;
constexpr double COST_PRIMITIVE = 1.0;

/// Primitives that fit below a node when at most `levels` inner nodes may follow one another.
inline uint64_t capacity(uint levels)
{
    return levels < 32 ? uint64_t{MAX_LEAF_SIZE} << levels : uint64_t{MAX_PRIMITIVES};
}

/// A way to divide a range of primitives in two.
struct Split {
    double cost = std::numeric_limits<double>::infinity();  ///< sum of half area times primitives
    int axis = 0;
    uint leftCount = 0;  ///< 0: no split found
    uint bin = 0;        ///< of the binned builder: first bin of the right side
};

/// Keeps `candidate` if it is cheaper, or as cheap and better balanced: where areas say nothing
/// (coincident primitives, a line of points) the tree stays shallow.
inline void keepBetter(Split& best, const Split& candidate, uint count)
{
    auto imbalance = [count](const Split& split) {
        int64_t difference = 2 * int64_t{split.leftCount} - int64_t{count};
        return difference < 0 ? -difference : difference;
    };
    bool cheaper = candidate.cost < best.cost;
    bool tie = candidate.cost == best.cost && imbalance(candidate) < imbalance(best);
    if (best.leftCount == 0 || cheaper || tie) best = candidate;
}

/// Whether both sides of a split fit into the `levels` inner nodes that may follow.
inline bool fits(uint leftCount, uint count, uint levels)
{
    return leftCount <= capacity(levels) && count - leftCount <= capacity(levels);
}

/// Range [first, first + count) of a draft's order, to become the subtree at `slot`.
struct Subtree {
    uint first = 0;
    uint count = 0;
    uint slot = 0;
    uint levels = MAX_STACK_SIZE;  ///< inner nodes that may still follow one another
};

inline Subtree leftOf(const Subtree& tree, uint leftCount)
{
    return {tree.first, leftCount, tree.slot + 1, tree.levels - 1};
}

inline Subtree rightOf(const Subtree& tree, uint leftCount)
{
    return {tree.first + leftCount, tree.count - leftCount, tree.slot + 2 * leftCount,
            tree.levels - 1};
}

/// The two builders. `boxes` is not empty; the result does not depend on `threads`. At most
/// `levels` inner nodes follow one another.
Draft buildSweep(std::span<const Box> boxes, uint levels, unsigned threads);
Draft buildBinned(std::span<const Box> boxes, uint levels, unsigned threads);

/// What a tree is over. In the draft the instances are numbered after the primitives.
struct TreeItems {
    std::span<const Primitive> primitives;
    std::span<const Box> instanceBoxes;
    std::span<const double> instanceCosts;  ///< expected tests of a ray that meets the box
};

/// The tree as the device reads it, with its statistics except `seconds` and `build` and without its
/// primitives, which the leaves take to be in the draft's order. An instance has no leaf but a reference
/// of its own. Boxes are made once more rather than kept: large scenes need the memory.
Bvh flatten(const Draft& draft, const TreeItems& items, unsigned threads);

/// A tree whose primitives are still elsewhere.
struct BareTree {
    Bvh bvh;                  ///< without primitives
    std::vector<uint> order;  ///< numbers of the primitives, leaf after leaf
};

/// Checks the items, picks the builder and flattens: one level of a scene's trees.
BareTree buildTree(const TreeItems& items, uint levels, BvhBuild build, unsigned threads);

/// Completes a tree with copies of its primitives.
Bvh withPrimitives(BareTree tree, std::span<const Primitive> primitives, unsigned threads);

}  // namespace sahl
