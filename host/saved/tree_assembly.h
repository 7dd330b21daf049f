// A tree put together from groups and leaves in the order in which nested text has them: to the bit
// what the builder's own layout would be.
#pragma once

#include "bvh/box.h"
#include "bvh/bvh.h"

#include <vector>

namespace sahl {

/// All functions throw badInput, without a place, for what cannot be a tree: groups that hold both
/// groups and leaves, more or less than two groups, no leaf or more than MAX_LEAF_SIZE, an instance
/// that is not alone, or that are nested deeper than MAX_STACK_SIZE. A tree of nothing is one group
/// of nothing.
class TreeAssembly {
public:
    void openGroup();
    void addLeaf(const Primitive& primitive);
    /// Number `index` of the instances. `cost` as costOfInstance() has it.
    void addInstance(uint index, const Box& box, double cost);
    void closeGroup();

    Bvh bvh;  ///< complete after the last closeGroup(), but for how it was built

private:
    struct Group {
        uint node = 0;      ///< where it goes, once it has a group in it
        uint children = 0;  ///< groups begun in it
        uint leaves = 0;
        uint instance = NO_INSTANCE;  ///< the one in it
        Box box;
        uint depth = 0;  ///< these three as in bvh/flatten.cpp
        double boxes = 0;
        double primitives = 0;
    };

    static void requireNoInstance(const Group& group);
    uint refOf(const Group& group) const;
    void finishLeaf(Group& group);
    void addChild(Group& parent, const Group& child, uint ref);

    std::vector<Group> open_;
};

}  // namespace sahl
