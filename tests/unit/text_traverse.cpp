// Walks through trees, binary and wide, against every triangle and sphere in double precision.
#include "agreement/rays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sahl::testing {
namespace {

using glm::dvec3;

/// Distance along the ray, infinite where it passes. `sure` becomes false where it nearly touches
/// an edge or a rim, so that rounding may decide.
double distanceTo(const Primitive& shape, const Ray& ray, bool& sure)
{
    const dvec3 org(ray.org), dir(ray.dir), p0(shape.p0);
    constexpr double NEVER = std::numeric_limits<double>::infinity(), EDGE = 1e-4;
    if (shape.shape == SHAPE_SPHERE) {
        const double radius = double(shape.p1.x), middle = dot(p0 - org, dir);
        const dvec3 across = org + dir * middle - p0;
        const double inside = radius * radius - dot(across, across);
        if (std::abs(inside) < EDGE) sure = false;
        if (inside < 0) return NEVER;
        const double near = middle - std::sqrt(inside), far = middle + std::sqrt(inside);
        if (std::abs(near) < EDGE || std::abs(far) < EDGE) sure = false;
        return near > 0 ? near : far > 0 ? far : NEVER;
    }
    // Moeller and Trumbore 1997.
    const dvec3 e1 = dvec3(shape.p1) - p0, e2 = dvec3(shape.p2) - p0, p = cross(dir, e2);
    const double determinant = dot(e1, p);
    if (std::abs(determinant) < 1e-6) sure = false;
    const dvec3 s = org - p0, q = cross(s, e1);
    const double b1 = dot(s, p) / determinant, b2 = dot(dir, q) / determinant;
    const double t = dot(e2, q) / determinant, least = std::min({b1, b2, 1 - b1 - b2});
    if (t > -EDGE && std::abs(least) < EDGE) sure = false;
    if (std::abs(t) < EDGE && least > -EDGE) sure = false;
    return least >= 0 && t > 0 ? t : NEVER;
}

TEST(Traversal, findsTheClosestOfAll_asDoublePrecisionDoes)
{
    std::vector<Primitive> shapes = randomSoup(300, 0.5f, 1);
    Random random(2);
    for (int i = 0; i < 20; i++) addSphere(shapes, random.inCube(1), random.uniform(0.05f, 0.2f));
    const Bvh bvh = buildBvh(shapes, BvhBuild::sweep, 1);
    const WideTrees wide = widen(bvh.nodes, bvh.instances, bvh.rootRef, 2);
    auto binaryKernel = kernelFor<ORDER_NEAR_FIRST>(bvh);
    auto wideKernel = wideKernelFor<ORDER_NEAR_FIRST>(bvh, wide);
    int hits = 0, misses = 0;
    for (const Ray& ray : randomRays(shapes, 3000, 3)) {
        double first = std::numeric_limits<double>::infinity(), second = first;
        uint number = NO_HIT;
        bool sure = true;
        for (const Primitive& shape : shapes) {
            const double t = distanceTo(shape, ray, sure);
            if (t < first) number = shape.number;
            second = std::min(second, std::max(first, t));
            first = std::min(first, t);
        }
        if (!sure || second - first < 1e-4) continue;
        for (const Traversal& walk : {closestHit(binaryKernel, ray), closestHit(wideKernel, ray)}) {
            EXPECT_EQ(walk.number, number);
            if (number != NO_HIT) {
                EXPECT_NEAR(double(walk.tHit), first, 1e-5);
            }
        }
        (number == NO_HIT ? misses : hits)++;
    }
    EXPECT_GT(hits, 1000);
    EXPECT_GT(misses, 100);
}

}  // namespace
}  // namespace sahl::testing
