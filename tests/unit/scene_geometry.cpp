// Angles, cameras, transforms, polygons and procedural shapes.
#include "scene/angles.h"
#include "scene/camera.h"
#include "scene/mesh.h"
#include "scene/numbers.h"
#include "scene/polygon.h"
#include "scene/primitives.h"
#include "support/scene_files.h"
#include "support/source_folder.h"

#include <cmath>
#include <limits>
#include <map>

namespace sahl {
namespace {

using namespace sahl::testing;

TEST(Angles, agreeWithTheLibraryAndAreExactAtQuarters)
{
    const double radians = 3.14159265358979323846 / 180;
    for (double degrees = -1000; degrees <= 1000; degrees += 0.37) {
        EXPECT_NEAR(sinDeg(degrees), std::sin(degrees * radians), 1e-14) << degrees;
        EXPECT_NEAR(cosDeg(degrees), std::cos(degrees * radians), 1e-14) << degrees;
    }
    EXPECT_EQ(sinDeg(90), 1);
    EXPECT_EQ(cosDeg(90), 0);
    EXPECT_EQ(sinDeg(-180), 0);
    EXPECT_EQ(cosDeg(180), -1);
    EXPECT_EQ(cosDeg(-3600), 1);
}

TEST(Numbers, readsDecimalNumbersOnly)
{
    double value = 7;
    EXPECT_EQ(parseNumber("+1.5e1", value), NumberText::fine);
    EXPECT_EQ(value, 15);
    EXPECT_EQ(parseNumber("1e-400", value), NumberText::fine);
    EXPECT_EQ(value, 0);
    EXPECT_EQ(parseNumber("1e400", value), NumberText::notFinite);
    EXPECT_EQ(parseNumber("-nan", value), NumberText::notFinite);
    EXPECT_EQ(parseNumber("3.5e38", value), NumberText::notFinite);
    for (const char* text : {"", "+", "-", "+-1", "1.5x", "0x1", "1,5", "e5", " 1", "1e"}) {
        EXPECT_EQ(parseNumber(text, value), NumberText::notANumber) << text;
    }
}

TEST(Numbers, tinyMagnitudesBecomePositiveZero)
{
    EXPECT_EQ(toFloat(-1e-31), 0.0f);
    EXPECT_FALSE(std::signbit(toFloat(-1e-31)));
    EXPECT_FALSE(std::signbit(toFloat(-0.0)));
    EXPECT_NE(toFloat(-1.1e-30), 0.0f);
}

/// Direction in which a pixel position is seen.
vec3 directionAt(const Camera& c, float x, float y, float width, float height)
{
    return c.forward + c.right * (x * 2 / width - 1) + c.down * (y * 2 / height - 1);
}

TEST(CameraTest, looksDownMinusZWithXRightAndYUp)
{
    CameraDescription d;
    d.fovDeg = 90;
    const Camera camera = makeCamera(d, 200, 100);
    EXPECT_EQ(camera.position, vec3(0, 0, 5));
    EXPECT_EQ(camera.forward, vec3(0, 0, -1));
    const vec3 topLeft = directionAt(camera, 0, 0, 200, 100);
    EXPECT_FLOAT_EQ(topLeft.x, -2);
    EXPECT_FLOAT_EQ(topLeft.y, 1);
    const vec3 bottomRight = directionAt(camera, 200, 100, 200, 100);
    EXPECT_FLOAT_EQ(bottomRight.x, 2);
    EXPECT_FLOAT_EQ(bottomRight.y, -1);
}

TEST(CameraTest, fovAxisSaysWhichSideTheAngleSpans)
{
    CameraDescription d;
    d.fovDeg = 90;
    d.fovHorizontal = true;
    const Camera camera = makeCamera(d, 200, 100);
    EXPECT_FLOAT_EQ(glm::length(camera.right), 1);
    EXPECT_FLOAT_EQ(glm::length(camera.down), 0.5f);
}

TEST(CameraTest, refusesWhatHasNoView)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto errorOf = [](CameraDescription d) {
        return badInputOf([&] { makeCamera(d, 10, 10); });
    };
    for (double fov : {0.0, 180.0, -1.0, nan}) {
        CameraDescription d;
        d.fovDeg = fov;
        EXPECT_CONTAINS(errorOf(d), "fovDeg");
    }
    CameraDescription d;
    d.up = {0, 0, 2};
    EXPECT_CONTAINS(errorOf(d), "parallel");
    d.up = {0, 0, 0};
    EXPECT_CONTAINS(errorOf(d), "parallel");
    d = {};
    d.eye = d.lookAt;
    EXPECT_CONTAINS(errorOf(d), "coincide");
    d.eye = {nan, 0, 0};
    EXPECT_CONTAINS(errorOf(d), "finite");
}

TEST(CameraTest, framedTrianglesLieInsideThePicture)
{
    for (const auto& [width, height] :
         {std::pair{400u, 400u}, std::pair{900u, 200u}, std::pair{200u, 900u}}) {
        Scene scene;
        scene.settings.width = width;
        scene.settings.height = height;
        appendMesh(scene, makeTeapot(4, false), translation({100, -20, 3}),
                   std::vector<uint32_t>{0}, "teapot");
        const Camera camera = makeCamera(framePrimitives(scene), width, height);
        double largest = 0;
        for (const Primitive& t : scene.primitives) {
            const vec3 p = t.p0 - camera.position;
            const float depth = glm::dot(p, camera.forward);
            ASSERT_GT(depth, 0);
            const double x =
                glm::dot(p, camera.right) / glm::dot(camera.right, camera.right) / depth;
            const double y = glm::dot(p, camera.down) / glm::dot(camera.down, camera.down) / depth;
            largest = std::max({largest, std::abs(x), std::abs(y)});
        }
        EXPECT_LT(largest, 0.95);
        EXPECT_GT(largest, 0.5);
    }
}

TEST(TransformTest, rotationIsCounterClockwise)
{
    const glm::dvec3 p = mapPoint(rotation({0, 5, 0}, 90), {1, 2, 0});
    EXPECT_NEAR(p.x, 0, 1e-15);
    EXPECT_NEAR(p.y, 2, 1e-15);
    EXPECT_NEAR(p.z, -1, 1e-15);
}

/// One triangle in the plane x + y = 1 that faces (1, 1, 0), with that normal.
Mesh slopingTriangle()
{
    Mesh mesh;
    mesh.positions = {{1, 0, 0}, {0, 1, 0}, {0, 1, 1}};
    mesh.normals = {{1, 1, 0}};
    mesh.triangles = {{{0, 1, 2}, {0, 0, 0}}};
    return mesh;
}

vec3 facetNormal(const Primitive& t)
{
    return glm::normalize(glm::cross(t.p1 - t.p0, t.p2 - t.p0));
}

TEST(AppendMesh, normalsStayPerpendicularUnderNonUniformScale)
{
    Scene scene;
    appendMesh(scene, slopingTriangle(), scaling({3, 1, 1}), std::vector<uint32_t>{0}, "mesh");
    const vec3 n = scene.triangleCorners.at(0).n0;
    const vec3 facet = facetNormal(scene.primitives.at(0));
    EXPECT_NEAR(glm::length(n - facet), 0, 1e-6);
    EXPECT_NEAR(n.x * 3, n.y, 1e-6);
}

TEST(AppendMesh, mirroringKeepsFrontsInFront)
{
    Scene scene;
    appendMesh(scene, slopingTriangle(), scaling({-1, 1, 1}), std::vector<uint32_t>{0}, "mesh");
    const vec3 expected = glm::normalize(vec3(-1, 1, 0));
    EXPECT_NEAR(glm::length(facetNormal(scene.primitives.at(0)) - expected), 0, 1e-6);
    EXPECT_NEAR(glm::length(scene.triangleCorners.at(0).n2 - expected), 0, 1e-6);
    EXPECT_EQ(scene.primitives[0].p0, vec3(-1, 0, 0));
}

TEST(AppendMesh, refusesCoordinatesThatOverflow)
{
    Scene scene;
    const std::string error = badInputOf([&] {
        appendMesh(scene, slopingTriangle(), scaling(glm::dvec3(1e39)), std::vector<uint32_t>{0},
                   "mesh");
    });
    EXPECT_CONTAINS(error, "outside the range of numbers");
}

double areaOf(std::span<const vec3> corners, const std::vector<std::array<uint32_t, 3>>& triangles)
{
    double area = 0;
    for (const auto& [a, b, c] : triangles) {
        const vec3 n = glm::cross(corners[b] - corners[a], corners[c] - corners[a]);
        EXPECT_GE(n.y, 0);
        area += n.y / 2;
    }
    return area;
}

TEST(Polygon, aCombOfManyTeethKeepsItsArea)
{
    // Counter-clockwise seen from +Y: the back at z = 2, teeth towards -z, 50 of height 1 and
    // width 1.
    std::vector<vec3> comb = {{0, 0, 2}, {100, 0, 2}};
    for (int tooth = 49; tooth >= 0; tooth--) {
        const auto x = static_cast<float>(2 * tooth);
        for (vec3 p : {vec3(x + 2, 0, 1), vec3(x + 1, 0, 1), vec3(x + 1, 0, 0), vec3(x, 0, 0)})
            comb.push_back(p);
    }
    bool isFan = false;
    const auto triangles = triangulate(comb, isFan);
    EXPECT_FALSE(isFan);
    EXPECT_EQ(triangles.size(), comb.size() - 2);
    EXPECT_DOUBLE_EQ(areaOf(comb, triangles), 150);
}

TEST(Polygon, convexOnesAreFansOfAnySize)
{
    std::vector<vec3> circle;
    for (int i = 0; i < 100000; i++) {
        circle.push_back(
            toFloat(glm::dvec3(1000 * sinDeg(i * 0.0036), 0, 1000 * cosDeg(i * 0.0036))));
    }
    bool isFan = false;
    const auto triangles = triangulate(circle, isFan);
    EXPECT_EQ(triangles.size(), circle.size() - 2);
    EXPECT_EQ(triangles[1], (std::array<uint32_t, 3>{0, 2, 3}));
}

TEST(Polygon, onesThatCrossThemselvesEndInTime)
{
    const std::vector<vec3> bow = {{0, 0, 0}, {1, 0, 1}, {1, 0, 0}, {0, 0, 1}};
    bool isFan = false;
    EXPECT_EQ(triangulate(bow, isFan).size(), 2u);
    const std::vector<vec3> points(300, vec3(1, 1, 1));
    EXPECT_EQ(triangulate(points, isFan).size(), 298u);
}

/// Number of triangles at each edge, corners at equal positions counted as one.
std::map<int, int> edgeCounts(const Mesh& mesh)
{
    using Key = std::array<float, 6>;
    std::map<Key, int> edges;
    for (const MeshTriangle& t : mesh.triangles) {
        for (size_t k = 0; k < 3; k++) {
            vec3 a = mesh.positions[t.position[k]], b = mesh.positions[t.position[(k + 1) % 3]];
            Key forward = {a.x, a.y, a.z, b.x, b.y, b.z}, backward = {b.x, b.y, b.z, a.x, a.y, a.z};
            edges[std::min(forward, backward)]++;
        }
    }
    std::map<int, int> counts;
    for (const auto& [edge, count] : edges) counts[count]++;
    return counts;
}

TEST(Sphere, isClosedRoundAndFacesOutward)
{
    const Mesh mesh = makeSphere({1, 2, 3}, 2, 3, true);
    EXPECT_EQ(mesh.triangles.size(), 1280u);
    EXPECT_EQ(mesh.positions.size(), 642u);
    EXPECT_EQ(edgeCounts(mesh), (std::map<int, int>{{2, 1920}}));
    for (const MeshTriangle& t : mesh.triangles) {
        const vec3 a = mesh.positions[t.position[0]] - vec3(1, 2, 3);
        const vec3 b = mesh.positions[t.position[1]] - vec3(1, 2, 3);
        const vec3 c = mesh.positions[t.position[2]] - vec3(1, 2, 3);
        EXPECT_GT(glm::dot(glm::cross(b - a, c - a), a), 0);
        EXPECT_NEAR(glm::length(a), 2, 1e-6);
        EXPECT_NEAR(glm::length(mesh.normals[t.normal[0]] * 2.0f - a), 0, 1e-6);
    }
}

TEST(Disk, facesItsNormal)
{
    Scene scene;
    appendShape(scene, makeDisk({0, 1, 0}, {0, 3, 0}, 2, 360), {}, 0, "disk");
    double area = 0;
    for (const Primitive& t : scene.primitives) {
        area += glm::cross(t.p1 - t.p0, t.p2 - t.p0).y / 2;
        EXPECT_EQ(t.p1.y, 1);
    }
    EXPECT_NEAR(area, 3.14159265 * 4, 1e-3);
}

TEST(Rectangle, facesEdgeUCrossEdgeV)
{
    Scene scene;
    appendShape(scene, makeRectangle({0, 0, 0}, {2, 0, 0}, {0, 3, 0}), {}, 0, "rectangle");
    ASSERT_EQ(scene.primitives.size(), 2u);
    for (const Primitive& t : scene.primitives) EXPECT_EQ(facetNormal(t), vec3(0, 0, 1));
}

TEST(BuiltInScene, isSmallLitAndTheSameEveryTime)
{
    const Scene scene = builtInScene({});
    EXPECT_EQ(scene.primitives.size(), 2564u);
    EXPECT_EQ(scene.lights.size(), 1u);
    EXPECT_GT(scene.probe.height, 0u);
    for (size_t i = 0; i < scene.primitives.size(); i++) {
        EXPECT_EQ(scene.primitives[i].number, i);
        EXPECT_LT(scene.primitives[i].material, scene.materials.size());
    }
    SceneOptions options;
    options.width = 31;
    options.height = 17;
    EXPECT_EQ(builtInScene(options).settings.width, 31u);
}

TEST(DefaultScene, loadsAndShowsTheWholeTeapot)
{
    const Scene scene = loadScene(sourceFolder() / "scenes/default/default.json", {});
    EXPECT_EQ(scene.droppedTriangles, 0u);
    const Camera& camera = scene.camera;
    size_t teapotTriangles = 0;
    for (const Primitive& t : scene.primitives) {
        if (scene.materialNames.at(t.material) != "clay") continue;
        teapotTriangles++;
        const vec3 p = t.p0 - camera.position;
        const float depth = glm::dot(p, camera.forward);
        EXPECT_LT(
            std::abs(glm::dot(p, camera.right) / glm::dot(camera.right, camera.right) / depth),
            0.9);
        EXPECT_LT(std::abs(glm::dot(p, camera.down) / glm::dot(camera.down, camera.down) / depth),
                  0.9);
    }
    EXPECT_GT(teapotTriangles, 30000u);
}

}  // namespace
}  // namespace sahl
