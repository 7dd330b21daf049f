// Pictures whose exact value is known: furnaces, planes under known light, the inverse square law.

#include "scene/mesh.h"
#include "scene/primitives.h"
#include "support/render_scenes.h"
#include "support/witness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace sahl::testing {
namespace {

constexpr uint32_t SIZE = 32;

Scene emptyScene(uint32_t maxBounces)
{
    Scene scene;
    scene.name = "closed form";
    scene.settings = {SIZE, SIZE, 0, maxBounces, 0};
    return scene;
}

void setCamera(Scene& scene, glm::dvec3 eye, glm::dvec3 lookAt, double fovDeg)
{
    CameraDescription camera;
    camera.eye = eye;
    camera.lookAt = lookAt;
    camera.up = {0, 0, 1};
    camera.fovDeg = fovDeg;
    scene.camera = makeCamera(camera, SIZE, SIZE);
}

/// A probe of `rows` rows whose radiance is f(y) for directions of height y.
template <class F>
void setProbe(Scene& scene, uint32_t rows, F f)
{
    scene.probe = plainProbe(1, rows, PROBE_LATLONG, FILTER_NEAREST);
    for (uint32_t row = 0; row < rows; row++) {
        double y = std::cos(std::numbers::pi * (row + 0.5) / rows);
        scene.probeTexels.emplace_back(vec3(static_cast<float>(f(y))), 0);
    }
}

Mean frameMean(Scene scene, uint32_t spp)
{
    PreparedScene prepared = prepareScene(std::move(scene), BvhBuild::sweep, 2);
    Film film = renderFilm(*makeCpuDevice({}), prepared, 0, spp);
    EXPECT_EQ(film.counters.badSamples, 0u);
    return greyFrameMean(film);
}

/// Within 4 standard errors and 0.1 %. Where every sample is the same, rounding alone is left: a sum
/// of up to 65 terms in floats, 1e-5 relative.
void expectMean(const Mean& mean, double expected)
{
    showWitness(mean, expected);
    double rounding = 1e-5 * expected;
    EXPECT_NEAR(mean.value, expected, 4 * mean.standardError + rounding);
    EXPECT_NEAR(mean.value, expected, 1e-3 * expected);
}

TEST(Furnace, closedEmittingMeshGivesTheGeometricSeries)
{
    for (uint32_t bounces : {1u, 2u, 8u, 64u}) {
        for (float albedo : {0.2f, 0.5f, 0.9f}) {
            Scene scene = emptyScene(bounces);
            uint32_t material = addMaterial(scene, "wall", vec3(albedo), vec3(1));
            appendShape(scene, makeSphere({0, 0, 0}, 2, 2, false), {}, material, "sphere");
            setCamera(scene, {0.3, -0.2, 0.1}, {1, 1, 1}, 70);
            double expected = (1 - std::pow(double(albedo), bounces + 1)) / (1 - double(albedo));
            expectMean(frameMean(std::move(scene), 8), expected);
        }
    }
}

TEST(Furnace, whiteLambertUnderAWhiteProbeIsInvisible)
{
    Scene scene = emptyScene(200);
    uint32_t material = addMaterial(scene, "white", vec3(1));
    appendShape(scene, makeTeapot(6, false), {}, material, "teapot");
    setProbe(scene, 1, [](double) { return 1.0; });
    setCamera(scene, {0, 9, 6}, {0, 0, 1.5}, 45);
    // Every path that leaves the scene brings 1. A few are still inside after 200 bounces.
    Mean mean = frameMean(std::move(scene), 8);
    EXPECT_NEAR(mean.value, 1, 1e-3);
}

/// A lambert plane y = 0 that fills the view.
Scene planeScene(float albedo)
{
    Scene scene = emptyScene(1);
    uint32_t material = addMaterial(scene, "plane", vec3(albedo));
    appendShape(scene, makeRectangle({-100, 0, 100}, {200, 0, 0}, {0, 0, -200}), {}, material, "plane");
    setCamera(scene, {0, 5, 0}, {0, 0, 0}, 40);
    return scene;
}

TEST(Plane, underAConstantProbeHasAlbedoTimesItsRadiance)
{
    Scene scene = planeScene(0.6f);
    setProbe(scene, 4, [](double) { return 2.5; });
    expectMean(frameMean(std::move(scene), 8), 0.6 * 2.5);
}

TEST(Plane, underAProbeOfCosinesHasTwoThirdsOfItsAlbedo)
{
    // Irradiance of L = cos over pi: 2 * integral of c^2 dc from 0 to 1 = 2/3.
    Scene scene = planeScene(0.6f);
    setProbe(scene, 2048, [](double y) { return std::max(0.0, y); });
    expectMean(frameMean(std::move(scene), 1024), 0.6 * 2 / 3);
}

TEST(Plane, underAnOvercastSkyHasSevenNinthsOfTheZenith)
{
    // CIE overcast sky L = (1 + 2 cos) / 3: irradiance over pi = (1/3) (1 + 2 * 2/3) = 7/9.
    Scene scene = planeScene(0.5f);
    setProbe(scene, 2048, [](double y) { return y > 0 ? (1 + 2 * y) / 3 : 0; });
    expectMean(frameMean(std::move(scene), 1024), 0.5 * 7 / 9);
}

/// What the camera sees behind the scene lights nothing in it.
TEST(Plane, underAConstantProbeDoesNotKnowOfTheBackground)
{
    for (double target : {0.0, 10.0}) {
        Scene scene = planeScene(0.6f);
        setProbe(scene, 4, [](double) { return 2.5; });
        scene.background = plainProbe(1, 1, PROBE_LATLONG, FILTER_NEAREST);
        scene.background->firstTexel = static_cast<uint>(scene.probeTexels.size());
        scene.probeTexels.emplace_back(vec3(7), 0);
        setCamera(scene, {0, 5, 0}, {0, target, 0}, 40);
        expectMean(frameMean(std::move(scene), 8), target > 5 ? 7 : 0.6 * 2.5);
    }
}

void addPointLight(Scene& scene, vec3 position, float intensity)
{
    Light light = {};
    light.position = position;
    light.type = LIGHT_POINT;
    light.intensity = vec3(intensity);
    scene.lights.push_back(light);
}

/// The plane seen by a camera that looks at the origin through a pinhole so narrow that the picture
/// shows one point.
Scene spotOnPlane(float albedo)
{
    Scene scene = planeScene(albedo);
    setCamera(scene, {0, 5, 0}, {0, 0, 0}, 0.01);
    return scene;
}

TEST(PointLight, fallsOffWithTheSquareOfTheDistance)
{
    for (float height : {0.5f, 1.0f, 2.0f, 7.0f}) {
        Scene scene = spotOnPlane(0.5f);
        // Beside the camera's axis by nothing: straight above, below or above the camera.
        addPointLight(scene, {0, height, 0}, 10);
        expectMean(frameMean(std::move(scene), 8), 0.5 / std::numbers::pi * 10 / (height * height));
    }
}

TEST(PointLight, followsTheCosineOfTheAngle)
{
    for (double degrees : {0.0, 30.0, 60.0, 85.0}) {
        Scene scene = spotOnPlane(0.5f);
        double angle = degrees * std::numbers::pi / 180;
        addPointLight(scene, vec3(3 * std::sin(angle), 3 * std::cos(angle), 0), 10);
        expectMean(frameMean(std::move(scene), 8), 0.5 / std::numbers::pi * 10 * std::cos(angle) / 9);
    }
}

TEST(PointLight, severalLightsAddUp)
{
    Scene scene = spotOnPlane(1);
    addPointLight(scene, {0, 1, 0}, 1);
    addPointLight(scene, {0, 2, 0}, 4);
    addPointLight(scene, {0, -1, 0}, 100);  // behind the plane
    expectMean(frameMean(std::move(scene), 1024), 2 / std::numbers::pi);
}

/// A screen between the plane and a light beside the camera.
Scene screenedPlane()
{
    Scene scene = spotOnPlane(1);
    appendShape(scene, makeRectangle({0.5, 0.5, -0.2}, {0.4, 0, 0}, {0, 0, 0.4}), {}, 0, "screen");
    addPointLight(scene, {2, 1.5, 0}, 1);
    return scene;
}

TEST(PointLight, isBlockedByWhatStandsBefore)
{
    EXPECT_EQ(frameMean(screenedPlane(), 8).value, 0.0);
}

TEST(Phong, seesLightsThroughWhatStandsBefore)
{
    Scene scene = screenedPlane();
    scene.settings.integrator = INTEGRATOR_PHONG;
    scene.settings.shading = SHADING_DIFFUSE;
    // 2.5 m away, at a cosine of 1.5 / 2.5.
    expectMean(frameMean(std::move(scene), 8), 1 / std::numbers::pi * 0.6 / 6.25);
}

TEST(Phong, addsAllLightsAndLeavesOutThoseBehind)
{
    Scene scene = spotOnPlane(0.5f);
    scene.settings.integrator = INTEGRATOR_PHONG;
    scene.settings.shading = SHADING_DIFFUSE;
    addPointLight(scene, {0, 1, 0}, 1);
    addPointLight(scene, {0, 2, 0}, 4);
    addPointLight(scene, {0, -1, 0}, 100);
    expectMean(frameMean(std::move(scene), 1), 0.5 * 2 / std::numbers::pi);
}

TEST(Emission, isSeenFromBothSides)
{
    for (double side : {1.0, -1.0}) {
        Scene scene = emptyScene(0);
        uint32_t material = addMaterial(scene, "lamp", vec3(0), vec3(3));
        appendShape(scene, makeRectangle({-9, 0, 9}, {18, 0, 0}, {0, 0, -18}), {}, material, "lamp");
        setCamera(scene, {0, 2 * side, 0}, {0, 0, 0}, 40);
        expectMean(frameMean(std::move(scene), 8), 3);
    }
}

}  // namespace
}  // namespace sahl::testing
