// Closed surfaces let no ray through, and rays that leave a surface do not meet it again where they
// started. Suites called Long... ask for the full number of rays.
#include "agreement/rays.h"
#include "scene/obj_reader.h"
#include "scene/primitives.h"
#include "support/assets.h"
#include "support/closed_meshes.h"
#include "support/render_scenes.h"
#include "util/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <functional>

namespace sahl::testing {
namespace {

/// A closed mesh and a way to find points inside.
struct Hull {
    std::vector<Primitive> triangles;
    std::function<vec3(Random&)> inside;
};

Hull ball(uint32_t level, vec3 centre, float radius)
{
    return {trianglesOf(makeSphere(centre, radius, level, false)),
            [=](Random& random) { return centre + random.inCube(0.4f * radius); }};
}

/// A wavy torus: its tube is about 0.4 thick around a circle of radius 1.
Hull ring()
{
    return {torus(60, 24), [](Random& random) {
                const double angle = 2 * M_PI * double{random.uniform()};
                return vec3(std::cos(angle), 0, std::sin(angle)) + random.inCube(0.15f);
            }};
}

/// A ball flattened a thousandfold: slivers, met at all angles.
Hull pancake()
{
    Hull hull = ball(3, {0.3f, 0.1f, -0.2f}, 1);
    for (Primitive& t : hull.triangles) {
        for (vec3* p : {&t.p0, &t.p1, &t.p2}) p->y *= 1e-3f;
    }
    hull.inside = [](Random& random) {
        return (vec3(0.3f, 0.1f, -0.2f) + random.inCube(0.4f)) * vec3(1, 1e-3f, 1);
    };
    return hull;
}

/// A large room of 12 triangles, seen from near the middle of one of its edges: the corners, whose
/// rounding decides, are ten thousand times farther away than where the ray goes.
Hull room()
{
    Scene box;
    addBox(box, {-500, -500, 0}, 500);
    Hull hull = {box.primitives, [](Random& random) { return random.inCube(0.05f); }};
    for (Primitive& t : hull.triangles) {
        for (vec3* p : {&t.p0, &t.p1, &t.p2}) *p += vec3(0.1f, 0.1f, 0);
    }
    return hull;
}

/// A mesh of which nothing is known but that it has holes, closed by us.
Hull closed(const Mesh& mesh, size_t expectedHoles)
{
    Hull hull = {trianglesOf(mesh), {}};
    EXPECT_FALSE(isClosed(hull.triangles));
    EXPECT_EQ(closeHoles(hull.triangles), expectedHoles);
    const Box box = boxOfAll(hull.triangles);
    Random random(11);
    std::vector<vec3> points;
    while (points.size() < 64) {
        const vec3 point = pointIn(box, random);
        if (windingNumber(hull.triangles, point) > 0.5) points.push_back(point);
    }
    hull.inside = [points](Random& choice) { return points[choice.below(64)]; };
    return hull;
}

/// Where on the surface a ray is aimed: at a vertex, at an edge, at an edge's middle, or nowhere.
vec3 targetOn(std::span<const Primitive> triangles, Random& random)
{
    const Primitive& t = triangles[random.below(static_cast<uint>(triangles.size()))];
    switch (random.below(3)) {
    case 0:
        return t.p0;
    case 1:
        return t.p0 + (t.p1 - t.p0) * random.uniform();
    default:
        return (t.p1 + t.p2) * 0.5f;
    }
}

void expectNoLeak(const Hull& hull, size_t count)
{
    ASSERT_TRUE(isClosed(hull.triangles));
    const Bvh bvh = buildBvh(hull.triangles, BvhBuild::sweep, 1);
    std::atomic<uint64_t> leaks = 0;
    constexpr size_t CHUNK = 4096;
    parallelFor((count + CHUNK - 1) / CHUNK, defaultThreadCount(), [&](size_t chunk) {
        auto kernel = kernelFor<ORDER_NEAR_FIRST>(bvh);
        Random random(0x7a57 + chunk);
        const size_t end = std::min(count, (chunk + 1) * CHUNK);
        for (size_t i = chunk * CHUNK; i < end; i++) {
            const vec3 org = hull.inside(random);
            const glm::dvec3 way =
                i % 3 == 0 ? anyDirection(random)
                           : glm::dvec3(targetOn(hull.triangles, random)) - glm::dvec3(org);
            leaks += closestHit(kernel, rayTowards(org, way)).slot == NO_HIT;
        }
    });
    EXPECT_EQ(leaks, 0u) << "of " << count << " rays, " << hull.triangles.size() << " triangles";
}

void expectNoLeaks(size_t count)
{
    for (uint32_t level : {0u, 2u, 5u}) expectNoLeak(ball(level, {0, 0, 0}, 1), count);
    expectNoLeak(ball(3, {1000, -500, 300}, 1), count);
    expectNoLeak(ball(3, {0.01f, 0, 0}, 1e-3f), count);
    expectNoLeak(ring(), count);
    expectNoLeak(pancake(), count);
    expectNoLeak(room(), count);
    // The rims of the body and of the lid, both ends of the handle and of the spout
    expectNoLeak(closed(makeTeapot(10, false), 6), count);
}

void expectNoLeakInBunny(size_t count)
{
    const fs::path file = assetFolder() / "meshes/miro/bunny.obj";
    expectNoLeak(closed(readObj(file, {file.parent_path(), {}}).mesh, 5), count);
}

TEST(Watertight, noRayLeavesAClosedMesh)
{
    expectNoLeaks(100'000);
}

TEST(LongWatertight, noRayLeavesAClosedMesh)
{
    expectNoLeaks(10'000'000);
}

TEST(Watertight, noRayLeavesTheBunnyWhoseHolesAreClosed)
{
    SAHL_REQUIRE_ASSET("meshes/miro/bunny.obj");
    expectNoLeakInBunny(100'000);
}

TEST(LongWatertight, noRayLeavesTheBunnyWhoseHolesAreClosed)
{
    SAHL_REQUIRE_ASSET("meshes/miro/bunny.obj");
    expectNoLeakInBunny(10'000'000);
}

TEST(Watertight, pointsInsideAreToldFromThoseOutside)
{
    const Hull hull = ball(2, {1, 2, 3}, 1);
    EXPECT_NEAR(windingNumber(hull.triangles, {1.3f, 2, 3.5f}), 1, 1e-9);
    EXPECT_NEAR(windingNumber(hull.triangles, {2.1f, 2, 3}), 0, 1e-9);
}

TEST(Watertight, anOpenMeshIsToldFromAClosedOne)
{
    std::vector<Primitive> triangles = ring().triangles;
    triangles.pop_back();
    EXPECT_FALSE(isClosed(triangles));
}

/// A triangle or a sphere of about `scale`, up to ten times that away from the origin. Every fourth
/// triangle is a sliver.
Primitive anyShape(bool sphere, float scale, Random& random)
{
    Primitive shape = {};
    shape.p0 = random.inCube(10 * scale);
    shape.shape = sphere ? SHAPE_SPHERE : SHAPE_FLAT;
    if (sphere) {
        shape.p1.x = scale * random.uniform(0.05f, 5);
    } else {
        const float width = random.below(4) == 0 ? 0.01f * scale : scale;
        shape.p1 = shape.p0 + random.inCube(scale);
        shape.p2 = shape.p0 + (shape.p1 - shape.p0) * random.uniform() + random.inCube(width);
    }
    return shape;
}

/// A ray towards a point inside the triangle or inside the sphere, from outside or from within it.
Ray rayAt(const Primitive& shape, float scale, Random& random)
{
    if (shape.shape == SHAPE_SPHERE) {
        const vec3 target = shape.p0 + random.inCube(0.5f * shape.p1.x);
        const glm::dvec3 way = anyDirection(random);
        const bool within = random.below(2) == 0;
        return rayTowards(within ? target : target - vec3(way) * (shape.p1.x * 20), way);
    }
    const float u = random.uniform(), v = random.uniform() * (1 - u);
    const vec3 target = shape.p0 + (shape.p1 - shape.p0) * u + (shape.p2 - shape.p0) * v;
    const vec3 org = target + random.inCube(20 * scale);
    return rayTowards(org, glm::dvec3(target) - glm::dvec3(org));
}

/// Any direction; half of them nearly in the surface.
vec3 anyWay(const vec3& n, Random& random)
{
    glm::dvec3 way = glm::normalize(anyDirection(random));
    if (random.below(2) == 0) {
        const glm::dvec3 normal(n);
        way -= normal * glm::dot(normal, way) *
               (1 - std::ldexp(1.0, -static_cast<int>(random.below(30))));
    }
    return vec3(glm::normalize(way));
}

/// Distance at which a ray that starts within a sphere leaves it, in double precision.
double exitOf(const Primitive& sphere, const vec3& org, const vec3& dir)
{
    const glm::dvec3 arm = glm::dvec3(org) - glm::dvec3(sphere.p0), d(dir);
    const double a = glm::dot(d, d), b = glm::dot(arm, d);
    const double c = glm::dot(arm, arm) - double{sphere.p1.x} * double{sphere.p1.x};
    return (-b + std::sqrt(b * b - a * c)) / a;
}

TEST(Boxes, ofTheTreeAreThoseOfTheText)
{
    reference::Kernel<> kernel;
    Random random(3);
    for (int i = 0; i < 20'000; i++) {
        const float scale = std::ldexp(1.0f, static_cast<int>(random.below(200)) - 95);
        const Primitive shape = anyShape(i % 2 == 0, scale, random);
        reference::Axes lo, hi;
        kernel.primitiveBox(shape, lo, hi);
        EXPECT_EQ(vec3(lo[0], lo[1], lo[2]), boxOf(shape).lo);
        EXPECT_EQ(vec3(hi[0], hi[1], hi[2]), boxOf(shape).hi);
    }
}

struct SpawnCounts {
    std::atomic<uint64_t> spawned = 0, selfHits = 0;
};

/// One ray from the shape's surface. It must not meet a triangle again, nor a sphere from outside;
/// from inside it must meet the sphere's far side, at the distance that double precision gives.
void spawn(reference::Kernel<>& kernel, const Primitive& shape, const Ray& ray, Random& random,
           SpawnCounts& counts)
{
    const Traversal hit = closestHit(kernel, ray);
    if (hit.slot == NO_HIT) return;
    const auto isect = kernel.interactionAt(hit, ray.org, ray.dir);
    const vec3 wi = anyWay(isect.ng, random);
    const Ray next = {kernel.offsetOrigin(isect, wi), wi};
    const Traversal again = closestHit(kernel, next);
    counts.spawned++;
    const bool backSide = kernel.dot3(wi, isect.ng) < 0.0f;
    const bool inwards = shape.shape == SHAPE_SPHERE && isect.front == backSide;
    bool wrong = again.slot != NO_HIT;
    if (inwards) {
        const double exit = exitOf(shape, next.org, next.dir);
        wrong = again.slot == NO_HIT || std::abs(again.tHit - exit) > 0.1 * exit;
    }
    counts.selfHits += wrong;
}

void expectNoSelfHits(bool spheres, size_t count)
{
    SpawnCounts counts;
    constexpr size_t CHUNK = 1024;
    parallelFor((count + CHUNK - 1) / CHUNK, defaultThreadCount(), [&](size_t chunk) {
        Random random(0x5e1f + chunk);
        const size_t end = std::min(count, (chunk + 1) * CHUNK);
        for (size_t i = chunk * CHUNK; i < end; i++) {
            const float scale = std::pow(10.0f, random.uniform(-3, 5));
            const Primitive shape = anyShape(spheres, scale, random);
            reference::Kernel<> kernel;
            kernel.primitives = {&shape, 1};
            kernel.frame.rootRef = REF_LEAF;  // one leaf with one primitive, the first
            spawn(kernel, shape, rayAt(shape, scale, random), random, counts);
        }
    });
    EXPECT_EQ(counts.selfHits, 0u) << "of " << counts.spawned;
    EXPECT_GT(counts.spawned, count * 9 / 10);
}

TEST(Offsets, noRayFromATriangleMeetsItAgain)
{
    expectNoSelfHits(false, 100'000);
}

TEST(Offsets, noRayFromASphereMeetsItWhereItStarted)
{
    expectNoSelfHits(true, 100'000);
}

TEST(LongOffsets, noRayFromATriangleMeetsItAgain)
{
    expectNoSelfHits(false, 1'000'000);
}

TEST(LongOffsets, noRayFromASphereMeetsItWhereItStarted)
{
    expectNoSelfHits(true, 1'000'000);
}

}  // namespace
}  // namespace sahl::testing
