// The trees of a scene with instances, read one by one, joined to the arrays that a device reads:
// to the bit those of buildTwoLevels().
#pragma once

#include "bvh/bvh.h"
#include "saved/tree_leaf.h"

#include <vector>

namespace sahl {

/// Appends the objects' trees to the world's, and gives the instances, in the order of their
/// numbers, what they have from their objects. The statistics become those of all.
///   instances  in any order; those of the world's tree, which have objects that exist
/// Throws badInput, without a place, when numbers of instances are missing or there twice, an
/// object is placed by no instance, or the two levels together are deeper than MAX_STACK_SIZE.
void joinTrees(Bvh& world, std::vector<Bvh> objects, std::vector<InstanceLeaf> instances);

}  // namespace sahl
