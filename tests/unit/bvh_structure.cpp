// What every tree must be, whatever the primitives: complete, exact, bounded, the same each time.
#include "bvh/box.h"
#include "bvh/bvh.h"
#include "support/soups.h"
#include "util/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>

namespace sahl {
namespace {

using testing::addSphere;
using testing::addTriangle;
using testing::Random;
using testing::randomSoup;

struct Named {
    const char* name;
    std::vector<Primitive> triangles;
};

std::vector<Primitive> coincident(uint count)
{
    std::vector<Primitive> triangles;
    for (uint i = 0; i < count; i++) addTriangle(triangles, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    return triangles;
}

/// All centres equal, all sizes different.
std::vector<Primitive> nested(uint count)
{
    std::vector<Primitive> triangles;
    for (uint i = 1; i <= count; i++) {
        float s = static_cast<float>(i);
        addTriangle(triangles, {-s, -s, 0}, {s, -s, 0}, {0, s, 0});
    }
    return triangles;
}

/// Every triangle twice as far away and twice as large as the one before: the heuristic likes to
/// split off one at a time.
std::vector<Primitive> doubling(uint count)
{
    std::vector<Primitive> triangles;
    for (uint i = 0; i < count; i++) {
        float s = std::ldexp(1.0f, static_cast<int>(i % 240) - 120);
        addTriangle(triangles, {s, 0, 0}, {s, s, 0}, {s, 0, s});
    }
    return triangles;
}

/// Corners on one line, so that every box has no area.
std::vector<Primitive> line(uint count)
{
    std::vector<Primitive> triangles;
    for (uint i = 0; i < count; i++) {
        float x = static_cast<float>(i);
        addTriangle(triangles, {x, 0, 0}, {x + 0.5f, 0, 0}, {x + 0.25f, 0, 0});
    }
    return triangles;
}

std::vector<Primitive> scaled(std::vector<Primitive> triangles, float factor)
{
    for (Primitive& t : triangles) {
        t.p0 *= factor;
        t.p1 *= factor;
        t.p2 *= factor;
    }
    return triangles;
}

/// Coordinates over all of float, up to the largest of both signs.
std::vector<Primitive> extremes(uint count)
{
    Random random(3);
    auto coordinate = [&] {
        float value = std::ldexp(random.uniform(-1, 1), static_cast<int>(random.below(276)) - 148);
        return random.below(50) == 0 ? std::copysign(std::numeric_limits<float>::max(), value)
                                     : value;
    };
    auto corner = [&] {
        float x = coordinate(), y = coordinate();
        return vec3(x, y, coordinate());
    };
    std::vector<Primitive> triangles;
    for (uint i = 0; i < count; i++) {
        vec3 p0 = corner(), p1 = corner();
        addTriangle(triangles, p0, p1, corner());
    }
    return triangles;
}

/// Spheres of very different sizes, in and beside one another, among triangles.
std::vector<Primitive> spheres(uint count)
{
    Random random(11);
    std::vector<Primitive> primitives = randomSoup(count, 0.1f, 12);
    for (uint i = 0; i < count; i++) {
        const float radius =
            std::ldexp(1 + random.uniform(), static_cast<int>(random.below(40)) - 30);
        addSphere(primitives, random.inCube(i % 3 == 0 ? 1000.0f : 1.0f), radius);
    }
    return primitives;
}

std::vector<Named> nastyInputs()
{
    std::vector<Primitive> oneFarAway = randomSoup(3000, 0.01f, 2);
    addTriangle(oneFarAway, {1e30f, 0, 0}, {1e30f, 1, 0}, {1e30f, 0, 1});
    return {{"one triangle", randomSoup(1, 0.1f, 1)},
            {"two triangles", randomSoup(2, 0.1f, 1)},
            {"nine triangles", randomSoup(9, 0.1f, 1)},
            {"soup", randomSoup(20'000, 0.05f, 1)},
            {"large triangles", randomSoup(3000, 2.0f, 5)},
            {"torus", testing::torus(120, 60)},
            {"spheres", spheres(5000)},
            {"100,000 coincident", coincident(100'000)},
            {"equal centres", nested(20'000)},
            {"doubling sizes", doubling(20'000)},
            {"line", line(20'000)},
            {"huge", scaled(randomSoup(3000, 0.1f, 4), 3e38f)},
            {"tiny", scaled(randomSoup(3000, 0.1f, 4), 1e-42f)},
            {"all of float", extremes(20'000)},
            {"one far away", oneFarAway}};
}

/// Walks a tree and checks it on the way.
class Walk {
public:
    explicit Walk(const Bvh& tree) : bvh_(tree), seen_(tree.primitives.size(), 0) {}

    /// Returns the exact box of everything below `ref`, which has `above` inner nodes above it.
    Box visit(uint ref, uint above)
    {
        if (ref & REF_LEAF) return visitLeaf(ref, above);
        innerNodes++;
        if (ref >= bvh_.nodes.size()) throw std::runtime_error("reference beyond the nodes");
        const BvhNode& node = bvh_.nodes[ref];
        Box all = visitChild(node.ref0, node.lo0, node.hi0, above + 1);
        grow(all, visitChild(node.ref1, node.lo1, node.hi1, above + 1));
        return all;
    }

    bool everyPrimitiveOnce() const
    {
        return std::all_of(seen_.begin(), seen_.end(), [](int count) { return count == 1; });
    }

    uint64_t innerNodes = 0, leaves = 0;
    uint depth = 0, largestLeaf = 0;
    uint64_t wrongBoxes = 0;

private:
    Box visitChild(uint ref, const vec3& lo, const vec3& hi, uint childDepth)
    {
        Box box = visit(ref, childDepth);
        if (box.lo != lo || box.hi != hi) wrongBoxes++;
        return box;
    }

    Box visitLeaf(uint ref, uint leafDepth)
    {
        leaves++;
        depth = std::max(depth, leafDepth);
        uint first = (ref & ~REF_LEAF) >> LEAF_COUNT_BITS;
        uint count = (ref & (MAX_LEAF_SIZE - 1)) + 1;
        largestLeaf = std::max(largestLeaf, count);
        Box box;
        for (uint i = first; i < first + count; i++) {
            seen_.at(i)++;
            grow(box, boxOf(bvh_.primitives[i]));
        }
        return box;
    }

    const Bvh& bvh_;
    std::vector<int> seen_;
};

std::vector<uint> sortedPrimitives(const std::vector<Primitive>& triangles)
{
    std::vector<uint> primitives;
    for (const Primitive& t : triangles) primitives.push_back(t.number);
    std::sort(primitives.begin(), primitives.end());
    return primitives;
}

void expectSound(const std::vector<Primitive>& triangles, BvhBuild build)
{
    const Bvh bvh = buildBvh(triangles, build, 2);
    ASSERT_EQ(bvh.primitives.size(), triangles.size());
    EXPECT_EQ(sortedPrimitives(bvh.primitives), sortedPrimitives(triangles));
    for (const Primitive& t : bvh.primitives)
        ASSERT_EQ(std::memcmp(&t, &triangles[t.number], sizeof t), 0);
    Walk walk(bvh);
    walk.visit(bvh.rootRef, 0);
    EXPECT_TRUE(walk.everyPrimitiveOnce());
    EXPECT_EQ(walk.wrongBoxes, 0u);
    EXPECT_LE(walk.depth, MAX_STACK_SIZE);
    EXPECT_LE(walk.largestLeaf, MAX_LEAF_SIZE);
    EXPECT_EQ(walk.innerNodes, bvh.nodes.size());
    EXPECT_EQ(walk.innerNodes, bvh.statistics.innerNodes);
    EXPECT_EQ(walk.leaves, bvh.statistics.leaves);
    EXPECT_EQ(walk.depth, bvh.statistics.depth);
    EXPECT_EQ(walk.largestLeaf, bvh.statistics.largestLeaf);
    EXPECT_EQ(bvh.statistics.build, build);
    EXPECT_TRUE(std::isfinite(bvh.statistics.sahCost));
}

TEST(Bvh, sweep_isSoundOnNastyInputs)
{
    for (const Named& input : nastyInputs()) {
        SCOPED_TRACE(input.name);
        expectSound(input.triangles, BvhBuild::sweep);
    }
}

TEST(Bvh, binned_isSoundOnNastyInputs)
{
    for (const Named& input : nastyInputs()) {
        SCOPED_TRACE(input.name);
        expectSound(input.triangles, BvhBuild::binned);
    }
}

TEST(Bvh, high_isSoundOnNastyInputs)
{
    for (const Named& input : nastyInputs()) {
        SCOPED_TRACE(input.name);
        expectSound(input.triangles, BvhBuild::high);
    }
}

bool sameBits(const Bvh& a, const Bvh& b)
{
    auto same = [](const auto& x, const auto& y) {
        return x.size() == y.size() &&
               (x.empty() || std::memcmp(x.data(), y.data(), x.size() * sizeof x[0]) == 0);
    };
    return a.rootRef == b.rootRef && same(a.nodes, b.nodes) && same(a.primitives, b.primitives);
}

TEST(Bvh, threads_doNotChangeTheBits)
{
    std::vector<Named> inputs = nastyInputs();
    inputs.push_back({"large soup", randomSoup(120'000, 0.02f, 7)});
    for (const Named& input : inputs) {
        SCOPED_TRACE(input.name);
        for (BvhBuild build : {BvhBuild::sweep, BvhBuild::binned}) {
            const Bvh one = buildBvh(input.triangles, build, 1);
            EXPECT_TRUE(sameBits(one, buildBvh(input.triangles, build, 2)));
            EXPECT_TRUE(sameBits(one, buildBvh(input.triangles, build, 3)));
        }
    }
}

TEST(Bvh, primitivesGivenAway_makeTheTreeThatTheirCopiesMake)
{
    for (const Named& input : nastyInputs()) {
        SCOPED_TRACE(input.name);
        std::vector<Primitive> given = input.triangles;
        EXPECT_TRUE(sameBits(buildBvh(input.triangles, BvhBuild::binned, 2),
                             buildBvh(std::move(given), BvhBuild::binned, 2)));
        EXPECT_EQ(given.capacity(), 0u);
    }
}

TEST(Bvh, threads_doNotChangeTheBitsOfHighQuality)
{
    for (const std::vector<Primitive>& triangles : {randomSoup(5000, 0.05f, 7), testing::torus(60, 40)}) {
        const Bvh one = buildBvh(triangles, BvhBuild::high, 1);
        EXPECT_TRUE(sameBits(one, buildBvh(triangles, BvhBuild::high, 2)));
        EXPECT_TRUE(sameBits(one, buildBvh(triangles, BvhBuild::high, 3)));
    }
}

TEST(Bvh, coincidentTriangles_makeAShallowTree)
{
    for (BvhBuild build : {BvhBuild::sweep, BvhBuild::binned}) {
        const Bvh bvh = buildBvh(coincident(100'000), build, 2);
        EXPECT_LE(bvh.statistics.depth, 17u);  // log2(100,000), rounded up
    }
}

/// 240 sizes one within the other would make a tree of 239 levels.
TEST(Bvh, depth_isCutAtTheStackSize)
{
    for (BvhBuild build : {BvhBuild::sweep, BvhBuild::binned}) {
        const Bvh bvh = buildBvh(doubling(240), build, 2);
        EXPECT_EQ(bvh.statistics.depth, MAX_STACK_SIZE);
    }
}

TEST(Bvh, noTriangles_makeNoTree)
{
    for (BvhBuild build : {BvhBuild::automatic, BvhBuild::sweep, BvhBuild::binned, BvhBuild::high}) {
        const Bvh bvh = buildBvh(std::span<const Primitive>(), build, 2);
        EXPECT_EQ(bvh.rootRef, REF_NONE);
        EXPECT_TRUE(bvh.nodes.empty());
        EXPECT_TRUE(bvh.primitives.empty());
        EXPECT_EQ(bvh.statistics.leaves, 0u);
        EXPECT_EQ(bvh.statistics.sahCost, 0);
    }
}

TEST(Bvh, oneTriangle_isALeaf)
{
    const Bvh bvh = buildBvh(randomSoup(1, 0.1f, 1), BvhBuild::sweep, 1);
    EXPECT_EQ(bvh.rootRef, REF_LEAF);
    EXPECT_TRUE(bvh.nodes.empty());
    EXPECT_EQ(bvh.statistics.depth, 0u);
    EXPECT_EQ(bvh.statistics.sahCost, 1);
}

TEST(Bvh, twoTriangles_areALeafWhenTogetherAndANodeWhenApart)
{
    std::vector<Primitive> together, apart;
    addTriangle(together, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    addTriangle(together, {1, 1, 0}, {1, 0, 0}, {0, 1, 0});
    addTriangle(apart, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    addTriangle(apart, {0, 0, 9}, {1, 0, 9}, {0, 1, 9});
    const Bvh leaf = buildBvh(together, BvhBuild::sweep, 1);
    EXPECT_EQ(leaf.rootRef, REF_LEAF | 1u);
    const Bvh node = buildBvh(apart, BvhBuild::sweep, 1);
    ASSERT_EQ(node.nodes.size(), 1u);
    EXPECT_EQ(node.rootRef, 0u);
    EXPECT_EQ(node.nodes[0].ref0, REF_LEAF);
    EXPECT_EQ(node.nodes[0].ref1, REF_LEAF | 1u << LEAF_COUNT_BITS);
    EXPECT_EQ(node.nodes[0].lo1, vec3(0, 0, 9) - 9 * BOX_WIDENING);
    EXPECT_EQ(node.nodes[0].hi1, vec3(1, 1, 9) + 9 * BOX_WIDENING);
}

TEST(Bvh, automatic_sweepsSmallScenesAndBinsLargeOnes)
{
    auto chosen = [](uint count) {
        return buildBvh(randomSoup(count, 0.01f, 1), BvhBuild::automatic, 2).statistics.build;
    };
    EXPECT_EQ(chosen(1000), BvhBuild::sweep);
    EXPECT_EQ(chosen(200'000), BvhBuild::binned);
}

TEST(Bvh, refusesCornersThatAreNotFinite)
{
    for (float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        std::vector<Primitive> triangles = randomSoup(20, 0.1f, 1);
        triangles[7].p1.y = bad;
        try {
            buildBvh(triangles, BvhBuild::sweep, 1);
            FAIL() << "accepted";
        } catch (const Error& error) {
            EXPECT_EQ(error.kind, ErrorKind::badInput);
            EXPECT_NE(std::string(error.what()).find("primitive 7 "), std::string::npos);
        }
    }
}

/// In double: a point of a sphere lies in its box, except for the rounding of the box's own
/// corners.
TEST(Bvh, boxesEncloseSpheres)
{
    std::vector<Primitive> all;
    Random random(5);
    for (uint i = 0; i < 2000; i++) {
        addSphere(all, random.inCube(10),
                  std::ldexp(1 + random.uniform(), int(random.below(24)) - 12));
    }
    for (const Primitive& sphere : all) {
        const Box box = extentOf(sphere);
        for (int axis = 0; axis < 3; axis++) {
            const double centre = double{sphere.p0[axis]}, radius = double{sphere.p1.x};
            const double rounding = 0x1p-24 * (std::abs(centre) + radius);
            EXPECT_NEAR(box.lo[axis], centre - radius, rounding);
            EXPECT_NEAR(box.hi[axis], centre + radius, rounding);
        }
    }
}

/// By 12 roundings of the largest coordinate, less those of the subtraction.
TEST(Bvh, boxesAreWiderThanWhatTheyHold)
{
    for (const Primitive& triangle : randomSoup(2000, 0.1f, 6)) {
        const Box box = boxOf(triangle);
        for (const vec3& p : {triangle.p0, triangle.p1, triangle.p2}) {
            for (int axis = 0; axis < 3; axis++) {
                EXPECT_LE(box.lo[axis], p[axis] - 11 * 0x1p-24f * std::abs(p[axis]));
                EXPECT_GE(box.hi[axis], p[axis] + 11 * 0x1p-24f * std::abs(p[axis]));
            }
        }
    }
}

TEST(Bvh, twoSpheresApart_haveTheirBoxesInOneNode)
{
    std::vector<Primitive> apart;
    addSphere(apart, {0, 0, 0}, 0.5f);
    addSphere(apart, {0, 0, 9}, 2);
    const Bvh bvh = buildBvh(apart, BvhBuild::sweep, 1);
    ASSERT_EQ(bvh.nodes.size(), 1u);
    const float first = 0.5f * BOX_WIDENING, second = 11 * BOX_WIDENING;
    EXPECT_EQ(bvh.nodes[0].lo0, vec3(-0.5f, -0.5f, -0.5f) - first);
    EXPECT_EQ(bvh.nodes[0].hi0, vec3(0.5f, 0.5f, 0.5f) + first);
    EXPECT_EQ(bvh.nodes[0].lo1, vec3(-2, -2, 7) - second);
    EXPECT_EQ(bvh.nodes[0].hi1, vec3(2, 2, 11) + second);
}

TEST(Bvh, refusesSpheresWithoutASoundRadius)
{
    const std::pair<float, const char*> bad[] = {
        {0.0f, "primitive 3 is a sphere of radius 0"},
        {-1.0f, "the radius must be positive"},
        {std::numeric_limits<float>::quiet_NaN(), "positive"},
        {std::numeric_limits<float>::max(), "beyond the range"}};
    for (const auto& [radius, message] : bad) {
        std::vector<Primitive> primitives = randomSoup(3, 0.1f, 1);
        addSphere(primitives, vec3(3e38f, 0, 0), radius);
        try {
            buildBvh(primitives, BvhBuild::sweep, 1);
            ADD_FAILURE() << "accepted " << radius;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind, ErrorKind::badInput);
            EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
        }
    }
}

}  // namespace
}  // namespace sahl
