#include "scene/polygon.h"

#include <cmath>
#include <numeric>

namespace sahl {

namespace {

using Point = glm::dvec2;

/// Twice the signed area of (a, b, c); positive when counter-clockwise.
double signedArea(const Point& a, const Point& b, const Point& c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Newell's normal of a polygon that need not be planar; its length is twice the area.
glm::dvec3 polygonNormal(std::span<const vec3> corners)
{
    glm::dvec3 sum(0.0);
    glm::dvec3 origin = corners[0];
    for (size_t i = 1; i + 1 < corners.size(); i++) {
        sum += glm::cross(glm::dvec3(corners[i]) - origin, glm::dvec3(corners[i + 1]) - origin);
    }
    return sum;
}

/// The polygon seen along its normal's largest component, counter-clockwise.
std::vector<Point> flatten(std::span<const vec3> corners, const glm::dvec3& normal)
{
    glm::dvec3 size = glm::abs(normal);
    int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    int u = (axis + 1) % 3, v = (axis + 2) % 3;
    if (normal[axis] < 0) std::swap(u, v);
    std::vector<Point> flat;
    flat.reserve(corners.size());
    for (const vec3& p : corners) flat.emplace_back(p[u], p[v]);
    return flat;
}

bool isConvex(const std::vector<Point>& p)
{
    for (size_t i = 0; i < p.size(); i++) {
        if (signedArea(p[i], p[(i + 1) % p.size()], p[(i + 2) % p.size()]) < 0) return false;
    }
    return true;
}

bool isInside(const Point& q, const Point& a, const Point& b, const Point& c)
{
    return signedArea(a, b, q) >= 0 && signedArea(b, c, q) >= 0 && signedArea(c, a, q) >= 0;
}

/// Is corner `at` of the ring an ear: convex, and with no other corner inside its triangle?
bool isEar(const std::vector<Point>& p, const std::vector<uint32_t>& ring, size_t at)
{
    size_t n = ring.size();
    const Point& a = p[ring[(at + n - 1) % n]];
    const Point& b = p[ring[at]];
    const Point& c = p[ring[(at + 1) % n]];
    if (signedArea(a, b, c) <= 0) return false;
    for (size_t i = 2; i + 1 < n; i++) {
        const Point& q = p[ring[(at + i) % n]];
        bool isCorner = q == a || q == b || q == c;
        if (!isCorner && isInside(q, a, b, c)) return false;
    }
    return true;
}

std::vector<std::array<uint32_t, 3>> cutEars(const std::vector<Point>& p)
{
    std::vector<uint32_t> ring(p.size());
    std::iota(ring.begin(), ring.end(), 0u);
    std::vector<std::array<uint32_t, 3>> triangles;
    while (ring.size() > 3) {
        size_t n = ring.size();
        size_t ear = 0;
        while (ear < n && !isEar(p, ring, ear)) ear++;
        if (ear == n) ear = 0;  // crosses itself: any cut is as good as another
        triangles.push_back({ring[(ear + n - 1) % n], ring[ear], ring[(ear + 1) % n]});
        ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    triangles.push_back({ring[0], ring[1], ring[2]});
    return triangles;
}

}  // namespace

std::vector<std::array<uint32_t, 3>> triangulate(std::span<const vec3> corners, bool& isFan)
{
    isFan = false;
    if (corners.size() > 3) {
        std::vector<Point> flat = flatten(corners, polygonNormal(corners));
        if (!isConvex(flat)) {
            if (corners.size() <= MAX_EARS) return cutEars(flat);
            isFan = true;
        }
    }
    std::vector<std::array<uint32_t, 3>> fan;
    fan.reserve(corners.size() - 2);
    for (uint32_t i = 1; i + 1 < corners.size(); i++) fan.push_back({0u, i, i + 1});
    return fan;
}

}  // namespace sahl
