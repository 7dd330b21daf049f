// What every wide tree must be, whatever the binary one: it encloses, reaches everything once, and
// says how much may wait on the stack.
#include "bvh/box.h"
#include "bvh/instances.h"
#include "bvh/widen.h"
#include "support/soups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace sahl {
namespace {

using testing::addSphere;
using testing::addTriangle;
using testing::Random;
using testing::randomSoup;

/// A box in the numbers of double, where the planes of a grid are exact.
struct DoubleBox {
    glm::dvec3 lo = glm::dvec3(INFINITY), hi = glm::dvec3(-INFINITY);
};

/// The tree as the text reads it, walked and checked.
class Walk {
public:
    Walk(const WideTrees& wide, std::span<const Primitive> primitives)
        : wide_(wide),
          primitives_(primitives),
          seen_(primitives.size(), 0),
          visited_(wide.nodes.size(), 0)
    {
    }

    /// What waits at most: references, or nodes of which children wait.
    struct Waiting {
        uint references = 0, groups = 0;
    };

    /// Returns the box of all primitives below, and what waits.
    Box visit(uint ref, vec3 gridAt, uint gridScale, Waiting& waiting)
    {
        waiting = {};
        if ((ref & REF_NOT_INNER) != 0) return visitLeaf(ref);
        visited_.at(ref & WIDE_INDEX)++;
        const WideNode& node = wide_.nodes[ref & WIDE_INDEX];
        Box all;
        uint children = 0;
        Waiting deepest;
        for (int i = 0; i < 4; i++) {
            if (node.refs[i] == REF_NONE) break;  // children come first
            children++;
            Waiting below;
            const Box box = visit(node.refs[i], gridAt, gridScale, below);
            deepest.references = std::max(deepest.references, below.references);
            deepest.groups = std::max(deepest.groups, below.groups);
            outside += !encloses(boxOnGrid(node, i, gridAt, gridScale), box);
            grow(all, box);
        }
        if (children < 2) throw std::runtime_error("a node of fewer than two children");
        if (ref >> WIDE_CHILDREN_SHIFT != children - 1)
            throw std::runtime_error("a reference that miscounts the children");
        waiting = {deepest.references + children - 1, deepest.groups + 1};
        return all;
    }

    bool everythingOnce() const
    {
        const auto once = [](int count) { return count == 1; };
        return std::ranges::all_of(seen_, once) && std::ranges::all_of(visited_, once);
    }

    uint64_t outside = 0;

private:
    static DoubleBox boxOnGrid(const WideNode& node, int child, vec3 gridAt, uint gridScale)
    {
        const uint words[3] = {node.x[child], node.y[child], node.z[child]};
        DoubleBox box;
        for (int axis = 0; axis < 3; axis++) {
            const int step =
                static_cast<int>((gridScale >> 8 * axis) & 0xff) - static_cast<int>(GRID_BIAS);
            const auto planeOf = [&](uint q) { return std::ldexp(double{gridAt[axis]} + q, step); };
            box.lo[axis] = planeOf(words[axis] & 0xffff);
            box.hi[axis] = planeOf(words[axis] >> 16);
        }
        return box;
    }

    static bool encloses(const DoubleBox& outer, const Box& inner)
    {
        bool result = true;
        for (int axis = 0; axis < 3; axis++)
            result = result && outer.lo[axis] <= double{inner.lo[axis]} &&
                     outer.hi[axis] >= double{inner.hi[axis]};
        return result;
    }

    Box visitLeaf(uint ref)
    {
        if ((ref & REF_LEAF) == 0) throw std::runtime_error("neither a node nor a leaf");
        const uint first = (ref & ~REF_LEAF) >> LEAF_COUNT_BITS;
        Box box;
        for (uint i = first; i <= first + (ref & (MAX_LEAF_SIZE - 1)); i++) {
            seen_.at(i)++;
            grow(box, boxOf(primitives_[i]));
        }
        return box;
    }

    const WideTrees& wide_;
    std::span<const Primitive> primitives_;
    std::vector<int> seen_, visited_;
};

void expectSound(const std::vector<Primitive>& primitives, double reach)
{
    const Bvh bvh = buildBvh(primitives, BvhBuild::sweep, 1);
    const WideTrees wide = widen(bvh.nodes, {}, bvh.rootRef, reach);
    ASSERT_FALSE(wide.nodes.empty());
    Walk walk(wide, bvh.primitives);
    Walk::Waiting waiting;
    walk.visit(wide.rootRef, wide.gridAt, wide.gridScale, waiting);
    EXPECT_EQ(walk.outside, 0u);
    EXPECT_TRUE(walk.everythingOnce());
    EXPECT_EQ(wide.worstPending, waiting.references);
    EXPECT_EQ(wide.worstGroups, waiting.groups);
    EXPECT_LT(wide.nodes.size(), bvh.nodes.size());
}

std::vector<Primitive> moved(std::vector<Primitive> primitives, float scale, vec3 offset)
{
    for (Primitive& p : primitives) {
        p.p0 = p.p0 * scale + offset;
        p.p1 = p.shape == SHAPE_SPHERE ? p.p1 * scale : p.p1 * scale + offset;
        p.p2 = p.p2 * scale + offset;
    }
    return primitives;
}

/// Triangles and spheres of very different sizes.
std::vector<Primitive> anything(uint count)
{
    Random random(5);
    std::vector<Primitive> primitives = randomSoup(count, 0.1f, 6);
    for (uint i = 0; i < count / 4; i++)
        addSphere(primitives, random.inCube(1),
                  std::ldexp(1 + random.uniform(), -static_cast<int>(random.below(30))));
    return primitives;
}

TEST(WideTree, enclosesAndReachesEverythingOnce)
{
    expectSound(randomSoup(2000, 0.05f, 1), 0);
    expectSound(randomSoup(30, 2.0f, 2), 10);
    expectSound(anything(2000), 1);
}

TEST(WideTree, isSoundInScenesThatAreTinyHugeFarOffOrSeenFromAfar)
{
    const auto soup = anything(500);
    for (float scale : {1e-18f, 1e-6f, 1e6f, 1e15f}) {
        SCOPED_TRACE(scale);
        expectSound(moved(soup, scale, vec3(0)), 0);
        expectSound(moved(soup, scale, vec3(1000 * scale, -3e6f * scale, 0)), 0);
        expectSound(moved(soup, scale, vec3(0)), 1e12 * double{scale});
    }
    expectSound(soup, 1e37);
    expectSound(moved(soup, 1, vec3(1e12f, 0, 0)), 0);
}

TEST(WideTree, ofFlatAndOfCoincidentPrimitivesIsSound)
{
    std::vector<Primitive> flat, coincident;
    for (int i = 0; i < 500; i++) {
        const float x = static_cast<float>(i);
        addTriangle(flat, {x, 0, 0}, {x + 1, 0, 0}, {x, 0, 1});
        addTriangle(coincident, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    }
    expectSound(flat, 0);
    expectSound(coincident, 0);
}

TEST(WideTree, isTheSameEachTime)
{
    const Bvh bvh = buildBvh(anything(500), BvhBuild::sweep, 1);
    const WideTrees a = widen(bvh.nodes, {}, bvh.rootRef, 1),
                    b = widen(bvh.nodes, {}, bvh.rootRef, 1);
    ASSERT_EQ(a.nodes.size(), b.nodes.size());
    EXPECT_EQ(std::memcmp(a.nodes.data(), b.nodes.data(), a.nodes.size() * sizeof(WideNode)), 0);
}

TEST(WideTree, thereIsNoneWhereStepsWouldLeaveTheRangeOfNumbers)
{
    const Bvh bvh = buildBvh(moved(randomSoup(100, 0.1f, 3), 1e20f, vec3(0)), BvhBuild::sweep, 1);
    EXPECT_TRUE(widen(bvh.nodes, {}, bvh.rootRef, 0).nodes.empty());
}

TEST(WideTree, ofNothingAndOfOneLeafHasNoNodes)
{
    EXPECT_EQ(widen({}, {}, REF_NONE, 1).rootRef, REF_NONE);
    EXPECT_EQ(widen({}, {}, REF_LEAF, 1).rootRef, REF_LEAF);
}

/// Two kinds of objects: of one leaf, and of a tree.
TEST(WideTree, ofInstancesReachesTheTreesOfTheirObjects)
{
    const std::vector<std::vector<Primitive>> objects = {randomSoup(300, 0.1f, 8),
                                                         randomSoup(1, 0.1f, 9)};
    std::vector<Placement> placements;
    for (uint i = 0; i < 9; i++) {
        Placement placement;
        placement.translation = glm::dvec3(4.0 * i, 0, 0);
        placement.object = i % 2;
        placements.push_back(placement);
    }
    const Bvh bvh =
        buildTwoLevels(randomSoup(50, 0.1f, 10), objects, placements, 1, BvhBuild::sweep, 1);
    const WideTrees wide = widen(bvh.nodes, bvh.instances, bvh.rootRef, 1);
    ASSERT_EQ(wide.instances.size(), placements.size());
    Walk::Waiting waiting;
    std::vector<uint> roots;
    for (const ObjectInstance& instance : wide.instances) roots.push_back(instance.rootRef);
    Walk walk(wide, bvh.primitives);
    const ObjectInstance& first = wide.instances[0];
    walk.visit(first.rootRef, {first.gridX, first.gridY, first.gridZ}, first.gridScale, waiting);
    EXPECT_EQ(walk.outside, 0u);
    EXPECT_NE(roots[1] & REF_LEAF, 0u);
    for (uint i = 0; i < roots.size(); i++) EXPECT_EQ(roots[i], roots[i % 2]);
    // What waits in the world, the way back, what waits in the object
    EXPECT_GT(wide.worstPending, waiting.references + 1);
    EXPECT_GT(wide.worstGroups, waiting.groups + 1);
}

}  // namespace
}  // namespace sahl
