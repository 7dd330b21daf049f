// From ranges of primitives to the nodes that the device reads, in depth-first order, so that the
// left child follows its parent in memory and the bits do not depend on who built what when. What a
// subtree takes up is counted before it is written, so that threads write side by side.
#include "bvh/draft.h"

#include "util/parallel.h"

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
    uint leaves = 0, largestLeaf = 0;
};

/// Primitives of a subtree that is the work of one thread.
constexpr uint PART_SIZE = 16384;

/// What a subtree takes up in the arrays: of what is written, or where it begins.
struct Extent {
    uint nodes = 0, primitives = 0;
};

/// What the functions below share.
struct Flattening {
    const Draft& draft;
    const TreeItems& items;
    Bvh& bvh;

    bool isInstance(uint number) const { return number >= items.primitives.size(); }
    bool hasInstance(std::span<const uint> numbers) const
    {
        return !items.instanceBoxes.empty() &&
               std::any_of(numbers.begin(), numbers.end(), [this](uint number) { return isInstance(number); });
    }
};

void grow(Flat& parent, const Flat& left, const Flat& right)
{
    grow(parent.box, left.box);
    grow(parent.box, right.box);
    parent.depth = 1 + std::max(left.depth, right.depth);
    parent.boxes = left.boxes + right.boxes + 2 * halfArea(parent.box);  // in the order of saved/tree_assembly.cpp
    parent.primitives = left.primitives + right.primitives;
    parent.leaves = left.leaves + right.leaves;
    parent.largestLeaf = std::max(left.largestLeaf, right.largestLeaf);
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
    flat.box = work.items.instanceBoxes[index];
    flat.primitives = halfArea(flat.box) * work.items.instanceCosts[index];
    return flat;
}

/// The primitives order[first .. first + count) as one leaf, from `at` on, which moves behind what is
/// written. Those with an instance among them are divided until it stands alone: what is inside it costs
/// more than any node above it.
Flat flattenLeaf(uint first, uint count, const Flattening& work, Extent& at)
{
    const auto numbers = std::span(work.draft.order).subspan(first, count);
    Bvh& bvh = work.bvh;
    Flat flat;
    if (work.hasInstance(numbers)) {
        if (count == 1) return flattenInstance(numbers[0], work);
        flat.ref = at.nodes++;
        const Flat left = flattenLeaf(first, count / 2, work, at);
        const Flat right = flattenLeaf(first + count / 2, count - count / 2, work, at);
        bvh.nodes[flat.ref] = nodeOver(left, right);
        grow(flat, left, right);
        return flat;
    }
    flat.ref = REF_LEAF | (at.primitives << LEAF_COUNT_BITS) | (count - 1);
    for (uint number : numbers) grow(flat.box, boxOf(work.items.primitives[number]));
    at.primitives += count;
    flat.primitives = halfArea(flat.box) * count;
    flat.leaves = 1;
    flat.largestLeaf = count;
    return flat;
}

/// Recursion is as deep as the tree: at most MAX_STACK_SIZE.
Flat flattenSubtree(uint slot, const Flattening& work, Extent& at)
{
    const DraftNode& node = work.draft.nodes[slot];
    if (node.right == 0) return flattenLeaf(node.first, node.count, work, at);

    Flat flat;
    flat.ref = at.nodes++;
    const Flat left = flattenSubtree(slot + 1, work, at);
    const Flat right = flattenSubtree(node.right, work, at);
    work.bvh.nodes[flat.ref] = nodeOver(left, right);
    grow(flat, left, right);
    return flat;
}

Extent extentOfLeaf(uint first, uint count, const Flattening& work)
{
    const auto numbers = std::span(work.draft.order).subspan(first, count);
    if (!work.hasInstance(numbers)) return {0, count};
    if (count == 1) return {0, 0};
    const Extent left = extentOfLeaf(first, count / 2, work);
    const Extent right = extentOfLeaf(first + count / 2, count - count / 2, work);
    return {1 + left.nodes + right.nodes, left.primitives + right.primitives};
}

Extent extentOf(uint slot, const Flattening& work)
{
    const DraftNode& node = work.draft.nodes[slot];
    if (node.right == 0) return extentOfLeaf(node.first, node.count, work);
    const Extent left = extentOf(slot + 1, work), right = extentOf(node.right, work);
    return {1 + left.nodes + right.nodes, left.primitives + right.primitives};
}

/// A subtree that one thread writes.
struct Part {
    uint slot = 0;
    Extent extent;
    Extent at;  ///< where it begins
    Flat flat;  ///< once it is written
};

/// All subtrees of at most PART_SIZE primitives, from left to right.
void collectParts(uint slot, const Draft& draft, std::vector<Part>& parts)
{
    const DraftNode& node = draft.nodes[slot];
    if (node.right == 0 || node.count <= PART_SIZE) {
        parts.push_back({slot, {}, {}, {}});
        return;
    }
    collectParts(slot + 1, draft, parts);
    collectParts(node.right, draft, parts);
}

/// Places the parts, from `part` on, and counts the nodes above them.
void placeParts(uint slot, const Draft& draft, std::vector<Part>& parts, size_t& part, Extent& at)
{
    if (parts[part].slot == slot) {
        parts[part].at = at;
        at.nodes += parts[part].extent.nodes;
        at.primitives += parts[part].extent.primitives;
        part++;
        return;
    }
    at.nodes++;
    placeParts(slot + 1, draft, parts, part, at);
    placeParts(draft.nodes[slot].right, draft, parts, part, at);
}

/// Writes the nodes above the parts.
Flat joinParts(uint slot, const Flattening& work, const std::vector<Part>& parts, size_t& part, uint& nextNode)
{
    if (parts[part].slot == slot) {
        nextNode += parts[part].extent.nodes;
        return parts[part++].flat;
    }
    Flat flat;
    flat.ref = nextNode++;
    const Flat left = joinParts(slot + 1, work, parts, part, nextNode);
    const Flat right = joinParts(work.draft.nodes[slot].right, work, parts, part, nextNode);
    work.bvh.nodes[flat.ref] = nodeOver(left, right);
    grow(flat, left, right);
    return flat;
}

}  // namespace

Bvh flatten(const Draft& draft, const TreeItems& items, unsigned threads)
{
    Bvh bvh;
    const Flattening work = {draft, items, bvh};
    std::vector<Part> parts;
    collectParts(0, draft, parts);
    parallelFor(parts.size(), threads, [&](size_t i) { parts[i].extent = extentOf(parts[i].slot, work); });
    Extent all;
    size_t part = 0;
    placeParts(0, draft, parts, part, all);
    bvh.nodes.resize(all.nodes);
    parallelFor(parts.size(), threads, [&](size_t i) {
        Extent at = parts[i].at;
        parts[i].flat = flattenSubtree(parts[i].slot, work, at);
    });
    uint nextNode = 0;
    part = 0;
    const Flat root = joinParts(0, work, parts, part, nextNode);
    bvh.rootRef = root.ref;
    bvh.statistics.innerNodes = bvh.nodes.size();
    bvh.statistics.leaves = root.leaves;
    bvh.statistics.largestLeaf = root.largestLeaf;
    bvh.statistics.depth = root.depth;
    const double area = halfArea(root.box);
    bvh.statistics.sahCost = area > 0 ? (root.boxes + root.primitives) / area : 0;
    return bvh;
}

}  // namespace sahl
