// How good the trees are: against exhaustive search, against each other, against a naive builder.
#include "bvh/box.h"
#include "bvh/bvh.h"
#include "bvh/reinsert.h"
#include "bvh/sweep.h"
#include "support/soups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

namespace sahl {
namespace {

using testing::randomSoup;

Box boxOfAll(const std::vector<Primitive>& triangles)
{
    Box box;
    for (const Primitive& t : triangles) grow(box, boxOf(t));
    return box;
}

/// Half areas times triangles of the two sides when the `k` first along an axis go left.
double splitCost(std::vector<Primitive> triangles, int axis, uint k)
{
    std::stable_sort(triangles.begin(), triangles.end(), [&](const auto& a, const auto& b) {
        return doubleCentre(boxOf(a), axis) < doubleCentre(boxOf(b), axis);
    });
    const auto middle = triangles.begin() + k;
    return halfArea(boxOfAll({triangles.begin(), middle})) * k +
           halfArea(boxOfAll({middle, triangles.end()})) *
               static_cast<double>(triangles.size() - k);
}

uint trianglesBelow(const Bvh& bvh, uint ref)
{
    if (ref & REF_LEAF) return (ref & (MAX_LEAF_SIZE - 1)) + 1;
    return trianglesBelow(bvh, bvh.nodes[ref].ref0) + trianglesBelow(bvh, bvh.nodes[ref].ref1);
}

std::vector<Box> boxesOf(const std::vector<Primitive>& triangles)
{
    std::vector<Box> boxes;
    for (const Primitive& triangle : triangles) boxes.push_back(boxOf(triangle));
    return boxes;
}

Bvh treeOf(const Draft& draft, const std::vector<Primitive>& triangles)
{
    Bvh bvh = flatten(draft, {triangles, {}, {}}, 1);
    for (uint number : draft.order) bvh.primitives.push_back(triangles[number]);
    return bvh;
}

TEST(BvhQuality, sweep_takesTheBestOfAllSplits)
{
    for (uint64_t seed = 0; seed < 50; seed++) {
        const std::vector<Primitive> triangles = randomSoup(12, 0.3f, seed);
        double best = std::numeric_limits<double>::infinity();
        for (int axis = 0; axis < 3; axis++)
            for (uint k = 1; k < 12; k++) best = std::min(best, splitCost(triangles, axis, k));

        const std::vector<Box> boxes = boxesOf(triangles);
        const Bvh bvh = treeOf(buildSweep(boxes, MAX_STACK_SIZE, 1), triangles);
        ASSERT_FALSE(bvh.nodes.empty());
        const BvhNode& root = bvh.nodes[0];
        const double cost = halfArea({root.lo0, root.hi0}) * trianglesBelow(bvh, root.ref0) +
                            halfArea({root.lo1, root.hi1}) * trianglesBelow(bvh, root.ref1);
        EXPECT_DOUBLE_EQ(cost, best);
    }
}

/// Cost of a tree as the builder counts it: 1 a node, 1 a triangle, weighted by half areas.
double builderCost(const Bvh& bvh, uint ref, const Box& box)
{
    if (ref & REF_LEAF) return halfArea(box) * trianglesBelow(bvh, ref);
    const BvhNode& node = bvh.nodes[ref];
    return halfArea(box) + builderCost(bvh, node.ref0, {node.lo0, node.hi0}) +
           builderCost(bvh, node.ref1, {node.lo1, node.hi1});
}

/// The cheapest of all binary trees over up to 10 triangles: every division of every subset.
double cheapestTree(const std::vector<Primitive>& triangles)
{
    const uint all = (1u << triangles.size()) - 1;
    std::vector<double> cheapest(all + 1);
    for (uint set = 1; set <= all; set++) {
        std::vector<Primitive> members;
        for (uint i = 0; i < triangles.size(); i++)
            if (set >> i & 1) members.push_back(triangles[i]);
        const double area = halfArea(boxOfAll(members));
        const double count = std::popcount(set);
        double divided = std::numeric_limits<double>::infinity();
        for (uint part = (set - 1) & set; part > 0; part = (part - 1) & set)
            divided = std::min(divided, cheapest[part] + cheapest[set ^ part]);
        const bool mayBeLeaf = count <= MAX_LEAF_SIZE;
        cheapest[set] = std::min(area + divided, mayBeLeaf ? area * count : INFINITY);
    }
    return cheapest[all];
}

TEST(BvhQuality, sweep_isCloseToTheBestOfAllTrees)
{
    double total = 0, best = 0;
    for (uint64_t seed = 100; seed < 120; seed++) {
        const std::vector<Primitive> triangles = randomSoup(9, 0.3f, seed);
        const Bvh bvh = buildBvh(triangles, BvhBuild::sweep, 1);
        const double cost = builderCost(bvh, bvh.rootRef, boxOfAll(triangles));
        const double cheapest = cheapestTree(triangles);
        EXPECT_GE(cost, cheapest * (1 - 1e-12));
        total += cost;
        best += cheapest;
    }
    EXPECT_LE(total, 1.1 * best);
}

/// Cost of dividing by number at the median of the longest axis, down to 4 triangles: what a
/// builder without the heuristic would do. In box and triangle tests, not yet per root area.
double medianCost(std::span<Primitive> triangles)
{
    Box box;
    for (const Primitive& t : triangles) grow(box, boxOf(t));
    const double area = halfArea(box);
    if (triangles.size() <= 4) return area * static_cast<double>(triangles.size());
    const vec3 extent = box.hi - box.lo;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0
                     : extent.y >= extent.z                       ? 1
                                                                  : 2;
    const size_t half = triangles.size() / 2;
    std::nth_element(triangles.begin(), triangles.begin() + static_cast<std::ptrdiff_t>(half),
                     triangles.end(), [&](const auto& a, const auto& b) {
                         return doubleCentre(boxOf(a), axis) < doubleCentre(boxOf(b), axis);
                     });
    return 2 * area + medianCost(triangles.first(half)) + medianCost(triangles.subspan(half));
}

void expectRanking(std::vector<Primitive> triangles)
{
    const double sweep = buildBvh(triangles, BvhBuild::sweep, 2).statistics.sahCost;
    const double binned = buildBvh(triangles, BvhBuild::binned, 2).statistics.sahCost;
    const double area = halfArea(boxOfAll(triangles));
    const double median = medianCost(triangles) / area;
    // Greedy choices may turn out either way further down, hence "about".
    EXPECT_LE(sweep, 1.02 * binned);
    EXPECT_LE(binned, 1.10 * sweep);
    EXPECT_LT(sweep, median);
    EXPECT_LT(binned, median);
    ::testing::Test::RecordProperty("sweep", std::to_string(sweep));
    ::testing::Test::RecordProperty("binned", std::to_string(binned));
    ::testing::Test::RecordProperty("median", std::to_string(median));
}

TEST(BvhQuality, heuristic_beatsMedianSplitsOnASoup)
{
    expectRanking(randomSoup(20'000, 0.05f, 11));
}

TEST(BvhQuality, heuristic_beatsMedianSplitsOnAMesh)
{
    expectRanking(testing::torus(200, 80));
}

TEST(BvhQuality, heuristic_beatsMedianSplitsWhenSizesDiffer)
{
    std::vector<Primitive> triangles = testing::torus(100, 40);  // teapot in a stadium
    for (Primitive& t : triangles) t.p0 *= 0.01f, t.p1 *= 0.01f, t.p2 *= 0.01f;
    for (const Primitive& t : randomSoup(2000, 1.0f, 12))
        testing::addTriangle(triangles, t.p0 * 10.0f, t.p1 * 10.0f, t.p2 * 10.0f);
    expectRanking(triangles);
}

TEST(BvhQuality, reinsertion_makesTreesCheaper)
{
    for (const std::vector<Primitive>& triangles : {randomSoup(5000, 0.2f, 14), testing::torus(100, 40)}) {
        const std::vector<Box> boxes = boxesOf(triangles);
        const double standard = treeOf(buildSweep(boxes, MAX_STACK_SIZE, 2), triangles).statistics.sahCost;
        const double high = buildBvh(triangles, BvhBuild::high, 2).statistics.sahCost;
        EXPECT_LT(high, 0.99 * standard);
    }
}

/// Two clusters whose triangles take turns: halves of the order mix them, and moves part them again.
TEST(BvhQuality, reinsertion_partsWhatAPoorTreeMixes)
{
    std::vector<Primitive> triangles;
    for (uint i = 0; i < 64; i++) {
        const float x = static_cast<float>(i % 2) * 100 + static_cast<float>(i) * 0.1f;
        testing::addTriangle(triangles, {x, 0, 0}, {x + 0.1f, 0, 0}, {x, 0.1f, 0.1f});
    }
    const std::vector<Box> boxes = boxesOf(triangles);
    Draft draft;  // leaves of 8 in the order of numbers, whatever their place
    draft.nodes.resize(2 * 64 - 1);
    for (uint i = 0; i < 64; i++) draft.order.push_back(i);
    auto divide = [&](auto& self, const Subtree& tree) -> void {
        const bool isLeaf = tree.count <= MAX_LEAF_SIZE;
        const Subtree right = rightOf(tree, tree.count / 2);
        draft.nodes[tree.slot] = {tree.first, tree.count, isLeaf ? 0 : right.slot};
        if (isLeaf) return;
        self(self, leftOf(tree, tree.count / 2));
        self(self, right);
    };
    divide(divide, {0, 64, 0, MAX_STACK_SIZE});
    const double poor = treeOf(draft, triangles).statistics.sahCost;
    Draft early = draft;
    improveByReinsertion(early, boxes, MAX_STACK_SIZE, WHILE_IT_PAYS, 1);
    EXPECT_LT(treeOf(early, triangles).statistics.sahCost, 0.5 * poor);
    improveByReinsertion(draft, boxes, MAX_STACK_SIZE, TO_THE_END, 1);
    const double better = treeOf(draft, triangles).statistics.sahCost;
    EXPECT_LT(better, 0.5 * poor);
    EXPECT_LT(better, 1.1 * buildBvh(triangles, BvhBuild::sweep, 1).statistics.sahCost);
}

TEST(BvhQuality, reinsertion_leavesATreeThatItCannotMakeBetter)
{
    const std::vector<Primitive> triangles = testing::torus(100, 40);
    const std::vector<Box> boxes = boxesOf(triangles);
    const Draft draft = buildSweep(boxes, MAX_STACK_SIZE, 1);
    Draft same = draft;
    improveByReinsertion(same, boxes, MAX_STACK_SIZE, WHILE_IT_PAYS, 1);
    EXPECT_EQ(treeOf(same, triangles).statistics.sahCost, treeOf(draft, triangles).statistics.sahCost);
    EXPECT_EQ(same.order, draft.order);
}

/// The statistic against its definition, summed here from the finished tree.
TEST(BvhQuality, sahCost_isWhatTheTreeCosts)
{
    const std::vector<Primitive> triangles = randomSoup(500, 0.1f, 13);
    const Bvh bvh = buildBvh(triangles, BvhBuild::sweep, 1);
    const Box root = boxOfAll(triangles);
    double tests = 2 * halfArea(root);
    for (const BvhNode& node : bvh.nodes) {
        auto add = [&](uint ref, const Box& box) {
            tests += halfArea(box) * (ref & REF_LEAF ? trianglesBelow(bvh, ref) : 2);
        };
        add(node.ref0, {node.lo0, node.hi0});
        add(node.ref1, {node.lo1, node.hi1});
    }
    EXPECT_NEAR(bvh.statistics.sahCost, tests / halfArea(root), 1e-9);
}

}  // namespace
}  // namespace sahl
