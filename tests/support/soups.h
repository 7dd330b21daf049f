// Primitives for tests of the tree and of traversal: made from fixed seeds, nice and nasty.
#pragma once

#include "shared/scene_types.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace sahl::testing {

/// A small generator with the same sequence on every compiler (splitmix64, Steele et al. 2014).
class Random {
public:
    explicit Random(uint64_t seed) : state_(seed) {}

    uint64_t bits()
    {
        uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    /// In [0,1).
    float uniform() { return static_cast<float>(bits() >> 40) * 0x1p-24f; }
    float uniform(float lo, float hi) { return lo + (hi - lo) * uniform(); }
    /// In [0, count).
    uint below(uint count) { return static_cast<uint>(bits() % count); }
    vec3 inCube(float half)
    {
        float x = uniform(-half, half);
        float y = uniform(-half, half);
        return {x, y, uniform(-half, half)};
    }
    /// Unit, uniform over the sphere.
    vec3 direction()
    {
        for (;;) {
            const vec3 v = inCube(1);
            const float size2 = glm::dot(v, v);
            if (size2 > 0.01f && size2 < 1) return v / std::sqrt(size2);
        }
    }

private:
    uint64_t state_;
};

inline void addTriangle(std::vector<Primitive>& triangles, vec3 p0, vec3 p1, vec3 p2)
{
    uint number = static_cast<uint>(triangles.size());
    triangles.push_back({p0, number, p1, 0, p2, SHAPE_FLAT});
}

inline void addSphere(std::vector<Primitive>& primitives, vec3 centre, float radius)
{
    uint number = static_cast<uint>(primitives.size());
    primitives.push_back({centre, number, {radius, 0, 0}, 0, {0, 0, 0}, SHAPE_SPHERE});
}

/// `count` triangles of about `size`, anywhere in the cube of half edge 1.
inline std::vector<Primitive> randomSoup(uint count, float size, uint64_t seed)
{
    Random random(seed);
    std::vector<Primitive> triangles;
    for (uint i = 0; i < count; i++) {
        vec3 p = random.inCube(1.0f);
        vec3 e1 = random.inCube(size);
        addTriangle(triangles, p, p + e1, p + random.inCube(size));
    }
    return triangles;
}

/// A closed wavy torus of 2 * rings * sides triangles that share their corners, like a scanned
/// mesh.
inline std::vector<Primitive> torus(uint rings, uint sides)
{
    auto corner = [&](uint ring, uint side) {
        double u = 2 * M_PI * (ring % rings) / rings, v = 2 * M_PI * (side % sides) / sides;
        double r = 0.4 + 0.05 * std::sin(7 * u) * std::cos(5 * v);
        double x = (1 + r * std::cos(v)) * std::cos(u), z = (1 + r * std::cos(v)) * std::sin(u);
        return vec3(static_cast<float>(x), static_cast<float>(r * std::sin(v)),
                    static_cast<float>(z));
    };
    std::vector<Primitive> triangles;
    for (uint ring = 0; ring < rings; ring++) {
        for (uint side = 0; side < sides; side++) {
            vec3 a = corner(ring, side), b = corner(ring + 1, side);
            vec3 c = corner(ring + 1, side + 1), d = corner(ring, side + 1);
            addTriangle(triangles, a, b, c);
            addTriangle(triangles, a, c, d);
        }
    }
    return triangles;
}

}  // namespace sahl::testing
