#include "scene/primitives.h"

#include "scene/angles.h"
#include "scene/numbers.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace sahl {

namespace {

glm::dvec3 unit(const glm::dvec3& v)
{
    return v / std::sqrt(glm::dot(v, v));
}

/// A unit sphere's corners and triangles, refined level by level.
struct Icosphere {
    std::vector<glm::dvec3> points;
    std::vector<std::array<uint32_t, 3>> triangles;
};

Icosphere icosahedron()
{
    const double golden = (1 + std::sqrt(5.0)) / 2;
    Icosphere sphere;
    for (int axis = 0; axis < 3; axis++) {
        for (double a : {-1.0, 1.0}) {
            for (double b : {-golden, golden}) {
                glm::dvec3 p(0.0);
                p[(axis + 1) % 3] = a;
                p[(axis + 2) % 3] = b;
                sphere.points.push_back(unit(p));
            }
        }
    }
    // Every three corners at the distance of neighbours are a face; the edge is 2 before scaling.
    const double edge2 = 4 / (1 + golden * golden) * 1.01;
    auto near = [&](uint32_t i, uint32_t j) {
        glm::dvec3 d = sphere.points[i] - sphere.points[j];
        return glm::dot(d, d) < edge2;
    };
    for (uint32_t i = 0; i < 12; i++) {
        for (uint32_t j = i + 1; j < 12; j++) {
            for (uint32_t k = j + 1; k < 12; k++) {
                if (!near(i, j) || !near(j, k) || !near(k, i)) continue;
                const auto& p = sphere.points;
                bool outward = glm::dot(glm::cross(p[j] - p[i], p[k] - p[i]), p[i]) > 0;
                sphere.triangles.push_back({i, outward ? j : k, outward ? k : j});
            }
        }
    }
    return sphere;
}

Icosphere refine(Icosphere coarse)
{
    Icosphere fine;
    fine.points = std::move(coarse.points);
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    auto middle = [&](uint32_t i, uint32_t j) {
        auto [entry, isNew] = middles.emplace(std::minmax(i, j), uint32_t(fine.points.size()));
        if (isNew) fine.points.push_back(unit(fine.points[i] + fine.points[j]));
        return entry->second;
    };
    for (const auto& [a, b, c] : coarse.triangles) {
        uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        fine.triangles.push_back({a, ab, ca});
        fine.triangles.push_back({ab, b, bc});
        fine.triangles.push_back({ca, bc, c});
        fine.triangles.push_back({ab, bc, ca});
    }
    return fine;
}

/// A triangle whose corners' texture coordinates have the indices of their positions.
void addTriangle(Mesh& mesh, const std::array<uint32_t, 3>& corners)
{
    MeshTriangle triangle;
    triangle.position = triangle.uv = corners;
    mesh.triangles.push_back(triangle);
}

}  // namespace

Mesh makeSphere(const glm::dvec3& center, double radius, uint32_t level, bool smooth)
{
    Icosphere sphere = icosahedron();
    for (uint32_t i = 0; i < level; i++) sphere = refine(std::move(sphere));
    Mesh mesh;
    for (const glm::dvec3& p : sphere.points) {
        mesh.positions.push_back(toFloat(center + p * radius));
        if (smooth) mesh.normals.push_back(toFloat(p));
    }
    for (const auto& t : sphere.triangles) {
        MeshTriangle triangle;
        triangle.position = t;
        if (smooth) triangle.normal = t;
        mesh.triangles.push_back(triangle);
    }
    return mesh;
}

Mesh makeRectangle(const glm::dvec3& corner, const glm::dvec3& edgeU, const glm::dvec3& edgeV)
{
    Mesh mesh;
    mesh.positions = {toFloat(corner), toFloat(corner + edgeU), toFloat(corner + edgeU + edgeV),
                      toFloat(corner + edgeV)};
    mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    addTriangle(mesh, {0, 1, 2});
    addTriangle(mesh, {0, 2, 3});
    return mesh;
}

Mesh makeDisk(const glm::dvec3& center, const glm::dvec3& normal, double radius, uint32_t segments)
{
    glm::dvec3 n = unit(normal);
    glm::dvec3 helper = std::abs(n.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    glm::dvec3 s = unit(glm::cross(helper, n));
    glm::dvec3 t = glm::cross(n, s);
    Mesh mesh;
    mesh.positions.push_back(toFloat(center));
    mesh.uvs.emplace_back(0.5f, 0.5f);
    for (uint32_t i = 0; i < segments; i++) {
        double angle = 360.0 * i / segments;
        mesh.positions.push_back(
            toFloat(center + s * (radius * cosDeg(angle)) + t * (radius * sinDeg(angle))));
        mesh.uvs.emplace_back(toFloat(0.5 + 0.5 * cosDeg(angle)), toFloat(0.5 + 0.5 * sinDeg(angle)));
        addTriangle(mesh, {0, 1 + i, 1 + (i + 1) % segments});
    }
    return mesh;
}

}  // namespace sahl
