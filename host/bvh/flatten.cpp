// From ranges of primitives to the nodes that the device reads, in depth-first order, so that the
// left child follows its parent in memory and the bits do not depend on who built what when.
#include "bvh/draft.h"

#include <algorithm>

namespace sahl {
namespace {

/// A subtree after it has been written.
struct Flat {
    uint ref = REF_NONE;
    Box box;
    uint depth = 0;         ///< inner nodes on the longest way down
    double boxes = 0;       ///< half areas of all inner nodes, each times two children
    double primitives = 0;  ///< half areas of all leaves, each times its primitives
};

Flat flattenLeaf(const DraftNode& node, const Draft& draft, std::span<const Box> boxes, Bvh& bvh)
{
    Flat flat;
    flat.ref = REF_LEAF | (node.first << LEAF_COUNT_BITS) | (node.count - 1);
    for (uint i = 0; i < node.count; i++) grow(flat.box, boxes[draft.order[node.first + i]]);
    flat.primitives = halfArea(flat.box) * node.count;
    bvh.statistics.leaves++;
    bvh.statistics.largestLeaf = std::max(bvh.statistics.largestLeaf, node.count);
    return flat;
}

/// Recursion is as deep as the tree: at most MAX_STACK_SIZE.
Flat flattenSubtree(uint slot, const Draft& draft, std::span<const Box> boxes, Bvh& bvh)
{
    const DraftNode& node = draft.nodes[slot];
    if (node.right == 0) return flattenLeaf(node, draft, boxes, bvh);

    Flat flat;
    flat.ref = static_cast<uint>(bvh.nodes.size());
    bvh.nodes.emplace_back();
    const Flat left = flattenSubtree(slot + 1, draft, boxes, bvh);
    const Flat right = flattenSubtree(node.right, draft, boxes, bvh);
    bvh.nodes[flat.ref] = {left.box.lo,  left.ref, left.box.hi,  right.ref,
                           right.box.lo, 0,        right.box.hi, 0};
    grow(flat.box, left.box);
    grow(flat.box, right.box);
    flat.depth = 1 + std::max(left.depth, right.depth);
    flat.boxes = 2 * halfArea(flat.box) + left.boxes + right.boxes;
    flat.primitives = left.primitives + right.primitives;
    return flat;
}

uint64_t countInnerNodes(uint slot, const Draft& draft)
{
    const uint right = draft.nodes[slot].right;
    return right == 0 ? 0 : 1 + countInnerNodes(slot + 1, draft) + countInnerNodes(right, draft);
}

}  // namespace

Bvh flatten(const Draft& draft, std::span<const Primitive> primitives, std::span<const Box> boxes)
{
    Bvh bvh;
    bvh.statistics.innerNodes = countInnerNodes(0, draft);
    bvh.nodes.reserve(bvh.statistics.innerNodes);
    const Flat root = flattenSubtree(0, draft, boxes, bvh);
    bvh.rootRef = root.ref;
    bvh.statistics.depth = root.depth;
    const double area = halfArea(root.box);
    bvh.statistics.sahCost = area > 0 ? (root.boxes + root.primitives) / area : 0;

    bvh.primitives.reserve(primitives.size());
    for (uint number : draft.order) bvh.primitives.push_back(primitives[number]);
    return bvh;
}

}  // namespace sahl
