// Light whose exact amount is known: polygons and spheres over a plane by their form factors, spot
// lights by their fall-off, many thousand triangles that make up a sphere. By every way of
// sampling.
#include "support/render_scenes.h"
#include "support/small_scenes.h"
#include "support/witness.h"

#include <gtest/gtest.h>

namespace sahl::testing {
namespace {

constexpr float ALBEDO = 0.5f;
constexpr uint32_t SIZE = 16;

/// A plane y = 0 of which the picture shows the origin alone.
Scene pointOnPlane()
{
    Scene scene = emptyScene(SIZE, SIZE, 1);
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(ALBEDO));
    // Not larger: rays start above a triangle by its rounding, which on a plane of 100 m is 1e-4 m.
    addLevel(scene, 0, 5);
    lookFrom(scene, {0, 0.5, 4}, {0, 0, 0}, 0.001);
    return scene;
}

/// Adds a material that shines for what is added next.
void shine(Scene& scene, float radiance)
{
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0)).emission = vec3(radiance);
}

/// Within 4 standard errors, and rounding. Samples do not differ at all where all see the same.
void expectRadiance(Scene scene, double expected, uint32_t lightSampling, uint32_t spp)
{
    scene.settings.lightSampling = lightSampling;
    const PreparedScene prepared = prepareScene(std::move(scene), BvhBuild::automatic, 2);
    const Film film = renderFilm(*makeCpuDevice({}), prepared, 0, spp);
    EXPECT_EQ(film.counters.badSamples, 0u);
    const Mean mean = greyFrameMean(film);
    constexpr const char* WAYS[] = {"mis", "lights", "bsdf"};  // by LIGHTS_*
    showWitness(mean, expected, WAYS[lightSampling]);
    EXPECT_NEAR(mean.value, expected, 4 * mean.standardError + 2e-5 * expected) << lightSampling;
    EXPECT_LT(mean.standardError, 0.02 * expected) << "too noisy to say";
}

void expectByAllWays(const Scene& scene, double expected, uint32_t spp = 256)
{
    for (uint32_t way : {LIGHTS_MIS, LIGHTS_ONLY}) expectRadiance(scene, expected, way, spp);
    expectRadiance(scene, expected, LIGHTS_BSDF_ONLY, 16 * spp);
}

/// Form factor of a polygon for the origin with its normal up: Lambert 1760, "Photometria"; Baum,
/// Rushmeier and Winget 1989, "Improving Radiosity Solutions through the Use of Analytically
/// Determined Form-Factors".
double formFactor(const std::vector<glm::dvec3>& corners)
{
    double sum = 0;
    for (size_t i = 0; i < corners.size(); i++) {
        const glm::dvec3 a = corners[i], b = corners[(i + 1) % corners.size()];
        const glm::dvec3 n = glm::cross(a, b);
        sum += std::atan2(glm::length(n), glm::dot(a, b)) * n.y / glm::length(n);
    }
    return std::abs(sum) / (2 * std::numbers::pi);
}

TEST(PolygonLight, givesItsFormFactor)
{
    struct {
        glm::dvec3 corner, u, v;
    } const lamps[] = {{{-0.5, 1, -2}, {1, 0, 0}, {0, 0, 1.2}},
                       {{1, 0.5, -1}, {0, 1.5, 0.2}, {0.1, 0, 2}},
                       {{-0.3, 0.02, -0.5}, {0.2, 0, 0}, {0, 0.1, 0.3}}};
    for (const auto& [corner, u, v] : lamps) {
        Scene scene = pointOnPlane();
        shine(scene, 7);
        addRectangle(scene, corner, u, v);
        expectByAllWays(scene,
                        ALBEDO * 7 * formFactor({corner, corner + u, corner + u + v, corner + v}));
    }
}

TEST(PolygonLight, givesItsFormFactorWhereAnInstancePutsIt)
{
    Scene scene = pointOnPlane();
    shine(scene, 7);
    const uint32_t floors = 2;
    addRectangle(scene, {0, 0, 0}, {1, 0, 0}, {0, 0, 1});
    std::vector<Primitive> lamp(scene.primitives.begin() + floors, scene.primitives.end());
    scene.primitives.resize(floors);
    for (uint i = 0; i < lamp.size(); i++) lamp[i].number = i;
    scene.objects.push_back(lamp);
    Placement placement;
    placement.linear = {1.5, 0.2, 0,   0.3, -0.6,
                        0.1, 0,   0.4, 0.9};  // stretched, sheared and mirrored
    placement.translation = {-0.5, 0.7, -1.5};
    scene.instances.push_back(placement);
    const glm::dvec3 p = placement.translation, u = placement.linear[0], v = placement.linear[2];
    expectByAllWays(scene, ALBEDO * 7 * formFactor({p, p + u, p + u + v, p + v}));
}

TEST(SphereLight, givesWhatItsSolidAngleAndCosineSay)
{
    // E = pi L (r/d)^2 cos while all of it is above the horizon.
    for (const vec3 centre : {vec3(0, 2, -1), vec3(3, 1, -2), vec3(0.5f, 1.05f, 0)}) {
        for (double radius : {0.02, 0.5, 0.99}) {
            Scene scene = pointOnPlane();
            shine(scene, 5);
            addSphere(scene, centre, float(radius));
            const double d = glm::length(glm::dvec3(centre)), share = radius / d;
            // Scattered rays hardly find the smallest
            const double expected = ALBEDO * 5 * share * share * centre.y / d;
            if (radius > 0.1) {
                expectByAllWays(scene, expected);
            } else {
                expectRadiance(scene, expected, LIGHTS_MIS, 256);
                expectRadiance(scene, expected, LIGHTS_ONLY, 256);
            }
        }
    }
}

TEST(SphereLight, fillsItsInsideLikeAFurnace)
{
    // Inside a sphere that shines with 1 and reflects half, paths of up to 4 scatterings bring 2 -
    // 1/16.
    for (uint32_t way : {LIGHTS_MIS, LIGHTS_ONLY, LIGHTS_BSDF_ONLY}) {
        Scene scene = emptyScene(SIZE, SIZE, 4);
        addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0.5f)).emission = vec3(1);
        addSphere(scene, {1, 2, 3}, 2);
        lookFrom(scene, {1.3, 1.8, 3.1}, {2, 3, 4}, 70);
        expectRadiance(scene, 2 - 0.0625, way, 64);
    }
}

TEST(SphereLight, ofThreeHundredThousandTrianglesGivesAsMuchAsARoundOne)
{
    Scene scene = pointOnPlane();
    shine(scene, 5);
    appendShape(scene, makeSphere({0, 2, -1}, 0.5, 7, false), {}, 1, "sphere");
    ASSERT_GT(scene.primitives.size(), 300000u);
    // The triangles lie within the sphere by a 1e-5th of its radius.
    expectRadiance(scene, ALBEDO * 5 * 0.25 / 5 * 2 / std::sqrt(5.0), LIGHTS_MIS, 256);
}

TEST(SpotLight, fallsOffSmoothlyBetweenItsAngles)
{
    struct {
        double degrees, share;
    } const cases[] = {{10, 1}, {25, 0.5}, {45, 0}};
    for (const auto& [degrees, share] : cases) {
        Scene scene = pointOnPlane();
        Light& spot = addLight(scene, LIGHT_SPOT, vec3(6));
        spot.position = {0, 2, 0};
        const double angle = degrees * std::numbers::pi / 180;
        spot.direction = vec3(std::sin(angle), -std::cos(angle), 0);
        spot.cosInner = cosineOf(20);
        // Half way between the cosines it is half as bright
        spot.cosOuter = degrees == 25 ? 2 * cosineOf(25) - cosineOf(20) : cosineOf(40);
        Light& other = addLight(scene, LIGHT_POINT, vec3(1));
        other.position = {0, 1, 0};
        // One of two lights is chosen: so samples differ
        expectRadiance(scene, ALBEDO / std::numbers::pi * (6 * share / 4 + 1), LIGHTS_MIS, 1024);
    }
}

}  // namespace
}  // namespace sahl::testing
