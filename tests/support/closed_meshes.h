// Meshes without holes for tests of watertightness: how holes are closed, and which points are
// inside.
#pragma once

#include "scene/mesh.h"
#include "support/soups.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <vector>

namespace sahl::testing {

using Point = std::array<float, 3>;

inline Point keyOf(const vec3& p)
{
    return {p.x, p.y, p.z};
}

/// For each directed edge by how many triangles more it is used than its opposite is; edges by
/// coordinates, so that seams of normals do not count.
inline std::map<std::pair<Point, Point>, int> edgeBalance(std::span<const Primitive> triangles)
{
    std::map<std::pair<Point, Point>, int> balance;
    for (const Primitive& t : triangles) {
        for (const auto& [a, b] :
             {std::pair(t.p0, t.p1), std::pair(t.p1, t.p2), std::pair(t.p2, t.p0)}) {
            balance[{keyOf(a), keyOf(b)}]++;
            balance[{keyOf(b), keyOf(a)}]--;
        }
    }
    return balance;
}

/// True when every edge is used by as many triangles in one direction as in the other.
inline bool isClosed(std::span<const Primitive> triangles)
{
    const auto balance = edgeBalance(triangles);
    return std::all_of(balance.begin(), balance.end(),
                       [](const auto& edge) { return edge.second == 0; });
}

inline std::vector<Primitive> trianglesOf(const Mesh& mesh)
{
    std::vector<Primitive> triangles;
    for (const MeshTriangle& t : mesh.triangles) {
        addTriangle(triangles, mesh.positions[t.position[0]], mesh.positions[t.position[1]],
                    mesh.positions[t.position[2]]);
    }
    return triangles;
}

/// Closes every hole by a fan of triangles around the mean of its rim. The edges that lack their
/// opposite form cycles, whatever the mesh: as many of them enter a corner as leave it. Returns the
/// number of holes.
inline size_t closeHoles(std::vector<Primitive>& triangles)
{
    std::multimap<Point, Point> open;  // from the end of a lacking edge to its start
    for (const auto& [edge, surplus] : edgeBalance(triangles)) {
        for (int i = 0; i < surplus; i++) open.emplace(edge.second, edge.first);
    }
    size_t holes = 0;
    while (!open.empty()) {
        std::vector<vec3> rim;
        const Point start = open.begin()->first;
        Point at = start;
        do {
            const auto next = open.find(at);
            rim.emplace_back(at[0], at[1], at[2]);
            at = next->second;
            open.erase(next);
        } while (at != start);
        glm::dvec3 sum(0);
        for (const vec3& p : rim) sum += glm::dvec3(p);
        const vec3 middle(sum / static_cast<double>(rim.size()));
        for (size_t i = 0; i < rim.size(); i++) {
            addTriangle(triangles, rim[i], rim[(i + 1) % rim.size()], middle);
        }
        holes++;
    }
    return holes;
}

/// How many times the closed surface winds around a point: 0 outside. The solid angles of all
/// triangles over 4 pi (Van Oosterom and Strackee 1983, "The Solid Angle of a Plane Triangle").
inline double windingNumber(std::span<const Primitive> triangles, const vec3& point)
{
    double sum = 0;
    for (const Primitive& t : triangles) {
        const glm::dvec3 o(point), a = glm::dvec3(t.p0) - o, b = glm::dvec3(t.p1) - o,
                                   c = glm::dvec3(t.p2) - o;
        const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
        const double volume = glm::dot(a, glm::cross(b, c));
        const double rest =
            la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
        sum += 2 * std::atan2(volume, rest);
    }
    return sum / (4 * M_PI);
}

}  // namespace sahl::testing
