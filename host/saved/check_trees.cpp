#include "saved/check_trees.h"

#include "bvh/box.h"
#include "saved/container.h"

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <set>
#include <vector>

namespace sahl {

namespace {

bool sameBits(const vec3& a, const vec3& b)
{
    return std::bit_cast<std::array<uint32_t, 3>>(a) == std::bit_cast<std::array<uint32_t, 3>>(b);
}

/// Numbers of which each is to be met once, all below their count.
class NumberCheck {
public:
    explicit NumberCheck(uint64_t count) : count_(count), seen_((count + 63) / 64) {}

    bool isNew(uint number)
    {
        if (number >= count_) return false;
        const uint64_t bit = uint64_t{1} << (number % 64);
        const bool fresh = (seen_[number / 64] & bit) == 0;
        seen_[number / 64] |= bit;
        return fresh;
    }

private:
    uint64_t count_;
    std::vector<uint64_t> seen_;
};

/// Walks down the tree without recursion, left before right. In a tree that the builder laid out,
/// nodes and primitives then come one after another, so each is met once and nothing can go round
/// in circles.
class TreeCheck {
public:
    TreeCheck(const std::string& file, const DeviceScene& scene) : file_(file), scene_(scene) {}

    /// The tree behind `root`, which owns the nodes and primitives from where the last one ended.
    /// Returns the number of its primitives.
    uint64_t walk(uint root)
    {
        const uint64_t before = primitives_;
        Box below;
        bool arrived = enter(root, below);
        while (!open_.empty()) {
            if (arrived) arrived = leaveChild(below);
            if (open_.empty()) break;
            if (!arrived) {
                const BvhNode& node = scene_.nodes[open_.back().node];
                arrived = enter(open_.back().second ? node.ref1 : node.ref0, below);
            }
        }
        return primitives_ - before;
    }

    /// From now on the trees are those of objects, in which no instances may be.
    void endWorld()
    {
        worldDepth_ = statistics.depth;
        inObjects_ = true;
    }

    /// How a root would be referred to that lies where the last tree ended.
    uint nextNode() const { return static_cast<uint>(nodes_); }
    uint nextPrimitive() const { return static_cast<uint>(primitives_); }

    void requireAllVisited() const
    {
        if (instancesSeen_ != scene_.instances.size()) {
            throw damaged(
                file_, "instances",
                fmt::format("the tree has {} of {}", instancesSeen_, scene_.instances.size()));
        }
        if (nodes_ == scene_.nodes.size() && primitives_ == scene_.primitives.size()) return;
        throw damaged(file_, "nodes",
                      fmt::format("the tree has {} nodes and {} primitives, the file {} and {}",
                                  nodes_, primitives_, scene_.nodes.size(),
                                  scene_.primitives.size()));
    }

    BvhStatistics statistics;

private:
    /// An inner node whose children are being visited.
    struct Open {
        uint node = 0;
        bool second = false;  ///< child 1 is next or under way
        Box box;              ///< of the children done
    };

    Error wrong(const std::string& finding) const
    {
        if (open_.empty()) return damaged(file_, "nodes", "the root: " + finding);
        return damaged(file_, "nodes",
                       fmt::format("child {} of node {}: {}", open_.back().second ? 1 : 0,
                                   open_.back().node, finding));
    }

    /// Visits what a reference names. Returns whether its box is known: that of a leaf.
    bool enter(uint ref, Box& box)
    {
        if (ref == REF_NONE) throw wrong("there is nothing");
        if ((ref & REF_LEAF) != 0) {
            box = leafBox(ref);
            return true;
        }
        if ((ref & REF_INSTANCE) != 0) {
            box = instanceBox(ref & ~REF_INSTANCE);
            return true;
        }
        if (ref != nodes_ || ref >= scene_.nodes.size()) {
            throw wrong(fmt::format("it refers to node {}; {} of {} is expected", ref, nodes_,
                                    scene_.nodes.size()));
        }
        const size_t above = inObjects_ ? worldDepth_ + 1 : 0;  // of the world, and the way back
        if (above + open_.size() >= MAX_STACK_SIZE) {
            throw wrong(fmt::format("the tree is deeper than {} nodes", MAX_STACK_SIZE));
        }
        nodes_++;
        open_.push_back({ref, false, {}});
        statistics.innerNodes = nodes_;
        statistics.depth = std::max(statistics.depth, static_cast<uint32_t>(above + open_.size()));
        return false;
    }

    /// Goes on from a child whose box is `below`. Returns whether that ended the node itself; its
    /// box is then in `below`.
    bool leaveChild(Box& below)
    {
        Open& open = open_.back();
        const BvhNode& node = scene_.nodes[open.node];
        const bool same = open.second
                              ? sameBits(below.lo, node.lo1) && sameBits(below.hi, node.hi1)
                              : sameBits(below.lo, node.lo0) && sameBits(below.hi, node.hi0);
        if (!same) throw wrong("its box is not that of what is below it");
        grow(open.box, below);
        if (!open.second) {
            open.second = true;
            return false;
        }
        below = open.box;
        open_.pop_back();
        return true;
    }

    Box instanceBox(uint index)
    {
        if (inObjects_) throw wrong("an instance inside the object of another");
        if (!instances_.isNew(index)) {
            throw wrong(fmt::format("instance {}; there are {}, and each is met once", index,
                                    scene_.instances.size()));
        }
        instancesSeen_++;
        return {scene_.instances[index].lo, scene_.instances[index].hi};
    }

    Box leafBox(uint ref)
    {
        const uint64_t first = (ref & ~REF_LEAF) >> LEAF_COUNT_BITS;
        const uint count = (ref & (MAX_LEAF_SIZE - 1)) + 1;
        if (first != primitives_ || first + count > scene_.primitives.size()) {
            throw wrong(
                fmt::format("a leaf of {} primitives from {} on; they should begin at {} and "
                            "there are {}",
                            count, first, primitives_, scene_.primitives.size()));
        }
        primitives_ += count;
        statistics.leaves++;
        statistics.largestLeaf = std::max(statistics.largestLeaf, count);
        Box box;
        for (const Primitive& primitive : scene_.primitives.subspan(first, count)) {
            grow(box, boxOf(primitive));
        }
        return box;
    }

    const std::string& file_;
    const DeviceScene& scene_;
    NumberCheck instances_{scene_.instances.size()};
    uint64_t instancesSeen_ = 0;
    bool inObjects_ = false;
    uint32_t worldDepth_ = 0;
    std::vector<Open> open_;  ///< from the root down
    uint64_t nodes_ = 0;      ///< visited, which is the number of the next one
    uint64_t primitives_ = 0;
};

/// The trees of a scene: how many primitives each has, in the order in which they lie in the file.
struct CheckedTrees {
    BvhStatistics statistics;
    uint64_t world = 0;
    std::map<uint, uint64_t> objects;  ///< by reference to their roots
    std::vector<uint64_t> inOrder;     ///< the objects', as they lie in the file
};

/// The object's tree that begins where the last one ended, which one of `roots` must name.
uint nextRoot(const std::string& file, const TreeCheck& check, const std::set<uint>& roots)
{
    const uint leaf = REF_LEAF | check.nextPrimitive() << LEAF_COUNT_BITS;
    const auto found = roots.lower_bound(leaf);
    if (found != roots.end() && *found < leaf + MAX_LEAF_SIZE) return *found;
    if (roots.contains(check.nextNode())) return check.nextNode();
    throw damaged(file, "instances",
                  fmt::format("none has its object's tree at node {}, primitive {}, where the one "
                              "before ends",
                              check.nextNode(), check.nextPrimitive()));
}

CheckedTrees walkTrees(const std::string& file, const DeviceScene& scene, uint rootRef)
{
    TreeCheck check(file, scene);
    if (scene.primitives.empty() != (rootRef == REF_NONE)) {
        throw damaged(file, "nodes", "there are primitives without a tree, or a tree without any");
    }
    CheckedTrees trees;
    if (rootRef != REF_NONE) trees.world = check.walk(rootRef);
    check.endWorld();
    std::set<uint> roots;
    for (const ObjectInstance& instance : scene.instances) roots.insert(instance.rootRef);
    if (!roots.empty()) check.statistics.depth++;
    while (!roots.empty()) {
        const uint root = nextRoot(file, check, roots);
        roots.erase(root);
        const uint64_t count = check.walk(root);
        trees.objects[root] = count;
        trees.inOrder.push_back(count);
    }
    check.requireAllVisited();
    trees.statistics = check.statistics;
    return trees;
}

/// Every primitive has a number of its own below the count of its tree's: it names hits and decides
/// ties, together with the numbers at which the instances begin.
void checkNumbers(const std::string& file, std::span<const Primitive> primitives, size_t first)
{
    NumberCheck numbers(primitives.size());
    for (size_t i = 0; i < primitives.size(); i++) {
        if (numbers.isNew(primitives[i].number)) continue;
        throw damaged(
            file, "primitives",
            fmt::format("primitive {}: its number {} is not below {} or is another one's, "
                        "too",
                        first + i, primitives[i].number, primitives.size()));
    }
}

/// Returns the number of primitives that rays see.
uint64_t checkNumbers(const std::string& file, const DeviceScene& scene, const CheckedTrees& trees)
{
    checkNumbers(file, scene.primitives.first(trees.world), 0);
    uint64_t first = trees.world;
    for (uint64_t count : trees.inOrder) {
        checkNumbers(file, scene.primitives.subspan(first, count), first);
        first += count;
    }
    uint64_t seen = trees.world;
    for (size_t i = 0; i < scene.instances.size(); i++) {
        if (scene.instances[i].firstNumber != seen) {
            throw damaged(file, "instances",
                          fmt::format("number {} counts its primitives from {}, not from {}", i,
                                      scene.instances[i].firstNumber, seen));
        }
        seen += trees.objects.at(scene.instances[i].rootRef);
        if (seen >= NO_HIT) throw damaged(file, "instances", "they show too many primitives");
    }
    return seen;
}

}  // namespace

BvhStatistics checkTrees(const std::string& file, const DeviceScene& scene, uint rootRef)
{
    CheckedTrees trees = walkTrees(file, scene, rootRef);
    trees.statistics.primitivesSeen = checkNumbers(file, scene, trees);
    return trees.statistics;
}

}  // namespace sahl
