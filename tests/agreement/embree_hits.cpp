// Closest hits against Embree, which shares no line with ours. The two may disagree where rounding
// decides, and every such ray must be one of the kinds below.
#include "agreement/rays.h"
#include "support/assets.h"
#include "util/parallel.h"

#include <embree3/rtcore.h>
#include <gtest/gtest.h>

#include <cmath>
#include <mutex>

namespace sahl::testing {
namespace {

constexpr double SAME_DISTANCE = 1e-5;  ///< relative; Embree computes t from other operations
constexpr double EDGE = 1e-6;           ///< barycentric coordinate below which a hit is on an edge
constexpr double GRAZING = 1e-3;        ///< cosine between ray and normal

struct Found {
    uint primitive = NO_HIT;
    float t = INFINITY;
};

/// A scene in Embree, with the flag that makes its triangle test watertight.
class EmbreeScene {
public:
    explicit EmbreeScene(const std::vector<Triangle>& triangles)
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
        query.ray.mask = 0xffffffffu;
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(scene_, &context, &query);
        if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
        return {query.hit.primID, query.ray.tfar};
    }

private:
    RTCDevice device_;
    RTCScene scene_;
};

enum class Kind { agree, edge, grazing, coincident, unclassified };

struct Counts {
    uint64_t agree = 0, edge = 0, grazing = 0, coincident = 0, unclassified = 0, hits = 0;
};

/// Smallest barycentric coordinate (absolute) of the ray's crossing of the triangle's plane, and
/// the cosine between the ray and the normal, in double precision.
struct Crossing {
    double smallestBarycentric, cosine;
    double t;
    double tError;  ///< what rounding may do to t, see classify()
};

Crossing crossing(const Ray& ray, const Triangle& triangle)
{
    const glm::dvec3 org(ray.org), dir(ray.dir), p0(triangle.p0), p1(triangle.p1), p2(triangle.p2);
    const glm::dvec3 normal = glm::cross(p1 - p0, p2 - p0);
    const double slope = glm::dot(normal, dir);
    const double t = glm::dot(normal, p0 - org) / slope;
    const glm::dvec3 point = org + t * dir;
    auto share = [&](const glm::dvec3& a, const glm::dvec3& b) {
        return std::abs(glm::dot(normal, glm::cross(a - point, b - point)) /
                        glm::dot(normal, normal));
    };
    const double cosine = std::abs(slope) / glm::length(normal);
    const double reach =
        std::max({glm::length(p0 - org), glm::length(p1 - org), glm::length(p2 - org)});
    return {std::min({share(p1, p2), share(p2, p0), share(p0, p1)}), cosine, t,
            0x1p-24 * reach / cosine};
}

/// What a ray's two answers are to each other. The nearer of two hits is what one side missed.
Kind classify(const Ray& ray, const Found& ours, const Found& theirs,
              const std::vector<Triangle>& triangles)
{
    if (ours.primitive == NO_HIT && theirs.primitive == NO_HIT) return Kind::agree;
    const Found& nearer = ours.t <= theirs.t ? ours : theirs;
    const bool bothHit = ours.primitive != NO_HIT && theirs.primitive != NO_HIT;
    const bool sameDistance =
        bothHit && std::abs(double{ours.t} - double{theirs.t}) <= SAME_DISTANCE * double{nearer.t};
    if (sameDistance) return ours.primitive == theirs.primitive ? Kind::agree : Kind::coincident;
    const Crossing at = crossing(ray, triangles[nearer.primitive]);
    if (at.smallestBarycentric < EDGE) return Kind::edge;
    if (at.cosine < GRAZING) return Kind::grazing;
    return Kind::unclassified;
}

void report(const Ray& ray, const Found& ours, const Found& theirs,
            const std::vector<Triangle>& triangles)
{
    const Found& nearer = ours.t <= theirs.t ? ours : theirs;
    const Crossing at = crossing(ray, triangles[nearer.primitive]);
    ADD_FAILURE() << "org " << ray.org.x << ' ' << ray.org.y << ' ' << ray.org.z << " dir "
                  << ray.dir.x << ' ' << ray.dir.y << ' ' << ray.dir.z << ": ours "
                  << ours.primitive << " at " << ours.t << ", Embree's " << theirs.primitive
                  << " at " << theirs.t << ", smallest barycentric " << at.smallestBarycentric
                  << ", cosine " << at.cosine << ", errors of t "
                  << (ours.t - at.t) / at.tError << " and " << (theirs.t - at.t) / at.tError
                  << " roundings";
}

Counts compare(const std::vector<Triangle>& triangles, const std::vector<Ray>& rays)
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
            const Traversal walk = closestHit(kernel, rays[i]);
            Found ours;
            if (walk.slot != NO_HIT) ours = {walk.primitive, walk.tHit};
            const Found theirs = embree.closest(rays[i]);
            const Kind kind = classify(rays[i], ours, theirs, triangles);
            counts.hits += ours.primitive != NO_HIT;
            counts.agree += kind == Kind::agree;
            counts.edge += kind == Kind::edge;
            counts.grazing += kind == Kind::grazing;
            counts.coincident += kind == Kind::coincident;
            counts.unclassified += kind == Kind::unclassified;
            if (kind == Kind::unclassified && counts.unclassified <= 3) {
                std::lock_guard lock(mutex);
                report(rays[i], ours, theirs, triangles);
            }
        }
        std::lock_guard lock(mutex);
        total.hits += counts.hits;
        total.agree += counts.agree;
        total.edge += counts.edge;
        total.grazing += counts.grazing;
        total.coincident += counts.coincident;
        total.unclassified += counts.unclassified;
    });
    return total;
}

void expectAgreement(const std::vector<Triangle>& triangles, const std::vector<Ray>& rays)
{
    const Counts counts = compare(triangles, rays);
    EXPECT_EQ(counts.unclassified, 0u);
    EXPECT_GT(counts.hits, rays.size() / 10);
    std::printf("%zu rays, %lu hits: %lu agree, %lu edge, %lu grazing, %lu coincident, "
                "%lu unclassified\n",
                rays.size(), counts.hits, counts.agree, counts.edge, counts.grazing,
                counts.coincident, counts.unclassified);
}

void expectAgreementOn(const char* mesh, size_t count)
{
    const Scene scene = loadScene(assetFolder() / mesh, {});
    expectAgreement(scene.triangles, primaryRays(scene.camera, count, 41));
    expectAgreement(scene.triangles, randomRays(scene.triangles, count, 42));
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
    const std::vector<Triangle> soup = randomSoup(2000, 0.2f, 43);
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
