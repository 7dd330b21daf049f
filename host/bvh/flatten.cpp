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

/// What the functions below share.
struct Flattening {
    const Draft& draft;
    const TreeItems& items;
    std::span<const Box> boxes;
    Bvh& bvh;
};

void grow(Flat& parent, const Flat& left, const Flat& right)
{
    grow(parent.box, left.box);
    grow(parent.box, right.box);
    parent.depth = 1 + std::max(left.depth, right.depth);
    parent.boxes = 2 * halfArea(parent.box) + left.boxes + right.boxes;
    parent.primitives = left.primitives + right.primitives;
}

BvhNode nodeOver(const Flat& left, const Flat& right)
{
    return {left.box.lo, left.ref, left.box.hi, right.ref, right.box.lo, 0, right.box.hi, 0};
}

Flat flattenInstance(uint number, const Flattening& work)
{
    const uint index = number - static_cast<uint>(work.items.primitives.size());
    Flat flat;
    flat.ref = REF_INSTANCE | index;
    flat.box = work.boxes[number];
    flat.primitives = halfArea(flat.box) * work.items.instanceCosts[index];
    return flat;
}

/// The primitives order[first .. first + count) as one leaf. Those with an instance among them are
/// divided until it stands alone: what is inside it costs more than any node above it.
Flat flattenLeaf(uint first, uint count, const Flattening& work)
{
    const auto numbers = std::span(work.draft.order).subspan(first, count);
    const uint primitiveCount = static_cast<uint>(work.items.primitives.size());
    auto isInstance = [&](uint number) { return number >= primitiveCount; };
    Bvh& bvh = work.bvh;
    Flat flat;
    if (std::any_of(numbers.begin(), numbers.end(), isInstance)) {
        if (count == 1) return flattenInstance(numbers[0], work);
        flat.ref = static_cast<uint>(bvh.nodes.size());
        bvh.nodes.emplace_back();
        const Flat left = flattenLeaf(first, count / 2, work);
        const Flat right = flattenLeaf(first + count / 2, count - count / 2, work);
        bvh.nodes[flat.ref] = nodeOver(left, right);
        grow(flat, left, right);
        return flat;
    }
    flat.ref =
        REF_LEAF | (static_cast<uint>(bvh.primitives.size()) << LEAF_COUNT_BITS) | (count - 1);
    for (uint number : numbers) {
        grow(flat.box, work.boxes[number]);
        bvh.primitives.push_back(work.items.primitives[number]);
    }
    flat.primitives = halfArea(flat.box) * count;
    bvh.statistics.leaves++;
    bvh.statistics.largestLeaf = std::max(bvh.statistics.largestLeaf, count);
    return flat;
}

/// Recursion is as deep as the tree: at most MAX_STACK_SIZE.
Flat flattenSubtree(uint slot, const Flattening& work)
{
    const DraftNode& node = work.draft.nodes[slot];
    if (node.right == 0) return flattenLeaf(node.first, node.count, work);

    Bvh& bvh = work.bvh;
    Flat flat;
    flat.ref = static_cast<uint>(bvh.nodes.size());
    bvh.nodes.emplace_back();
    const Flat left = flattenSubtree(slot + 1, work);
    const Flat right = flattenSubtree(node.right, work);
    bvh.nodes[flat.ref] = nodeOver(left, right);
    grow(flat, left, right);
    return flat;
}

uint64_t countInnerNodes(uint slot, const Draft& draft)
{
    const uint right = draft.nodes[slot].right;
    return right == 0 ? 0 : 1 + countInnerNodes(slot + 1, draft) + countInnerNodes(right, draft);
}

}  // namespace

Bvh flatten(const Draft& draft, const TreeItems& items, std::span<const Box> boxes)
{
    Bvh bvh;
    bvh.nodes.reserve(countInnerNodes(0, draft));
    bvh.primitives.reserve(items.primitives.size());
    const Flat root = flattenSubtree(0, {draft, items, boxes, bvh});
    bvh.rootRef = root.ref;
    bvh.statistics.innerNodes = bvh.nodes.size();
    bvh.statistics.depth = root.depth;
    const double area = halfArea(root.box);
    bvh.statistics.sahCost = area > 0 ? (root.boxes + root.primitives) / area : 0;
    return bvh;
}

}  // namespace sahl
