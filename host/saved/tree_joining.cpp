#include "saved/tree_joining.h"

#include "bvh/instances.h"
#include "util/error.h"

#include <algorithm>

namespace sahl {

namespace {

void requireEachNumberOnce(std::span<const InstanceLeaf> sorted)
{
    for (size_t i = 0; i < sorted.size(); i++) {
        if (sorted[i].number == i) continue;
        if (i > 0 && sorted[i].number == sorted[i - 1].number)
            throw badInput("two instances have the number {}", sorted[i].number);
        throw badInput("no instance has the number {}; the {} instances are to count from 0 on", i,
                       sorted.size());
    }
}

void requireAllPlaced(size_t objectCount, std::span<const InstanceLeaf> instances)
{
    std::vector<bool> placed(objectCount);
    for (const InstanceLeaf& leaf : instances) placed[leaf.object] = true;
    const auto idle = std::find(placed.begin(), placed.end(), false);
    if (idle == placed.end()) return;
    throw badInput("no instance places objects[{}]; leave it out", idle - placed.begin());
}

void requireRoomOnStack(const Bvh& world, std::span<const Bvh> objects)
{
    for (size_t i = 0; i < objects.size(); i++) {
        const uint32_t outer = world.statistics.depth, inner = objects[i].statistics.depth;
        if (outer + 1 + inner <= MAX_STACK_SIZE) continue;
        throw badInput(
            "the trees of \"root\" ({} nodes deep) and of objects[{}] ({}) together, with 1 "
            "for the step between them, are deeper than {}",
            outer, i, inner, MAX_STACK_SIZE);
    }
}

}  // namespace

void joinTrees(Bvh& world, std::vector<Bvh> objects, std::vector<InstanceLeaf> instances)
{
    world.statistics.primitivesSeen = world.primitives.size();
    std::sort(instances.begin(), instances.end(),
              [](const InstanceLeaf& a, const InstanceLeaf& b) { return a.number < b.number; });
    requireEachNumberOnce(instances);
    requireAllPlaced(objects.size(), instances);
    requireRoomOnStack(world, objects);
    if (objects.empty()) return;
    const std::vector<uint> roots = appendObjects(objects, world);
    for (InstanceLeaf& leaf : instances) {
        leaf.instance.rootRef = roots[leaf.object];
        // Too large a sum is refused by checkArrays().
        leaf.instance.firstNumber = static_cast<uint>(world.statistics.primitivesSeen);
        world.statistics.primitivesSeen += objects[leaf.object].primitives.size();
        world.instances.push_back(leaf.instance);
    }
}

}  // namespace sahl
