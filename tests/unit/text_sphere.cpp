// Rays and spheres of the path tracer's text against long double.

#include "reference/kernel.h"
#include "support/soups.h"

#include <gtest/gtest.h>

namespace sahl {
namespace {

using reference::Kernel;
using testing::Random;

constexpr double EPSILON = 0x1p-24;  // half a unit in the last place of a float just above 1

/// A ray and a sphere as the text gets them, and their first meeting in long double.
struct Meeting {
    bool hits = false;
    bool doubtful = false;  ///< so close to the rim or to the surface that rounding may decide
    long double t = 0;
    long double tolerance = 0;
};

Meeting exactMeeting(vec3 org, vec3 dir, vec3 centre, float radius)
{
    using Real = long double;
    const glm::tvec3<Real> f = glm::tvec3<Real>(org) - glm::tvec3<Real>(centre), d(dir);
    const Real a = glm::dot(d, d), b = -glm::dot(f, d), r = radius;
    const glm::tvec3<Real> beside = f + d * (b / a);
    const Real discriminant = r * r - glm::dot(beside, beside);
    const Real size = std::sqrt(glm::dot(f, f)) + r;  // of the terms that are rounded
    Meeting meeting;
    const Real rimError = 8 * Real(EPSILON) * r * size + 32 * Real(EPSILON * EPSILON) * size * size;
    if (discriminant < rimError) {
        meeting.doubtful = discriminant > -rimError;
        return meeting;
    }
    const Real half = std::sqrt(a * discriminant);
    const Real first = (b - half) / a, second = (b + half) / a;
    meeting.t = first > 0 ? first : second;
    meeting.hits = second > 0;
    // An error of `size` roundings beside or along the ray moves the point along it by that over
    // the cosine between ray and normal.
    const Real cosine = std::sqrt(discriminant) / r;
    meeting.tolerance = 16 * Real(EPSILON) * size / cosine;
    meeting.doubtful = std::abs(first) < meeting.tolerance || std::abs(second) < meeting.tolerance;
    return meeting;
}

TEST(IntersectSphere, agreesWithLongDouble)
{
    Kernel<> kernel;
    Random random(3);
    int hits = 0, misses = 0, doubtful = 0;
    for (float radius : {1e-3f, 0.03f, 1.0f, 50.0f, 1e4f}) {
        for (int i = 0; i < 20000; i++) {
            const vec3 centre = random.inCube(10 * radius);
            const vec3 aim = centre + random.direction() * (radius * random.uniform(0, 1.2f));
            // Inside, near and far: up to 1000 radii away
            const float away = std::ldexp(random.uniform(0.1f, 1), int(random.below(12)) - 1);
            const vec3 org = centre + random.direction() * (radius * away);
            const vec3 dir = kernel.unit(aim - org);
            const Meeting exact = exactMeeting(org, dir, centre, radius);
            float t;
            const bool found = kernel.intersectSphere(org, dir, centre, radius, t);
            if (exact.doubtful) {
                doubtful++;
                continue;
            }
            ASSERT_EQ(found, exact.hits) << radius << " " << away;
            (found ? hits : misses)++;
            if (!found) continue;
            ASSERT_LT(std::abs(t - exact.t), exact.tolerance) << radius << " " << away;
        }
    }
    EXPECT_GT(hits, 50000);
    EXPECT_GT(misses, 4000);
    EXPECT_LT(doubtful, 300);
}

/// Rays along tangents a little inside and a little outside the sphere.
TEST(IntersectSphere, tangentsHitJustInsideAndMissJustOutside)
{
    Kernel<> kernel;
    Random random(4);
    for (float radius : {1e-3f, 1.0f, 1e4f}) {
        for (int i = 0; i < 5000; i++) {
            const vec3 n = random.direction();
            vec3 along, other;
            kernel.tangentFrame(n, along, other);
            const float away = radius * random.uniform(1, 30);
            float t;
            const vec3 inside = n * (radius * 0.9999f) - along * away;
            const vec3 outside = n * (radius * 1.0001f) - along * away;
            ASSERT_TRUE(kernel.intersectSphere(inside, along, vec3(0), radius, t));
            ASSERT_NEAR(t, away, 0.02f * radius);
            ASSERT_FALSE(kernel.intersectSphere(outside, along, vec3(0), radius, t));
        }
    }
}

/// The offset of a ray's origin is larger than what intersectSphere cannot tell from zero.
TEST(IntersectSphere, raysThatLeaveDoNotMeetTheirOwnSphere)
{
    Kernel<> kernel;
    Random random(5);
    Primitive sphere = {};
    sphere.shape = SHAPE_SPHERE;
    int entered = 0;
    for (float radius : {1e-3f, 1.0f, 1e4f}) {
        for (int i = 0; i < 20000; i++) {
            sphere.p0 = random.inCube(20 * radius);
            sphere.p1.x = radius;
            const vec3 org = sphere.p0 + random.direction() * (3 * radius);
            const vec3 dir = kernel.unit(sphere.p0 + random.inCube(0.57f * radius) - org);
            Traversal hit = {};
            ASSERT_TRUE(kernel.intersectSphere(org, dir, sphere.p0, radius, hit.tHit));
            Kernel<>::SurfaceInteraction isect = {};
            kernel.sphereInteraction(sphere, hit, org, dir, isect);
            ASSERT_TRUE(isect.front);

            // Away from the sphere, at all angles down to grazing
            vec3 wi = random.direction();
            if (i % 2 == 0) wi = kernel.unit(wi * 1e-3f + kernel.cross3(isect.ng, wi));
            if (kernel.dot3(wi, isect.ng) < 0) wi = -wi;
            float t;
            ASSERT_FALSE(
                kernel.intersectSphere(kernel.offsetOrigin(isect, wi), wi, sphere.p0, radius, t));

            // Into the sphere: the chord is 2 r cos long
            const float cosine = kernel.dot3(wi, isect.ng);
            if (cosine < 0.1f) continue;
            ASSERT_TRUE(
                kernel.intersectSphere(kernel.offsetOrigin(isect, -wi), -wi, sphere.p0, radius, t));
            ASSERT_NEAR(t, 2 * radius * cosine, 5e-5f * radius / cosine);
            entered++;
        }
    }
    EXPECT_GT(entered, 15000);
}

}  // namespace
}  // namespace sahl
