// The teapot against its own symmetry and against a tessellation made by other people.
#include "scene/primitives.h"
#include "support/assets.h"
#include "support/scene_files.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace sahl {
namespace {

using namespace sahl::testing;

struct Box {
    vec3 lo = vec3(std::numeric_limits<float>::max());
    vec3 hi = vec3(std::numeric_limits<float>::lowest());
    void add(const vec3& p)
    {
        lo = glm::min(lo, p);
        hi = glm::max(hi, p);
    }
};

/// Point of the triangle nearest to p (Ericson, "Real-Time Collision Detection", 5.1.5).
glm::dvec3 nearestPoint(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                        const glm::dvec3& c)
{
    const glm::dvec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap), d3 = glm::dot(ab, bp);
    const double d4 = glm::dot(ac, bp), d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    if (d1 <= 0 && d2 <= 0) return a;
    if (d3 >= 0 && d4 <= d3) return b;
    if (d6 >= 0 && d5 <= d6) return c;
    const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + ab * (d1 / (d1 - d3));
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + ac * (d2 / (d2 - d6));
    if (va <= 0 && d4 >= d3 && d5 >= d6) return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    return a + ab * (vb / (va + vb + vc)) + ac * (vc / (va + vb + vc));
}

TEST(Teapot, hasTheNumberOfTrianglesThatIsPromised)
{
    for (uint32_t n : {2u, 3u, 7u, 16u}) {
        EXPECT_EQ(makeTeapot(n, true).triangles.size(), 64 * n * n - 8 * n) << n;
    }
}

TEST(Teapot, standsOnTheGroundWithItsSpoutTowardsX)
{
    Box box;
    for (const vec3& p : makeTeapot(16, true).positions) box.add(p);
    EXPECT_EQ(box.lo.y, 0);
    EXPECT_EQ(box.hi.y, 3.15f);
    EXPECT_NEAR(box.lo.x, -3.0, 1e-6);
    EXPECT_NEAR(box.hi.x, 3.434, 0.001);
    EXPECT_NEAR(box.hi.z, 2.0, 0.001);
    EXPECT_EQ(box.lo.z, -box.hi.z);
}

TEST(Teapot, hasNoDegenerateTrianglesAndNormalsOfTheSurface)
{
    for (uint32_t n : {2u, 5u, 32u}) {
        Scene scene;
        appendMesh(scene, makeTeapot(n, true), {}, std::vector<uint32_t>{0}, "teapot");
        EXPECT_EQ(scene.droppedTriangles, 0u);
        for (const Primitive& t : scene.primitives) {
            const vec3 facet = glm::normalize(glm::cross(t.p1 - t.p0, t.p2 - t.p0));
            const TriangleCorners& normals = scene.triangleCorners.at(t.shape);
            for (const vec3& normal : {normals.n0, normals.n1, normals.n2}) {
                EXPECT_NEAR(glm::length(normal), 1, 1e-6);
                // Smooth normals lie close to the facets once these are small.
                if (n == 32) {
                    EXPECT_GT(glm::dot(facet, normal), 0.8);
                }
            }
        }
    }
}

TEST(Teapot, itsPartsAreClosedExceptAtTheirFiveOpenings)
{
    const uint32_t n = 8;
    using Key = std::array<float, 6>;
    std::map<Key, int> edges;
    const Mesh mesh = makeTeapot(n, false);
    for (const MeshTriangle& t : mesh.triangles) {
        for (size_t k = 0; k < 3; k++) {
            const vec3 a = mesh.positions[t.position[k]],
                       b = mesh.positions[t.position[(k + 1) % 3]];
            const Key forward = {a.x, a.y, a.z, b.x, b.y, b.z},
                      backward = {b.x, b.y, b.z, a.x, a.y, a.z};
            edges[std::min(forward, backward)] += forward < backward ? 1 : -1;
            edges.try_emplace(std::min(forward, backward), 0);
        }
    }
    // Edges inside a part are passed once in each direction. The others bound the openings: rim
    // and lid (4 n edges each), both ends of handle and spout (2 n each). Bottom and knob are
    // closed.
    const auto open = std::count_if(edges.begin(), edges.end(),
                                    [](const auto& edge) { return edge.second != 0; });
    EXPECT_EQ(open, 4 * n + 4 * n + 4 * (2 * n));
}

TEST(Teapot, isTheSurfaceThatOthersTessellated)
{
    SAHL_REQUIRE_ASSET("meshes/teapot_6320.obj");
    Scene theirs;
    warningsOf([&] { theirs = loadScene(assetFolder() / "meshes/teapot_6320.obj", {}); });
    const Mesh ours = makeTeapot(40, false);
    double largest = 0;
    for (size_t i = 0; i < theirs.primitives.size(); i += 25) {
        const glm::dvec3 p = theirs.primitives[i].p0;
        double nearest2 = std::numeric_limits<double>::max();
        for (const MeshTriangle& t : ours.triangles) {
            const glm::dvec3 d =
                p - nearestPoint(p, ours.positions[t.position[0]], ours.positions[t.position[1]],
                                 ours.positions[t.position[2]]);
            nearest2 = std::min(nearest2, glm::dot(d, d));
        }
        largest = std::max(largest, std::sqrt(nearest2));
    }
    // Their corners lie on the surface; our facets lie up to 0.0089 inside it at 12 subdivisions
    // and, with the square of the number, 0.0008 at 40.
    EXPECT_LT(largest, 0.0008);
}

}  // namespace
}  // namespace sahl
