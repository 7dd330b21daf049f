#include "saved/tree_assembly.h"

#include "util/error.h"

#include <algorithm>

namespace sahl {

void TreeAssembly::requireNoInstance(const Group& group)
{
    if (group.instance == NO_INSTANCE) return;
    throw badInput("something beside an instance, which needs a group of its own");
}

void TreeAssembly::openGroup()
{
    if (!open_.empty()) {
        Group& parent = open_.back();
        if (parent.leaves > 0) throw badInput("a group in a group of leaves");
        requireNoInstance(parent);
        if (parent.children == 2) throw badInput("a third group in a group; there must be two");
        if (open_.size() > MAX_STACK_SIZE) {
            throw badInput("groups nested deeper than {} levels", MAX_STACK_SIZE);
        }
        if (parent.children == 0) {
            parent.node = static_cast<uint>(bvh.nodes.size());
            bvh.nodes.emplace_back();
        }
        parent.children++;
    }
    open_.emplace_back();
}

void TreeAssembly::addLeaf(const Primitive& primitive)
{
    Group& group = open_.back();
    if (group.children > 0) throw badInput("a leaf in a group of groups");
    requireNoInstance(group);
    if (group.leaves == MAX_LEAF_SIZE) {
        throw badInput("a group of more than {} leaves", MAX_LEAF_SIZE);
    }
    if (bvh.primitives.size() == MAX_PRIMITIVES) {
        throw badInput("more than {} leaves", MAX_PRIMITIVES);
    }
    group.leaves++;
    grow(group.box, boxOf(primitive));
    bvh.primitives.push_back(primitive);
}

void TreeAssembly::addInstance(uint index, const Box& box, double cost)
{
    Group& group = open_.back();
    if (group.children > 0 || group.leaves > 0) {
        throw badInput("an instance in a group of others; it needs a group of its own");
    }
    requireNoInstance(group);
    group.instance = index;
    group.box = box;
    group.primitives = halfArea(box) * cost;
}

uint TreeAssembly::refOf(const Group& group) const
{
    if (group.children > 0) return group.node;
    if (group.instance != NO_INSTANCE) return REF_INSTANCE | group.instance;
    if (group.leaves == 0) return REF_NONE;
    const uint first = static_cast<uint>(bvh.primitives.size()) - group.leaves;
    return REF_LEAF | (first << LEAF_COUNT_BITS) | (group.leaves - 1);
}

void TreeAssembly::finishLeaf(Group& group)
{
    group.primitives = halfArea(group.box) * group.leaves;
    bvh.statistics.leaves++;
    bvh.statistics.largestLeaf = std::max(bvh.statistics.largestLeaf, group.leaves);
}

void TreeAssembly::addChild(Group& parent, const Group& child, uint ref)
{
    BvhNode& node = bvh.nodes[parent.node];
    if (parent.children == 1) {
        node.lo0 = child.box.lo;
        node.hi0 = child.box.hi;
        node.ref0 = ref;
    } else {
        node.lo1 = child.box.lo;
        node.hi1 = child.box.hi;
        node.ref1 = ref;
    }
    grow(parent.box, child.box);
    parent.depth = std::max(parent.depth, child.depth + 1);
    parent.boxes += child.boxes;
    parent.primitives += child.primitives;
}

void TreeAssembly::closeGroup()
{
    Group group = open_.back();
    if (group.children == 1) throw badInput("a group of a single group; there must be two");
    const bool isNothing =
        group.children == 0 && group.leaves == 0 && group.instance == NO_INSTANCE;
    if (isNothing && open_.size() > 1) throw badInput("a group of nothing");
    if (group.leaves > 0) finishLeaf(group);
    if (group.children > 0) group.boxes += 2 * halfArea(group.box);
    open_.pop_back();

    const uint ref = refOf(group);
    if (!open_.empty()) {
        addChild(open_.back(), group, ref);
        return;
    }
    bvh.rootRef = ref;
    bvh.statistics.innerNodes = bvh.nodes.size();
    bvh.statistics.depth = group.depth;
    const double area = isNothing ? 0 : halfArea(group.box);
    bvh.statistics.sahCost = area > 0 ? (group.boxes + group.primitives) / area : 0;
}

}  // namespace sahl
