// Rays of the kinds that a path tracer shoots, made once and traced by all who are compared.
#pragma once

#include "device/device.h"
#include "scene/scene.h"

#include <string>
#include <vector>

namespace sahl {

/// Numbers in [0,1) from a seed: splitmix64, Steele et al. 2014.
class Numbers {
public:
    explicit Numbers(uint64_t seed) : state_(seed) {}

    float next()
    {
        uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return static_cast<float>((z ^ (z >> 31)) >> 40) * 0x1p-24f;
    }

private:
    uint64_t state_;
};

/// Through the point (sx, sy) of the picture, as Camera says; of a pinhole.
TraceRay cameraRay(const Camera& camera, float sx, float sy);

/// By the cosine about the unit normal.
vec3 diffuseDirection(const vec3& normal, Numbers& random);

/// `point` moved off a surface by what its coordinates may be rounded, and a little more.
vec3 offSurface(const vec3& point, const vec3& normal);

struct RaySet {
    std::string kind;
    bool anyHit = false;
    std::vector<TraceRay> rays;
};

/// Three sets, in the order of the pixels:
///   primary  from the camera through a random point of every pixel
///   shadow   from what a primary ray met to a random point of the scene's box; any hit will do
///   diffuse  from there in a direction by the cosine about the normal
/// Deterministic. `prepared` is the scene with its tree, without instances.
std::vector<RaySet> makeRays(const Scene& scene, const DeviceScene& prepared, uint32_t size, unsigned threads);

}  // namespace sahl
