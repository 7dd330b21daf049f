#include "app/bench/embree_paths.h"

#include "app/bench/rays.h"
#include "util/parallel.h"

#include <chrono>

namespace sahl {

namespace {

constexpr float ALBEDO = 0.7f;

struct Sums {
    double light = 0;
    uint64_t rays = 0;
};

/// One path: it is lit where it leaves the scene, which happens after at most maxBounces scatterings.
void addPath(const EmbreeScene& embree, TraceRay ray, uint32_t maxBounces, Numbers& random, Sums& sums)
{
    float beta = 1;
    for (uint32_t depth = 0;; depth++) {
        float t;
        vec3 normal;
        sums.rays++;
        if (!embree.meets(ray, t, normal)) {
            sums.light += double{beta};
            return;
        }
        if (depth == maxBounces) return;
        normal = glm::normalize(normal);
        if (glm::dot(normal, ray.dir) > 0) normal = -normal;
        ray.org = offSurface(ray.org + ray.dir * t, normal);
        ray.dir = diffuseDirection(normal, random);
        beta *= ALBEDO;
    }
}

}  // namespace

EmbreePaths renderOnEmbree(const EmbreeScene& embree, const Scene& scene, uint32_t spp, unsigned threads)
{
    const uint32_t width = scene.settings.width, height = scene.settings.height;
    std::vector<Sums> rows(height);
    const auto start = std::chrono::steady_clock::now();
    parallelFor(height, threads, [&](size_t y) {
        Sums sums;
        for (uint32_t x = 0; x < width; x++) {
            Numbers random((y * width + x) * 0x10001 + 7);
            for (uint32_t i = 0; i < spp; i++) {
                const float px = float(x) + random.next(), py = float(y) + random.next();
                const TraceRay ray =
                    cameraRay(scene.camera, 2 * px / float(width) - 1, 2 * py / float(height) - 1);
                addPath(embree, ray, scene.settings.maxBounces, random, sums);
            }
        }
        rows[y] = sums;
    });
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    Sums all;
    for (const Sums& row : rows) {
        all.light += row.light;
        all.rays += row.rays;
    }
    const double samples = double(width) * height * spp;
    return {seconds.count(), all.light / samples, double(all.rays) / samples};
}

}  // namespace sahl
