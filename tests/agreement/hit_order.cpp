// The closest hit is the same bits whatever the tree and the order in which it is walked: brute
// force is the witness. Suites called Long... ask for the full number of rays.
#include "agreement/rays.h"
#include "scene/primitives.h"
#include "support/assets.h"
#include "util/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstring>

namespace sahl::testing {
namespace {

/// What a hit is, in bits.
struct Hit {
    uint primitive, t, b1, b2;
    bool operator==(const Hit&) const = default;
};

Hit bitsOf(const Traversal& walk)
{
    return {walk.number, glm::floatBitsToUint(walk.tHit), glm::floatBitsToUint(walk.b1),
            glm::floatBitsToUint(walk.b2)};
}

/// Every triangle in turn, in the order of the scene.
Traversal bruteForce(reference::Kernel<>& kernel, const Ray& ray)
{
    Traversal walk = kernel.beginTraversal(reference::Kernel<>::RAY_INFINITY);
    const auto inWorld = kernel.makeWalkRay(ray.org, ray.dir, 0, 0);
    for (uint slot = 0; slot < kernel.primitives.size(); slot++)
        kernel.visitPrimitive(inWorld, slot, walk);
    return walk;
}

struct Differences {
    std::atomic<uint64_t> sweepNear = 0, sweepLeft = 0, sweepRight = 0;
    std::atomic<uint64_t> binnedNear = 0, binnedLeft = 0, binnedRight = 0;
    std::atomic<uint64_t> wideNear = 0, wideLeft = 0, wideRight = 0;  ///< of the sweep's tree
    std::atomic<uint64_t> anyHit = 0;  ///< of a ray that ends at, or just before, its closest hit
    std::atomic<uint64_t> hits = 0;
};

/// Any hit must agree with the closest hit at tHit: met when the ray ends there, not met before.
template <class Kernel>
bool anyHitAgrees(Kernel& kernel, const Ray& ray, const Traversal& closest)
{
    const bool found = findHit(kernel, ray, true, closest.tHit).slot != NO_HIT;
    if (closest.slot == NO_HIT) return !found;
    const float before = std::nextafter(closest.tHit, 0.0f);
    return found && findHit(kernel, ray, true, before).slot == NO_HIT;
}

void compare(const Bvh& scene, const Bvh& sweep, const Bvh& binned, const WideTrees& wide,
             std::span<const Ray> rays, Differences& differences)
{
    auto brute = kernelFor<ORDER_NEAR_FIRST>(scene);
    auto check = [](const Bvh& tree, auto order, const Ray& ray, const Traversal& truth,
                    std::atomic<uint64_t>& differing, std::atomic<uint64_t>& anyDiffering) {
        auto kernel = kernelFor<decltype(order)::value>(tree);
        differing += bitsOf(closestHit(kernel, ray)) != bitsOf(truth);
        anyDiffering += !anyHitAgrees(kernel, ray, truth);
    };
    auto checkWide = [&](auto order, const Ray& ray, const Traversal& truth, std::atomic<uint64_t>& differing) {
        auto kernel = wideKernelFor<decltype(order)::value>(sweep, wide);
        differing += bitsOf(closestHit(kernel, ray)) != bitsOf(truth);
        differences.anyHit += !anyHitAgrees(kernel, ray, truth);
    };
    using Near = std::integral_constant<uint, ORDER_NEAR_FIRST>;
    using Left = std::integral_constant<uint, ORDER_LEFT_FIRST>;
    using Right = std::integral_constant<uint, ORDER_RIGHT_FIRST>;
    for (const Ray& ray : rays) {
        const Traversal truth = bruteForce(brute, ray);
        differences.hits += truth.slot != NO_HIT;
        check(sweep, Near{}, ray, truth, differences.sweepNear, differences.anyHit);
        check(sweep, Left{}, ray, truth, differences.sweepLeft, differences.anyHit);
        check(sweep, Right{}, ray, truth, differences.sweepRight, differences.anyHit);
        check(binned, Near{}, ray, truth, differences.binnedNear, differences.anyHit);
        check(binned, Left{}, ray, truth, differences.binnedLeft, differences.anyHit);
        check(binned, Right{}, ray, truth, differences.binnedRight, differences.anyHit);
        checkWide(Near{}, ray, truth, differences.wideNear);
        checkWide(Left{}, ray, truth, differences.wideLeft);
        checkWide(Right{}, ray, truth, differences.wideRight);
    }
}

/// Every ray against brute force; at least a tenth must hit something for the test to mean
/// anything.
void expectSameBits(const std::vector<Primitive>& triangles, const std::vector<Ray>& rays)
{
    const unsigned threads = defaultThreadCount();
    const Bvh sweep = buildBvh(triangles, BvhBuild::sweep, threads);
    const Bvh binned = buildBvh(triangles, BvhBuild::binned, threads);
    const WideTrees wide = widen(sweep.nodes, {}, sweep.rootRef, 0);
    Bvh scene;
    scene.primitives = triangles;
    Differences differences;
    constexpr size_t CHUNK = 256;
    parallelFor((rays.size() + CHUNK - 1) / CHUNK, threads, [&](size_t chunk) {
        const size_t first = chunk * CHUNK, count = std::min(CHUNK, rays.size() - first);
        compare(scene, sweep, binned, wide, std::span(rays).subspan(first, count), differences);
    });
    EXPECT_EQ(differences.sweepNear, 0u);
    EXPECT_EQ(differences.sweepLeft, 0u);
    EXPECT_EQ(differences.sweepRight, 0u);
    EXPECT_EQ(differences.binnedNear, 0u);
    EXPECT_EQ(differences.binnedLeft, 0u);
    EXPECT_EQ(differences.binnedRight, 0u);
    EXPECT_EQ(differences.wideNear, 0u);
    EXPECT_EQ(differences.wideLeft, 0u);
    EXPECT_EQ(differences.wideRight, 0u);
    EXPECT_EQ(differences.anyHit, 0u);
    EXPECT_GT(differences.hits, rays.size() / 10);
    ::testing::Test::RecordProperty("hits", std::to_string(differences.hits));
}

/// The teapot of 6320 triangles, moved along x.
std::vector<Primitive> teapot(float offset = 0)
{
    std::vector<Primitive> triangles;
    const Mesh mesh = makeTeapot(10, false);
    auto corner = [&](uint32_t index) { return mesh.positions[index] + vec3(offset, 0, 0); };
    for (const MeshTriangle& t : mesh.triangles) {
        const vec3 a = corner(t.position[0]), b = corner(t.position[1]), c = corner(t.position[2]);
        const glm::dvec3 normal =
            glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
        if (glm::length(normal) > 0) addTriangle(triangles, a, b, c);
    }
    return triangles;
}

/// Half of the rays start anywhere, half come from far outside.
std::vector<Ray> easyRays(const std::vector<Primitive>& triangles, size_t count)
{
    std::vector<Ray> rays = randomRays(triangles, count, 31);
    Random random(32);
    const Box box = boxOfAll(triangles);
    for (size_t i = 0; i < rays.size(); i += 2) {
        const vec3 target = pointIn(box, random);
        const glm::dvec3 way = anyDirection(random);
        rays[i] = rayTowards(target - vec3(way) * 50.0f, way);
    }
    return rays;
}

void expectSameBitsOnBunny(size_t count)
{
    const Scene bunny = loadScene(assetFolder() / "meshes/miro/bunny.obj", {});
    expectSameBits(bunny.primitives, easyRays(bunny.primitives, count));
    expectSameBits(bunny.primitives, hardRays(bunny.primitives, count, 33));
}

TEST(HitOrder, teapot_sameBitsInEveryOrder)
{
    expectSameBits(teapot(), easyRays(teapot(), 5'000));
}

TEST(HitOrder, teapot_sameBitsForHardRays)
{
    expectSameBits(teapot(), hardRays(teapot(), 5'000, 34));
}

TEST(HitOrder, teapotFarFromTheOrigin_sameBitsForHardRays)
{
    expectSameBits(teapot(1000), hardRays(teapot(1000), 5'000, 35));
}

TEST(HitOrder, soupOfAllSizes_sameBitsForHardRays)
{
    std::vector<Primitive> soup = randomSoup(500, 0.01f, 36);
    for (float size : {0.1f, 1.0f, 100.0f, 10000.0f}) {
        for (const Primitive& t : randomSoup(200, size, 37)) addTriangle(soup, t.p0, t.p1, t.p2);
    }
    expectSameBits(soup, hardRays(soup, 20'000, 38));
}

/// Spheres in and through one another, and triangles that cut them; rays at their rims among
/// others.
TEST(HitOrder, spheresAmongTriangles_sameBits)
{
    std::vector<Primitive> soup = randomSoup(300, 0.2f, 39);
    Random random(40);
    for (uint i = 0; i < 300; i++) addSphere(soup, random.inCube(1), random.uniform(0.001f, 0.3f));
    std::vector<Ray> rays = easyRays(soup, 5'000);
    for (uint i = 0; i < 5'000; i++) {
        const Primitive& sphere = soup[300 + random.below(300)];
        const glm::dvec3 arm = glm::normalize(anyDirection(random));
        const vec3 rim = sphere.p0 + vec3(arm) * sphere.p1.x;
        const glm::dvec3 tangent = glm::cross(arm, anyDirection(random));
        rays.push_back(rayTowards(rim - vec3(glm::normalize(tangent)) * 2.0f, tangent));
    }
    expectSameBits(soup, rays);
}

TEST(HitOrder, coincidentTriangles_smallestNumberWins)
{
    std::vector<Primitive> triangles;
    for (int i = 0; i < 100; i++) addTriangle(triangles, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    std::reverse(triangles.begin(), triangles.end());
    for (BvhBuild build : {BvhBuild::sweep, BvhBuild::binned}) {
        const Bvh bvh = buildBvh(triangles, build, 1);
        auto left = kernelFor<ORDER_LEFT_FIRST>(bvh);
        auto right = kernelFor<ORDER_RIGHT_FIRST>(bvh);
        const Ray ray = {{0.2f, 0.2f, 1}, {0, 0, -1}};
        EXPECT_EQ(closestHit(left, ray).number, 0u);
        EXPECT_EQ(closestHit(right, ray).number, 0u);
    }
}

TEST(HitOrder, bunny_sameBitsInEveryOrder)
{
    SAHL_REQUIRE_ASSET("meshes/miro/bunny.obj");
    expectSameBitsOnBunny(500);
}

TEST(LongHitOrder, teapot_sameBitsInEveryOrder)
{
    expectSameBits(teapot(), easyRays(teapot(), 100'000));
}

TEST(LongHitOrder, teapot_sameBitsForHardRays)
{
    expectSameBits(teapot(), hardRays(teapot(), 100'000, 34));
}

TEST(LongHitOrder, teapotFarFromTheOrigin_sameBitsForHardRays)
{
    expectSameBits(teapot(1000), hardRays(teapot(1000), 100'000, 35));
}

TEST(LongHitOrder, bunny_sameBitsInEveryOrder)
{
    SAHL_REQUIRE_ASSET("meshes/miro/bunny.obj");
    expectSameBitsOnBunny(10'000);
}

}  // namespace
}  // namespace sahl::testing
