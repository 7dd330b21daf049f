// Embree's scenes and single rays.
#include "app/bench/embree.h"

#include "app/bench/embree_library.h"
#include "util/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace sahl {

namespace {

class LoadedScene final : public EmbreeScene {
public:
    LoadedScene(const EmbreeLibrary& library, std::span<const Primitive> primitives, EmbreeBuild build,
                unsigned threads)
        : library_(library),
          threads_(threads),
          device_(library.newDevice(fmt::format("threads={}", threads).c_str())),
          scene_(library.newScene(device_))
    {
        library.setSceneBuildQuality(
            scene_, build == EmbreeBuild::high ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM);
        fill(primitives);
        const auto start = std::chrono::steady_clock::now();
        library.commitScene(scene_);
        buildSeconds_ = secondsSince(start);
    }
    ~LoadedScene() override
    {
        library_.releaseScene(scene_);
        library_.releaseDevice(device_);
    }
    LoadedScene(const LoadedScene&) = delete;
    LoadedScene& operator=(const LoadedScene&) = delete;

    double buildSeconds() const override { return buildSeconds_; }

    double trace(std::span<const TraceRay> rays, bool anyHit, std::span<TraceHit> hits) const override
    {
        constexpr size_t CHUNK = 4096;
        const auto start = std::chrono::steady_clock::now();
        parallelFor((rays.size() + CHUNK - 1) / CHUNK, threads_, [&](size_t chunk) {
            const size_t end = std::min(rays.size(), (chunk + 1) * CHUNK);
            for (size_t i = chunk * CHUNK; i < end; i++)
                hits[i] = anyHit ? occluded(rays[i]) : closest(rays[i]);
        });
        return secondsSince(start);
    }

    bool meets(const TraceRay& ray, float& tHit, vec3& normal) const override
    {
        const RTCRayHit query = intersect(ray);
        tHit = query.ray.tfar;
        normal = {query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z};
        return query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    }

private:
    static double secondsSince(std::chrono::steady_clock::time_point start)
    {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    void fill(std::span<const Primitive> primitives)
    {
        size_t count = 0;
        for (const Primitive& primitive : primitives) count += primitive.shape != SHAPE_SPHERE;
        RTCGeometry geometry = library_.newGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* corners = static_cast<vec3*>(library_.setNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(vec3), 3 * count));
        auto* indices = static_cast<uint*>(library_.setNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(uint), count));
        for (const Primitive& primitive : primitives) {
            if (primitive.shape == SHAPE_SPHERE) continue;
            const auto first = static_cast<uint>(3 * numbers_.size());
            for (const vec3& corner : {primitive.p0, primitive.p1, primitive.p2}) *corners++ = corner;
            for (uint k = 0; k < 3; k++) *indices++ = first + k;
            numbers_.push_back(primitive.number);
        }
        library_.commitGeometry(geometry);
        library_.attachGeometry(scene_, geometry);
        library_.releaseGeometry(geometry);
    }

    static RTCRay rayOf(const TraceRay& ray)
    {
        RTCRay query = {};
        query.org_x = ray.org.x, query.org_y = ray.org.y, query.org_z = ray.org.z;
        query.dir_x = ray.dir.x, query.dir_y = ray.dir.y, query.dir_z = ray.dir.z;
        query.tfar = ray.tMax;
        query.mask = ~0u;
        return query;
    }

    RTCRayHit intersect(const TraceRay& ray) const
    {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRayHit query = {};
        query.ray = rayOf(ray);
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        library_.intersect1(scene_, &context, &query);
        return query;
    }

    TraceHit closest(const TraceRay& ray) const
    {
        const RTCRayHit query = intersect(ray);
        const bool met = query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
        return {met ? numbers_[query.hit.primID] : NO_HIT, query.ray.tfar, 0, 0, 0, 0, TRACE_DONE, 0};
    }

    TraceHit occluded(const TraceRay& ray) const
    {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRay query = rayOf(ray);
        library_.occluded1(scene_, &context, &query);
        return {query.tfar < 0 ? 0 : NO_HIT, query.tfar, 0, 0, 0, 0, TRACE_DONE, 0};
    }

    const EmbreeLibrary& library_;
    unsigned threads_;
    RTCDevice device_;
    RTCScene scene_;
    std::vector<uint> numbers_;  // of our primitives, by number of Embree's
    double buildSeconds_ = 0;
};

}  // namespace

std::unique_ptr<EmbreeScene> makeEmbreeScene(std::span<const Primitive> primitives, EmbreeBuild build,
                                             unsigned threads)
{
    const EmbreeLibrary* const library = embreeLibrary();
    if (library == nullptr) return nullptr;
    return std::make_unique<LoadedScene>(*library, primitives, build, threads);
}

}  // namespace sahl
