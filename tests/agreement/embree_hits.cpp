// Closest hits against Embree, which shares no line with ours. The two may disagree where rounding
// decides, and every such ray must be one of the kinds below.
#include "agreement/rays.h"
#include "support/assets.h"
#include "util/parallel.h"

#include <embree3/rtcore.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <mutex>

namespace sahl::testing {
namespace {

constexpr double SAME_DISTANCE = 1e-5;  ///< relative; Embree computes t from other operations
constexpr double EDGE = 1e-6;           ///< barycentric coordinate below which a hit is on an edge
constexpr double ROUNDINGS = 4;   ///< errors of coordinates relative to the origin, in 2^-24 of
                                  ///< the distance to the farthest corner
constexpr double GRAZING = 1e-3;  ///< cosine between ray and normal

struct Found {
    uint primitive = NO_HIT;
    float t = INFINITY;
};

/// A scene in Embree, with the flag that makes its triangle test watertight.
class EmbreeScene {
public:
    explicit EmbreeScene(const std::vector<Primitive>& triangles)
        : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_))
    {
        rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
        RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* corners = static_cast<vec3*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                    sizeof(vec3), 3 * triangles.size()));
        auto* indices = static_cast<uint*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                    3 * sizeof(uint), triangles.size()));
        for (size_t i = 0; i < triangles.size(); i++) {
            corners[3 * i] = triangles[i].p0;
            corners[3 * i + 1] = triangles[i].p1;
            corners[3 * i + 2] = triangles[i].p2;
            for (size_t k = 0; k < 3; k++) indices[3 * i + k] = static_cast<uint>(3 * i + k);
        }
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(scene_);
    }
    ~EmbreeScene()
    {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    Found closest(const Ray& ray) const
    {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRayHit query = {};
        query.ray.org_x = ray.org.x, query.ray.org_y = ray.org.y, query.ray.org_z = ray.org.z;
        query.ray.dir_x = ray.dir.x, query.ray.dir_y = ray.dir.y, query.ray.dir_z = ray.dir.z;
        query.ray.tfar = INFINITY;
        query.ray.mask = ~0u;
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(scene_, &context, &query);
        if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
        return {query.hit.primID, query.ray.tfar};
    }

private:
    RTCDevice device_;
    RTCScene scene_;
};

/// What two answers for one ray may be to each other.
enum Kind {
    AGREE,
    EDGE_HIT,     ///< the nearer hit is on an edge of its triangle, within rounding
    GRAZING_HIT,  ///< the nearer hit is nearly in the plane of its triangle
    COINCIDENT,   ///< two triangles at the same distance
    SHORT,        ///< one triangle, both distances right within rounding, but close to the origin
    UNCLASSIFIED,
    KIND_COUNT
};

struct Counts {
    std::array<uint64_t, KIND_COUNT> of = {};
    uint64_t hits = 0;
};

/// Where a ray crosses the plane of a triangle, in double precision.
struct Crossing {
    double t;
    double cosine;              ///< between ray and normal
    double smallestCoordinate;  ///< the barycentric coordinate nearest to zero
    double edgeDistance;        ///< distance of the crossing from the nearest edge's line [m]
    double rounding;            ///< of a coordinate relative to the origin [m]
};

Crossing crossing(const Ray& ray, const Primitive& triangle)
{
    const glm::dvec3 org(ray.org), dir(ray.dir), p0(triangle.p0), p1(triangle.p1), p2(triangle.p2);
    const glm::dvec3 normal = glm::cross(p1 - p0, p2 - p0);
    const double size = glm::length(normal);
    const double slope = glm::dot(normal, dir);
    Crossing at = {};
    at.t = glm::dot(normal, p0 - org) / slope;
    at.cosine = std::abs(slope) / size;
    at.smallestCoordinate = at.edgeDistance = INFINITY;
    const glm::dvec3 point = org + at.t * dir;
    for (const auto& [a, b] : {std::pair(p0, p1), std::pair(p1, p2), std::pair(p2, p0)}) {
        const double side = std::abs(glm::dot(normal, glm::cross(a - point, b - point))) / size;
        at.smallestCoordinate = std::min(at.smallestCoordinate, side / size);
        at.edgeDistance = std::min(at.edgeDistance, side / glm::length(b - a));
        at.rounding = std::max(at.rounding, 0x1p-24 * glm::length(a - org));
    }
    return at;
}

/// The nearer of two hits is the one that somebody missed, so that is the one looked at.
Kind classify(const Ray& ray, const Found& ours, const Found& theirs,
              const std::vector<Primitive>& triangles)
{
    if (ours.primitive == NO_HIT && theirs.primitive == NO_HIT) return AGREE;
    const Found& nearer = ours.t <= theirs.t ? ours : theirs;
    const bool bothHit = ours.primitive != NO_HIT && theirs.primitive != NO_HIT;
    const bool sameTriangle = ours.primitive == theirs.primitive;
    if (bothHit && std::abs(double{ours.t} - double{theirs.t}) <= SAME_DISTANCE * nearer.t)
        return sameTriangle ? AGREE : COINCIDENT;
    const Crossing at = crossing(ray, triangles[nearer.primitive]);
    const double tolerance = ROUNDINGS * at.rounding / at.cosine;
    if (sameTriangle && std::abs(ours.t - at.t) <= tolerance &&
        std::abs(theirs.t - at.t) <= tolerance)
        return SHORT;
    if (at.smallestCoordinate < EDGE || at.edgeDistance < tolerance) return EDGE_HIT;
    if (at.cosine < GRAZING) return GRAZING_HIT;
    return UNCLASSIFIED;
}

void report(const Ray& ray, const Found& ours, const Found& theirs,
            const std::vector<Primitive>& triangles)
{
    const Found& nearer = ours.t <= theirs.t ? ours : theirs;
    const Crossing at = crossing(ray, triangles[nearer.primitive]);
    ADD_FAILURE() << "org " << ray.org.x << ' ' << ray.org.y << ' ' << ray.org.z << " dir "
                  << ray.dir.x << ' ' << ray.dir.y << ' ' << ray.dir.z << ": ours "
                  << ours.primitive << " at " << ours.t << ", Embree's " << theirs.primitive
                  << " at " << theirs.t << ", in double " << at.t << ", cosine " << at.cosine
                  << ", smallest coordinate " << at.smallestCoordinate;
}

Counts compare(const std::vector<Primitive>& triangles, const std::vector<Ray>& rays)
{
    const unsigned threads = defaultThreadCount();
    const Bvh bvh = buildBvh(triangles, BvhBuild::sweep, threads);
    const EmbreeScene embree(triangles);
    Counts total;
    std::mutex mutex;
    constexpr size_t CHUNK = 4096;
    parallelFor((rays.size() + CHUNK - 1) / CHUNK, threads, [&](size_t chunk) {
        auto kernel = kernelFor<ORDER_NEAR_FIRST>(bvh);
        Counts counts;
        const size_t end = std::min(rays.size(), (chunk + 1) * CHUNK);
        for (size_t i = chunk * CHUNK; i < end; i++) {
            const TraceHit hit = kernel.traceRay({rays[i].org, kernel.RAY_INFINITY, rays[i].dir, 0}, false);
            Found ours;
            if (hit.number != NO_HIT) ours = {hit.number, hit.tHit};
            const Found theirs = embree.closest(rays[i]);
            const Kind kind = classify(rays[i], ours, theirs, triangles);
            counts.of[kind]++;
            counts.hits += ours.primitive != NO_HIT;
            if (kind == UNCLASSIFIED && counts.of[kind] == 1) {
                std::lock_guard lock(mutex);
                report(rays[i], ours, theirs, triangles);
            }
        }
        std::lock_guard lock(mutex);
        total.hits += counts.hits;
        for (size_t kind = 0; kind < KIND_COUNT; kind++) total.of[kind] += counts.of[kind];
    });
    return total;
}

void expectAgreement(const std::vector<Primitive>& triangles, const std::vector<Ray>& rays)
{
    const Counts counts = compare(triangles, rays);
    EXPECT_EQ(counts.of[UNCLASSIFIED], 0u);
    EXPECT_LE(rays.size() - counts.of[AGREE], rays.size() / 1000);
    EXPECT_GT(counts.hits, rays.size() / 10);
    std::printf("%zu rays, %lu hits: %lu agree, %lu edge, %lu grazing, %lu coincident, %lu short, "
                "%lu unclassified\n",
                rays.size(), counts.hits, counts.of[AGREE], counts.of[EDGE_HIT],
                counts.of[GRAZING_HIT], counts.of[COINCIDENT], counts.of[SHORT],
                counts.of[UNCLASSIFIED]);
}

void expectAgreementOn(const char* mesh, size_t count)
{
    const Scene scene = loadScene(assetFolder() / mesh, {});
    expectAgreement(scene.primitives, primaryRays(scene.camera, count, 41));
    expectAgreement(scene.primitives, randomRays(scene.primitives, count, 42));
}

TEST(EmbreeHits, bunny_everyDisagreementIsRounding)
{
    SAHL_REQUIRE_ASSET("meshes/miro/bunny.obj");
    expectAgreementOn("meshes/miro/bunny.obj", 100'000);
}

TEST(EmbreeHits, sponza_everyDisagreementIsRounding)
{
    SAHL_REQUIRE_ASSET("meshes/miro/sponza.obj");
    expectAgreementOn("meshes/miro/sponza.obj", 100'000);
}

TEST(EmbreeHits, soup_everyDisagreementIsRounding)
{
    const std::vector<Primitive> soup = randomSoup(2000, 0.2f, 43);
    expectAgreement(soup, randomRays(soup, 50'000, 44));
}

TEST(LongEmbreeHits, bunny_everyDisagreementIsRounding)
{
    SAHL_REQUIRE_ASSET("meshes/miro/bunny.obj");
    expectAgreementOn("meshes/miro/bunny.obj", 1'000'000);
}

TEST(LongEmbreeHits, sponza_everyDisagreementIsRounding)
{
    SAHL_REQUIRE_ASSET("meshes/miro/sponza.obj");
    expectAgreementOn("meshes/miro/sponza.obj", 1'000'000);
}

}  // namespace
}  // namespace sahl::testing
