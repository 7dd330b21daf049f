// The closest hit of a scene with instances is the same bits whatever the trees and the order in
// which they are walked: brute force over all primitives of all instances is the witness.
#include "agreement/placements.h"
#include "util/parallel.h"

#include <gtest/gtest.h>

#include <atomic>

namespace sahl::testing {
namespace {

/// Primitives of the world, and objects placed in it.
struct PlacedScene {
    std::vector<Primitive> world;
    std::vector<std::vector<Primitive>> objects;
    std::vector<Placement> placements;
};

/// Everything one after the other: the world's primitives, then those of every object.
struct BruteScene {
    Bvh arrays;
    std::vector<uint> firstSlot;  ///< of each object
};

BruteScene bruteSceneOf(const PlacedScene& scene, const Bvh& built)
{
    BruteScene brute;
    brute.arrays.primitives = scene.world;
    brute.arrays.instances = built.instances;
    for (const auto& object : scene.objects) {
        brute.firstSlot.push_back(static_cast<uint>(brute.arrays.primitives.size()));
        brute.arrays.primitives.insert(brute.arrays.primitives.end(), object.begin(), object.end());
    }
    return brute;
}

Traversal bruteForce(reference::Kernel<>& kernel, const PlacedScene& scene, const BruteScene& brute,
                     const Ray& ray)
{
    constexpr float INFINITE = reference::Kernel<>::RAY_INFINITY;
    Traversal walk = kernel.beginTraversal(INFINITE);
    const auto inWorld = kernel.makeWalkRay(ray.org, ray.dir, 0, 0);
    for (uint slot = 0; slot < scene.world.size(); slot++)
        kernel.visitPrimitive(inWorld, slot, walk);
    for (uint i = 0; i < scene.placements.size(); i++) {
        const ObjectInstance& instance = kernel.instances[i];
        float entry;
        if (!kernel.intersectBox(inWorld.boxes, instance.lo, instance.hi, INFINITE, entry))
            continue;
        walk.inside = i;
        const auto inside = kernel.walkRayInside(instance, ray.org, ray.dir, entry);
        const uint object = scene.placements[i].object;
        for (uint k = 0; k < scene.objects[object].size(); k++)
            kernel.visitPrimitive(inside, brute.firstSlot[object] + k, walk);
    }
    return walk;
}

/// What a hit is, in bits.
struct Hit {
    uint number, instance, t, b1, b2;
    bool operator==(const Hit&) const = default;
};

Hit bitsOf(const Traversal& walk)
{
    return {walk.number, walk.instance, glm::floatBitsToUint(walk.tHit),
            glm::floatBitsToUint(walk.b1), glm::floatBitsToUint(walk.b2)};
}

/// A walk that stops after every few steps and goes on, as on a device.
template <class Kernel>
Traversal hitInPieces(Kernel kernel, const Ray& ray, uint steps)
{
    Traversal walk = kernel.beginTraversal(reference::Kernel<>::RAY_INFINITY);
    for (;;) {
        kernel.stepsLeft = steps;
        if (kernel.traverse(ray.org, ray.dir, false, walk)) return walk;
        if (kernel.faults != 0) throw std::runtime_error("the traversal did not end by itself");
    }
}

///   watched  the same kernel, able to stop
template <class Kernel, class Watched>
bool agrees(Kernel kernel, Watched watched, const Ray& ray, const Traversal& truth)
{
    if (bitsOf(closestHit(kernel, ray)) != bitsOf(truth)) return false;
    if (bitsOf(hitInPieces(watched, ray, 3)) != bitsOf(truth)) return false;
    const bool found = findHit(kernel, ray, true, truth.tHit).slot != NO_HIT;
    if (truth.slot == NO_HIT) return !found;
    const float before = std::nextafter(truth.tHit, 0.0f);
    return found && findHit(kernel, ray, true, before).slot == NO_HIT;
}

void expectSameBits(const PlacedScene& scene, std::span<const Ray> rays, double reach)
{
    const Bvh sweep =
        buildTwoLevels(scene.world, scene.objects, scene.placements, reach, BvhBuild::sweep, 1);
    const Bvh binned =
        buildTwoLevels(scene.world, scene.objects, scene.placements, reach, BvhBuild::binned, 1);
    const WideTrees wide = widen(sweep.nodes, sweep.instances, sweep.rootRef, reach);
    const BruteScene brute = bruteSceneOf(scene, sweep);
    std::atomic<uint64_t> differing = 0, hits = 0, hitsInside = 0;
    constexpr size_t CHUNK = 256;
    parallelFor((rays.size() + CHUNK - 1) / CHUNK, defaultThreadCount(), [&](size_t chunk) {
        auto kernel = kernelFor<ORDER_NEAR_FIRST>(brute.arrays);
        const size_t end = std::min(rays.size(), (chunk + 1) * CHUNK);
        for (size_t i = chunk * CHUNK; i < end; i++) {
            const Traversal truth = bruteForce(kernel, scene, brute, rays[i]);
            hits += truth.slot != NO_HIT;
            hitsInside += truth.instance != NO_INSTANCE;
            for (const Bvh* tree : {&sweep, &binned}) {
                differing += !agrees(kernelFor<ORDER_NEAR_FIRST>(*tree),
                                     kernelFor<ORDER_NEAR_FIRST, true>(*tree), rays[i], truth);
                differing += !agrees(kernelFor<ORDER_LEFT_FIRST>(*tree),
                                     kernelFor<ORDER_LEFT_FIRST, true>(*tree), rays[i], truth);
                differing += !agrees(kernelFor<ORDER_RIGHT_FIRST>(*tree),
                                     kernelFor<ORDER_RIGHT_FIRST, true>(*tree), rays[i], truth);
            }
            differing +=
                !agrees(wideKernelFor<ORDER_NEAR_FIRST>(sweep, wide),
                        wideKernelFor<ORDER_NEAR_FIRST, true>(sweep, wide), rays[i], truth);
            differing +=
                !agrees(wideKernelFor<ORDER_LEFT_FIRST>(sweep, wide),
                        wideKernelFor<ORDER_LEFT_FIRST, true>(sweep, wide), rays[i], truth);
            differing +=
                !agrees(wideKernelFor<ORDER_RIGHT_FIRST>(sweep, wide),
                        wideKernelFor<ORDER_RIGHT_FIRST, true>(sweep, wide), rays[i], truth);
        }
    });
    EXPECT_EQ(differing, 0u);
    EXPECT_GT(hits, rays.size() / 10);
    EXPECT_GT(hitsInside, rays.size() / 20);
}

/// A few objects, spheres among them, placed in all ways; every third instance twice at one place,
/// so that ties are decided between instances.
PlacedScene anyScene(double lowest, double highest, Random& random)
{
    PlacedScene scene;
    scene.world = randomSoup(20, 1, random.bits());
    scene.objects = {randomSoup(60, 0.4f, random.bits()), ballOfTriangles(1, {0.2f, 0, 0}, 1)};
    for (int i = 0; i < 10; i++)
        addSphere(scene.objects[0], random.inCube(1), random.uniform(0.01f, 0.4f));
    for (uint i = 0; i < 8; i++) {
        Placement placement = anyPlacement(lowest, highest, random);
        placement.translation *= 0.05;
        placement.object = i % 2;
        scene.placements.push_back(placement);
        if (i % 3 == 0) scene.placements.push_back(placement);
    }
    return scene;
}

void expectSameBitsInScenes(double lowest, double highest, int scenes, size_t raysEach)
{
    for (int i = 0; i < scenes; i++) {
        Random random(0x0123 + static_cast<uint64_t>(i));
        const PlacedScene scene = anyScene(lowest, highest, random);
        std::vector<Primitive> flat = scene.world;
        for (const Placement& placement : scene.placements)
            appendFlattened(placement, scene.objects[placement.object], flat);
        const Box box = boxOfAll(flat);
        const double reach = glm::length(glm::dvec3(box.hi) - glm::dvec3(box.lo)) * 10;
        std::vector<Ray> rays = hardRays(flat, raysEach, 3 + static_cast<uint64_t>(i));
        // As many at the middle of some triangle of some instance, small as it may be.
        for (size_t k = 0; k < raysEach; k++) {
            const Primitive& t = flat[random.below(static_cast<uint>(flat.size()))];
            const glm::dvec3 middle =
                (glm::dvec3(t.p0) + glm::dvec3(t.p1) + glm::dvec3(t.p2)) / 3.0;
            const vec3 org = pointIn(box, random);
            rays.push_back(rayTowards(org, middle - glm::dvec3(org)));
        }
        expectSameBits(scene, rays, reach);
    }
}

TEST(InstanceOrder, sameBitsInEveryOrder)
{
    expectSameBitsInScenes(-0.5, 0.5, 4, 1'000);
}

TEST(InstanceOrder, ofScalesFromAThousandthToAThousand_sameBits)
{
    expectSameBitsInScenes(-3, 3, 4, 1'000);
}

TEST(LongInstanceOrder, sameBitsInEveryOrder)
{
    expectSameBitsInScenes(-0.5, 0.5, 20, 25'000);
}

TEST(LongInstanceOrder, ofScalesFromAThousandthToAThousand_sameBits)
{
    expectSameBitsInScenes(-3, 3, 20, 25'000);
}

/// Leaves of the world's tree hold primitives alone: an instance stands where a leaf could.
TEST(TwoLevels, instancesAreReferencesOfTheirOwn)
{
    Random random(8);
    const PlacedScene scene = anyScene(-1, 0, random);
    const Bvh bvh =
        buildTwoLevels(scene.world, scene.objects, scene.placements, 10, BvhBuild::sweep, 1);
    std::vector<uint> seen;
    for (const BvhNode& node : bvh.nodes) {
        for (uint ref : {node.ref0, node.ref1}) {
            if ((ref & REF_LEAF) == 0 && (ref & REF_INSTANCE) != 0)
                seen.push_back(ref & ~REF_INSTANCE);
        }
    }
    std::sort(seen.begin(), seen.end());
    ASSERT_EQ(seen.size(), scene.placements.size());
    for (uint i = 0; i < seen.size(); i++) EXPECT_EQ(seen[i], i);
    EXPECT_EQ(bvh.primitives.size(),
              scene.world.size() + scene.objects[0].size() + scene.objects[1].size());
    uint number = static_cast<uint>(scene.world.size());
    for (size_t i = 0; i < bvh.instances.size(); i++) {
        EXPECT_EQ(bvh.instances[i].firstNumber, number);
        number += static_cast<uint>(scene.objects[scene.placements[i].object].size());
    }
    EXPECT_EQ(bvh.statistics.primitivesSeen, number);
}

TEST(TwoLevels, oneInstanceAloneIsTheRoot)
{
    PlacedScene scene;
    scene.objects = {ballOfTriangles(0, {0, 0, 0}, 1)};
    scene.placements.resize(1);
    const Bvh bvh =
        buildTwoLevels(scene.world, scene.objects, scene.placements, 10, BvhBuild::sweep, 1);
    EXPECT_EQ(bvh.rootRef, REF_INSTANCE);
    auto kernel = kernelFor<ORDER_NEAR_FIRST>(bvh);
    EXPECT_EQ(closestHit(kernel, {{0.1f, 0.2f, 5}, {0, 0, -1}}).instance, 0u);
    EXPECT_EQ(closestHit(kernel, {{0.1f, 2, 5}, {0, 0, -1}}).slot, NO_HIT);
}

/// The stack holds the longest way even where the builders make the deepest trees: many primitives
/// at one place.
TEST(TwoLevels, stayWithinTheStackWhateverTheInput)
{
    PlacedScene scene;
    scene.objects.resize(1);
    for (uint i = 0; i < 3000; i++)
        addTriangle(scene.objects[0], {0, 0, 0}, {1, 0, 0},
                    {0, std::ldexp(1.0f, -int(i % 100)), 0});
    for (uint i = 0; i < 3000; i++) {
        Placement placement;
        placement.translation = {std::ldexp(1.0, -int(i % 90)), 0, 0};
        scene.placements.push_back(placement);
    }
    for (BvhBuild build : {BvhBuild::sweep, BvhBuild::binned}) {
        const Bvh bvh = buildTwoLevels(scene.world, scene.objects, scene.placements, 10, build, 1);
        EXPECT_LE(bvh.statistics.depth, MAX_STACK_SIZE);
        auto kernel = kernelFor<ORDER_LEFT_FIRST>(bvh);
        EXPECT_NE(closestHit(kernel, {{0.5f, 0.01f, 5}, {0, 0, -1}}).slot, NO_HIT);
    }
}

}  // namespace
}  // namespace sahl::testing
