#include "app/bench/rays.h"

#include "bvh/box.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sahl {

TraceRay cameraRay(const Camera& camera, float sx, float sy)
{
    const vec3 aside = camera.right * sx + camera.down * sy;
    if (camera.type == CAMERA_ORTHOGRAPHIC) return {camera.position + aside, 3e38f, camera.forward, 0};
    return {camera.position, 3e38f, glm::normalize(camera.forward + aside), 0};
}

// Frisvad's basis, as revised by Duff et al. 2017.
vec3 diffuseDirection(const vec3& n, Numbers& random)
{
    const float u = random.next(), angle = 2 * std::numbers::pi_v<float> * random.next();
    const float radius = std::sqrt(u), sign = std::copysign(1.0f, n.z);
    const float a = -1 / (sign + n.z), b = n.x * n.y * a;
    const vec3 s(1 + sign * n.x * n.x * a, sign * b, -sign * n.x), t(b, sign + n.y * n.y * a, -n.y);
    return glm::normalize(s * (radius * std::cos(angle)) + t * (radius * std::sin(angle)) + n * std::sqrt(1 - u));
}

vec3 offSurface(const vec3& point, const vec3& normal)
{
    const vec3 size = glm::abs(point);
    return point + normal * (1e-5f * std::max({size.x, size.y, size.z, 1e-3f}));
}

namespace {

/// Calls visit(x, y) for every pixel of a picture, in blocks of 8 x 8, and in each of these in blocks of 4 x 2, as
/// invocations of a device that renders pictures lie side by side (kernels/path.comp).
template <class Visit>
void forEachPixel(uint32_t size, Visit visit)
{
    constexpr uint32_t BLOCK = 8;
    for (uint32_t top = 0; top < size; top += BLOCK) {
        for (uint32_t left = 0; left < size; left += BLOCK) {
            for (uint32_t i = 0; i < BLOCK * BLOCK; i++) {
                const uint32_t inBlock = i % 8, block = i / 8;
                const uint32_t x = left + block % 2 * 4 + inBlock % 4, y = top + block / 2 * 2 + inBlock / 4;
                if (x < size && y < size) visit(x, y);
            }
        }
    }
}

std::vector<TraceRay> primaryRays(const Camera& camera, uint32_t size)
{
    Numbers random(1);
    std::vector<TraceRay> rays;
    rays.reserve(size_t{size} * size);
    forEachPixel(size, [&](uint32_t x, uint32_t y) {
        const float px = float(x) + random.next(), py = float(y) + random.next();
        rays.push_back(cameraRay(camera, 2 * px / float(size) - 1, 2 * py / float(size) - 1));
    });
    return rays;
}

struct Surface {
    vec3 point;   ///< moved off the surface a little
    vec3 normal;  ///< unit, on the side of the ray
};

Surface surfaceAt(const TraceRay& ray, const TraceHit& hit, const Primitive& shape)
{
    const vec3 point = ray.org + ray.dir * hit.tHit;
    vec3 normal = shape.shape == SHAPE_SPHERE ? point - shape.p0
                                              : glm::cross(shape.p1 - shape.p0, shape.p2 - shape.p0);
    normal = glm::normalize(normal);
    if (glm::dot(normal, ray.dir) > 0) normal = -normal;
    return {offSurface(point, normal), normal};
}

/// Ends a little before the target.
TraceRay rayBetween(const vec3& from, const vec3& to)
{
    const float distance = glm::length(to - from);
    return {from, 0.999f * distance, (to - from) / distance, 0};
}

}  // namespace

std::vector<RaySet> makeRays(const Scene& scene, const DeviceScene& prepared, uint32_t size, unsigned threads)
{
    RaySet primary = {"primary", false, primaryRays(scene.camera, size)};
    RaySet shadow = {"shadow", true, {}}, diffuse = {"diffuse", false, {}};

    std::vector<TraceHit> hits(primary.rays.size());
    DeviceOptions options;
    options.threads = threads;
    const std::unique_ptr<Device> tracer = makeCpuDevice(options);
    tracer->setScene(prepared);
    tracer->traceRays(primary.rays, false, hits);

    std::vector<uint> slots(prepared.primitives.size());
    Box box;
    for (uint slot = 0; slot < prepared.primitives.size(); slot++) {
        slots[prepared.primitives[slot].number] = slot;
        grow(box, extentOf(prepared.primitives[slot]));
    }
    Numbers random(2);
    for (size_t i = 0; i < hits.size(); i++) {
        if (hits[i].number == NO_HIT) continue;
        const Surface surface = surfaceAt(primary.rays[i], hits[i], prepared.primitives[slots[hits[i].number]]);
        const float u = random.next(), v = random.next(), w = random.next();
        shadow.rays.push_back(rayBetween(surface.point, box.lo + (box.hi - box.lo) * vec3(u, v, w)));
        diffuse.rays.push_back({surface.point, 3e38f, diffuseDirection(surface.normal, random), 0});
    }
    return {std::move(primary), std::move(shadow), std::move(diffuse)};
}

}  // namespace sahl
