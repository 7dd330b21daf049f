// Pixels of the phong integrator whose value is known: planes and balls under single lights, each
// term alone.
#include "support/render_scenes.h"
#include "support/small_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace sahl::testing {
namespace {

using std::numbers::pi;
constexpr double DEGREE = pi / 180;

/// A picture of one pixel whose ray meets the plane y = 0 in the origin, `degrees` off the normal
/// towards +X. The plane's front is up.
Scene planeSeenFrom(double degrees, uint32_t shading)
{
    Scene scene = emptyScene(1, 1, 0);
    scene.settings.integrator = INTEGRATOR_PHONG;
    scene.settings.jitter = false;
    scene.settings.shading = shading;
    scene.probe = blackProbe();
    addMaterialOf(scene, MATERIAL_LAMBERT, {0.5f, 0.25f, 1});
    addLevel(scene, 0, 50);
    const double angle = degrees * DEGREE;
    lookFrom(scene, {3 * std::sin(angle), 3 * std::cos(angle), 0}, {0, 0, 0}, 1, {0, 0, 1});
    return scene;
}

/// The direction `degrees` off +Y towards +X.
vec3 off(double degrees)
{
    return vec3(std::sin(degrees * DEGREE), std::cos(degrees * DEGREE), 0);
}

/// A light from infinitely far away, `degrees` off +Y towards +X.
Light& addSun(Scene& scene, double degrees, vec3 irradiance = {2, 3, 4})
{
    Light& sun = addLight(scene, LIGHT_DIRECTIONAL, irradiance);
    sun.direction = -off(degrees);
    return sun;
}

Light& addLamp(Scene& scene, vec3 position, vec3 intensity = {2, 3, 4})
{
    Light& lamp = addLight(scene, LIGHT_POINT, intensity);
    lamp.position = position;
    return lamp;
}

void setHighlight(Scene& scene, vec3 color, float shininess)
{
    scene.materials.back().specularColor = color;
    scene.materials.back().shininess = shininess;
}

struct Pixel {
    glm::dvec3 L;
    Counters counters;
};

Pixel pixelOf(Scene scene)
{
    const PreparedScene prepared = prepareScene(std::move(scene), BvhBuild::sweep, 1);
    const Film film = renderFilm(*makeCpuDevice({}), prepared, 0, 1);
    EXPECT_EQ(film.counters.badSamples, 0u);
    EXPECT_EQ(film.counters.bounces, 1u);
    const HalfPixel& pixel = film.half[0][0];
    return {{pixel.sum[0].toDouble(), pixel.sum[1].toDouble(), pixel.sum[2].toDouble()},
            film.counters};
}

/// The film's sums are in steps of 2^-64, 5e-20.
void expectRadiance(Scene scene, glm::dvec3 expected, double tolerance = 2e-6)
{
    const glm::dvec3 found = pixelOf(std::move(scene)).L;
    for (int c = 0; c < 3; c++) {
        EXPECT_NEAR(found[c], expected[c], tolerance * expected[c] + 1e-18) << c;
    }
}

TEST(PhongAmbient, isItsColorTimesTheAmbientLightWhateverTheLights)
{
    for (double degrees : {0.0, 50.0, 89.0}) {
        Scene scene = planeSeenFrom(degrees, SHADING_AMBIENT);
        scene.settings.ambient = {0.5f, 2, 0.125f};
        scene.materials[0].ambientColor = {0.5f, 0.25f, 1};
        addSun(scene, 10);
        expectRadiance(std::move(scene), {0.25, 0.5, 0.125});
    }
}

TEST(PhongDiffuse, followsTheCosineAndTheInverseSquareWhereverTheViewer)
{
    const glm::dvec3 color(0.5, 0.25, 1), intensity(2, 3, 4);
    for (double viewer : {0.0, 60.0}) {
        for (double light : {0.0, 30.0, 75.0, 89.0, -45.0}) {
            for (double distance : {0.5, 4.0}) {
                Scene scene = planeSeenFrom(viewer, SHADING_DIFFUSE);
                addLamp(scene, off(light) * float(distance));
                const double cosine = std::cos(light * DEGREE);
                expectRadiance(std::move(scene),
                               color * intensity * (cosine / pi / (distance * distance)),
                               2e-6 / cosine);
            }
        }
    }
}

TEST(PhongDiffuse, isTheDiffuseShareOfTheReportsMaterialAndNothingOfGlass)
{
    Scene scene = planeSeenFrom(0, SHADING_DIFFUSE);
    scene.materials[0].type = MATERIAL_REPORT;
    scene.materials[0].diffuseWeight = 0.25f;
    addSun(scene, 0);
    expectRadiance(scene, glm::dvec3(0.5, 0.25, 1) * glm::dvec3(2, 3, 4) * (0.25 / pi));
    for (uint type : {MATERIAL_DIELECTRIC, MATERIAL_MIRROR, MATERIAL_CONDUCTOR}) {
        scene.materials[0].type = type;
        EXPECT_EQ(pixelOf(scene).L, glm::dvec3(0)) << type;
    }
}

TEST(PhongSpecular, fallsWithTheAngleFromTheMirrorDirection)
{
    const glm::dvec3 color(1, 0.5, 0.25), irradiance(2, 3, 4);
    for (float shininess : {0.0f, 1.0f, 10.0f, 333.0f}) {
        for (double viewer : {-60.0, -20.0, 5.0, 70.0}) {
            Scene scene = planeSeenFrom(viewer, SHADING_SPECULAR);
            setHighlight(scene, vec3(color), shininess);
            addSun(scene, 25);
            const double aside = std::cos((viewer + 25) * DEGREE);  // the mirror direction is -25
            const double lobe = std::pow(std::max(0.0, aside), double{shininess});
            // float32 cosines are off by some 1e-7, and a power n makes n times that of it
            expectRadiance(std::move(scene), color * irradiance * (lobe / pi),
                           2e-6 + 1e-6 * double{shininess});
        }
    }
}

TEST(PhongSpecular, hasFullStrengthInTheMirrorDirectionAndNoneOutsideWhenSharp)
{
    Scene scene = planeSeenFrom(-25, SHADING_SPECULAR);
    setHighlight(scene, vec3(1), 1e4f);
    addSun(scene, 25);
    expectRadiance(scene, glm::dvec3(2, 3, 4) / pi, 1e-2);
    Scene aside = planeSeenFrom(-40, SHADING_SPECULAR);
    setHighlight(aside, vec3(1), 1e4f);
    addSun(aside, 25);
    EXPECT_EQ(pixelOf(std::move(aside)).L, glm::dvec3(0));  // cos(15 degrees)^10000 is 1e-151
}

TEST(PhongSpecular, isNotNormalised)
{
    // Whatever the exponent, the highlight's middle is as bright.
    for (float shininess : {0.0f, 1.0f, 50.0f, 500.0f}) {
        Scene scene = planeSeenFrom(0, SHADING_SPECULAR);
        setHighlight(scene, vec3(1), shininess);
        addSun(scene, 0, vec3(float(pi)));
        expectRadiance(std::move(scene), glm::dvec3(1), 1e-4);
    }
}

/// A ball of radius 1 in the origin, one parallel ray along -Z that meets it at (x, y).
Scene ballSeenAt(double x, double y, uint32_t shading)
{
    Scene scene = emptyScene(1, 1, 0);
    scene.settings.integrator = INTEGRATOR_PHONG;
    scene.settings.jitter = false;
    scene.settings.shading = shading;
    scene.probe = blackProbe();
    addMaterialOf(scene, MATERIAL_LAMBERT, {0.5f, 0.25f, 1});
    addSphere(scene, {0, 0, 0}, 1);
    lookParallel(scene, {x, y, 5}, {x, y, 0}, 0.01);
    return scene;
}

TEST(PhongOnABall, eachTermIsThatOfItsNormal)
{
    const glm::dvec3 toLight = glm::normalize(glm::dvec3(0.6, 0.5, 1));
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {0.25, 0.25}, {-0.5, 0.625}, {0.75, -0.25}}) {
        const glm::dvec3 n(x, y, std::sqrt(1 - x * x - y * y));
        const double cosine = std::max(0.0, glm::dot(n, toLight));
        const glm::dvec3 mirrored = n * (2 * glm::dot(n, toLight)) - toLight;
        const double lobe = cosine > 0 ? std::pow(std::max(0.0, mirrored.z), 20.0) : 0;
        const glm::dvec3 terms[] = {glm::dvec3(0.5, 0.25, 1) * 0.2,
                                    glm::dvec3(0.5, 0.25, 1) * (3 * cosine / pi),
                                    glm::dvec3(0.25, 1, 0.5) * (3 * lobe / pi)};
        for (uint32_t shading = 1; shading <= SHADING_TERMS; shading++) {
            Scene scene = ballSeenAt(x, y, shading);
            scene.settings.ambient = vec3(0.2f);
            setHighlight(scene, {0.25f, 1, 0.5f}, 20);
            addLight(scene, LIGHT_DIRECTIONAL, vec3(3)).direction = vec3(-toLight);
            glm::dvec3 sum(0);
            for (int i = 0; i < 3; i++) sum += (shading >> i & 1) != 0 ? terms[i] : glm::dvec3(0);
            expectRadiance(std::move(scene), sum, 3e-5);
        }
    }
}

TEST(PhongLights, behindTheSurfaceAddNothingEvenWithExponentZero)
{
    for (double degrees : {90.5, 120.0, 180.0}) {
        for (uint32_t shadows : {0u, SHADING_SHADOWS}) {
            Scene scene = planeSeenFrom(20, SHADING_DIFFUSE | SHADING_SPECULAR | shadows);
            setHighlight(scene, vec3(1), 0);
            addSun(scene, degrees);
            addLamp(scene, off(degrees) * 2.0f);
            const Pixel pixel = pixelOf(std::move(scene));
            EXPECT_EQ(pixel.L, glm::dvec3(0)) << degrees;
            EXPECT_EQ(pixel.counters.shadowRays, 0u);
        }
    }
}

TEST(PhongLights, inThePlaneAddNothingAndJustAboveItTheirCosine)
{
    Scene scene = planeSeenFrom(20, SHADING_TERMS);
    scene.settings.ambient = vec3(0);
    setHighlight(scene, vec3(1), 3);
    addLight(scene, LIGHT_DIRECTIONAL, vec3(1)).direction = {1, 0, 0};
    addLamp(scene, {0, 0, 0});  // where the ray meets the plane
    EXPECT_EQ(pixelOf(scene).L, glm::dvec3(0));
    scene.lights = {};
    scene.settings.shading = SHADING_DIFFUSE | SHADING_SHADOWS;
    addLight(scene, LIGHT_DIRECTIONAL, vec3(1)).direction = {1, -1e-4f, 0};
    expectRadiance(std::move(scene), glm::dvec3(0.5, 0.25, 1) * (1e-4 / pi), 1e-3);
}

TEST(PhongLights, ofAllKindsAddUp)
{
    Scene scene = planeSeenFrom(0, SHADING_DIFFUSE | SHADING_SHADOWS);
    addSun(scene, 60, vec3(2));
    addLamp(scene, {0, 2, 0}, vec3(8));
    Light& spot = addLight(scene, LIGHT_SPOT, vec3(3));
    spot.position = {0, 1, 0};
    spot.cosOuter = 0.5f;
    spot.cosInner = 0.75f;
    addLamp(scene, {0, -2, 0}, vec3(1000));
    const Pixel pixel = pixelOf(scene);
    EXPECT_EQ(pixel.counters.shadowRays, 3u);
    expectRadiance(std::move(scene), glm::dvec3(0.5, 0.25, 1) * ((1.0 + 2 + 3) / pi));
}

/// Two lamps of which a screen hides one. The plane is looked at past the screen.
Scene screened(uint32_t shading)
{
    Scene scene = planeSeenFrom(-10, shading);
    addRectangle(scene, {0.2, 0.5, -0.5}, {1, 0, 0}, {0, 0, 1});
    addLamp(scene, off(45) * 2.0f, vec3(8));
    addLamp(scene, off(-60) * 2.0f, vec3(4));
    return scene;
}

TEST(PhongShadows, areCastByWhatStandsBetween)
{
    const glm::dvec3 color(0.5, 0.25, 1);
    const double hidden = 2 * std::cos(45 * DEGREE) / pi, seen = 1 * std::cos(60 * DEGREE) / pi;
    Pixel off = pixelOf(screened(SHADING_DIFFUSE));
    EXPECT_EQ(off.counters.shadowRays, 0u);
    expectRadiance(screened(SHADING_DIFFUSE), color * (hidden + seen));
    Pixel on = pixelOf(screened(SHADING_DIFFUSE | SHADING_SHADOWS));
    EXPECT_EQ(on.counters.shadowRays, 2u);
    EXPECT_EQ(on.counters.indirectRays, 0u);
    expectRadiance(screened(SHADING_DIFFUSE | SHADING_SHADOWS), color * seen);
}

TEST(PhongShadows, leaveAmbientLightAndEmissionAlone)
{
    Scene scene = screened(SHADING_TERMS | SHADING_SHADOWS);
    scene.lights.pop_back();
    scene.materials[0].emission = {1, 2, 3};
    scene.settings.ambient = vec3(0.5f);
    expectRadiance(std::move(scene), {1.25, 2.125, 3.5});
}

TEST(PhongShadows, areNotCastByWhatStandsBehindTheLight)
{
    Scene scene = screened(SHADING_DIFFUSE | SHADING_SHADOWS);
    scene.lights = {};
    addLamp(scene, off(45) * 0.6f, vec3(0.36f));  // below the screen
    expectRadiance(std::move(scene), glm::dvec3(0.5, 0.25, 1) * (std::cos(45 * DEGREE) / pi), 1e-5);
}

TEST(PhongShadows, areInTheDigestLightByLight)
{
    // The same two lights in the other order: as much is blocked, and as much light arrives.
    Scene scene = screened(SHADING_DIFFUSE | SHADING_SHADOWS), swapped = scene;
    std::swap(swapped.lights[0], swapped.lights[1]);
    auto filmOf = [](Scene s) {
        const PreparedScene prepared = prepareScene(std::move(s), BvhBuild::sweep, 1);
        return renderFilm(*makeCpuDevice({}), prepared, 0, 1);
    };
    const Film first = filmOf(scene), second = filmOf(swapped);
    EXPECT_TRUE(first.half[0] == second.half[0]);
    EXPECT_NE(first.digest, second.digest);
}

/// A plane whose mesh has normals that lean by 30 degrees towards +X.
Scene leaning(uint32_t shading)
{
    Scene scene = planeSeenFrom(0, shading);
    for (Primitive& primitive : scene.primitives) {
        primitive.shape = 0;
    }
    scene.triangleCorners.push_back({off(30), 0, off(30), 0, off(30), 0, 0, 0, 0, 0});
    return scene;
}

TEST(PhongNormals, areThoseOfTheMeshOrOfTheTriangle)
{
    const glm::dvec3 color(0.5, 0.25, 1);
    Scene scene = leaning(SHADING_DIFFUSE);
    addSun(scene, 10, vec3(1));
    expectRadiance(scene, color * (std::cos(20 * DEGREE) / pi));
    scene.settings.shading |= SHADING_FLAT;
    expectRadiance(scene, color * (std::cos(10 * DEGREE) / pi));
}

TEST(PhongNormals, flatOnesCountForPathsToo)
{
    Scene scene = leaning(0);
    scene.settings.integrator = INTEGRATOR_PATH;
    scene.settings.maxBounces = 1;
    addSun(scene, 10, vec3(1));
    const glm::dvec3 color(0.5, 0.25, 1);
    expectRadiance(scene, color * (std::cos(20 * DEGREE) / pi));
    scene.settings.shading = SHADING_FLAT;
    expectRadiance(scene, color * (std::cos(10 * DEGREE) / pi));
}

TEST(PhongNormals, areOnTheSameSideWhoeverLooks)
{
    // From below the plane looks as from above: the light counts where the normals point.
    for (double viewer : {0.0, 180.0}) {
        for (uint32_t shadows : {0u, SHADING_SHADOWS}) {
            Scene scene = planeSeenFrom(viewer, SHADING_DIFFUSE | shadows);
            addSun(scene, 60, vec3(1));
            addSun(scene, 120, vec3(1));
            expectRadiance(std::move(scene), glm::dvec3(0.5, 0.25, 1) * (0.5 / pi));
        }
    }
}

TEST(PhongShadows, fallOnWhatTurnsAwayFromTheLightUnderItsNormals)
{
    // The normals see a light at 100 degrees, the surface itself does not.
    Scene scene = leaning(SHADING_DIFFUSE);
    addSun(scene, 100, vec3(1));
    expectRadiance(scene, glm::dvec3(0.5, 0.25, 1) * (std::cos(70 * DEGREE) / pi));
    scene.settings.shading |= SHADING_SHADOWS;
    const Pixel pixel = pixelOf(scene);
    EXPECT_EQ(pixel.L, glm::dvec3(0));
    EXPECT_EQ(pixel.counters.shadowRays, 0u);
}

TEST(Phong, isFiniteWhateverTheExponentTheLightAndTheView)
{
    for (float shininess : {0.0f, 1e-30f, 1.0f, 1e3f, 1e6f}) {
        for (double viewer : {-89.999, -45.0, 0.0, 45.0, 89.999}) {
            Scene scene = planeSeenFrom(viewer, SHADING_TERMS | SHADING_SHADOWS);
            setHighlight(scene, vec3(1), shininess);
            for (double light : {-90.0, -89.999, -45.0, 0.0, 45.0, 89.999, 90.0, 180.0}) {
                addSun(scene, light, vec3(1));
                for (float distance : {0.0f, 1e-6f, 1.0f, 1e15f}) {
                    addLamp(scene, off(light) * distance, vec3(1));
                }
            }
            const Pixel pixel = pixelOf(std::move(scene));  // expects no bad sample
            EXPECT_GT(pixel.L.x, 0);
        }
    }
}

}  // namespace
}  // namespace sahl::testing
