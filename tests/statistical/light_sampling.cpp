// Light sampling against its own densities: counts of a million samples in cells of directions, by
// chi-squared, and densities that add up to one.
#include "reference/kernel.h"
#include "support/chi_squared.h"
#include "support/render_scenes.h"
#include "support/small_scenes.h"

#include <gtest/gtest.h>

#include <functional>

namespace sahl::testing {
namespace {

using reference::Kernel;
using SurfaceInteraction = Kernel<>::SurfaceInteraction;

constexpr int SAMPLES = 1000000;
constexpr double FAMILY_LEVEL = 0.01;  // chance that any of the tests here fails by itself
constexpr size_t TESTS = 24;           // at least as many as there are

/// A kernel that has all that light sampling reads.
struct LightKernel : Kernel<> {
    explicit LightKernel(const PreparedScene& prepared) : Kernel<>{}
    {
        const DeviceScene scene = prepared.deviceScene();
        nodes = scene.nodes;
        primitives = scene.primitives;
        triangleCorners = scene.triangleCorners;
        materials = scene.materials;
        lights = scene.lights;
        aliasEntries = scene.aliasEntries;
        probeTexels = scene.probeTexels;
        instances = scene.instances;
        frame = scene.frame;
    }

    LightSample sampleAt(const SurfaceInteraction& isect, uint i)
    {
        const LightChoice choice = chooseLight(isect, true, 1, random4(0, i, 0).x);
        return sampleLight(isect, choice, randomBits4(1, i, 0));
    }

    /// Density of light sampling for a direction, as a path finds it that goes there.
    double pdfAt(const SurfaceInteraction& isect, vec3 wi)
    {
        const LightChoice choice = chooseLight(isect, true, 1, 0);
        const vec3 org = offsetOrigin(isect, wi);
        Traversal hit = beginTraversal(RAY_INFINITY);
        stepsLeft = 0xffffffffu;
        faults = 0;
        traverse(org, wi, false, hit);
        if (hit.slot == NO_HIT) {
            const vec3 d = toProbe(frame.probe, wi);
            return pdfProbe(choice.probeChance, d, lookUpProbe(frame.probe, d).w);
        }
        const SurfaceInteraction at = interactionAt(hit, org, wi);
        return pdfShapeLight(choice.tableChance, hit, at, org, wi);
    }
};

/// A point in space that looks up.
SurfaceInteraction pointAt(vec3 p)
{
    SurfaceInteraction isect = {};
    isect.p = p;
    isect.ng = isect.ns = {0, 1, 0};
    return isect;
}

/// Directions about an axis, up to an angle from it: cells of angle and azimuth.
struct Cells {
    glm::dvec3 axis;
    double angleMax;  ///< [rad]
    int angles = 24, azimuths = 48;
    int points = 24;          ///< in each direction, by which a cell is integrated
    bool poolBorders = true;  ///< cells that the midpoints do not integrate well count as one

    size_t count() const { return size_t(angles) * size_t(azimuths); }

    void frame(glm::dvec3& s, glm::dvec3& t) const
    {
        s = glm::normalize(
            glm::cross(std::abs(axis.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0), axis));
        t = glm::cross(axis, s);
    }

    /// Cell of a direction; count() when it lies beyond the angle.
    size_t cellOf(const glm::dvec3& d) const
    {
        glm::dvec3 s, t;
        frame(s, t);
        const double angle = std::atan2(glm::length(glm::cross(axis, d)), glm::dot(axis, d));
        const double turns = std::atan2(glm::dot(d, t), glm::dot(d, s)) / (2 * std::numbers::pi);
        const auto i = static_cast<int>(angle / angleMax * angles);
        const int j =
            std::min(azimuths - 1, static_cast<int>((turns - std::floor(turns)) * azimuths));
        return i < angles ? size_t(i * azimuths + j) : count();
    }

    /// Integrals of a density over all cells, by midpoints. Where a rim or a pole of the density
    /// runs through a cell `isBorder` becomes true.
    std::vector<double> integrals(const std::function<double(vec3)>& density,
                                  std::vector<bool>& isBorder) const
    {
        std::vector<double> least(count(), HUGE_VAL), most(count());
        glm::dvec3 s, t;
        frame(s, t);
        std::vector<double> sums(count());
        const int rows = angles * points, columns = azimuths * points;
        const double area = angleMax / rows * 2 * std::numbers::pi / columns;
        for (int i = 0; i < rows; i++) {
            const double angle = (i + 0.5) / rows * angleMax;
            for (int j = 0; j < columns; j++) {
                const double azimuth = (j + 0.5) / columns * 2 * std::numbers::pi;
                const glm::dvec3 d =
                    axis * std::cos(angle) +
                    (s * std::cos(azimuth) + t * std::sin(azimuth)) * std::sin(angle);
                const size_t cell = size_t(i / points * azimuths + j / points);
                const double pdf = density(vec3(glm::normalize(d)));
                sums[cell] += pdf * std::sin(angle) * area;
                least[cell] = std::min(least[cell], pdf);
                most[cell] = std::max(most[cell], pdf);
            }
        }
        isBorder.resize(count());
        for (size_t i = 0; i < count(); i++) isBorder[i] = poolBorders && most[i] > 2 * least[i];
        return sums;
    }
};

/// All samples are of the density that paths find where they go, and the density adds up to 1.
///   someLost  less than 1 where samples may come to nothing
void expectSampledByDensity(Scene scene, vec3 from, const Cells& cells, bool someLost = false)
{
    const PreparedScene prepared = prepareScene(std::move(scene), BvhBuild::sweep, 1);
    LightKernel kernel(prepared);
    const SurfaceInteraction isect = pointAt(from);
    std::vector<bool> isBorder;
    std::vector<double> expected =
        cells.integrals([&](vec3 wi) { return kernel.pdfAt(isect, wi); }, isBorder);
    double total = 0;
    for (double& cell : expected) {
        total += cell;
        cell *= SAMPLES;
    }
    EXPECT_LT(total, 1 + 5e-3);
    EXPECT_GT(total, someLost ? 0.8 : 1 - 5e-3);

    std::vector<double> found(cells.count() + 1);
    int taken = 0;
    for (uint i = 0; i < SAMPLES; i++) {
        const auto ls = kernel.sampleAt(isect, i);
        if (!(ls.distance > 0)) continue;
        taken++;
        found[cells.cellOf(glm::dvec3(ls.wi))]++;
        if (i >= 10000) continue;
        const double pdf = kernel.pdfAt(isect, ls.wi);
        // A direction that just misses the light by rounding has no density
        ASSERT_NEAR(ls.pdf, pdf > 0 ? pdf : double{ls.pdf}, 2e-3 * pdf);
    }
    EXPECT_EQ(found.back(), 0) << "beyond the cells";
    EXPECT_NEAR(taken, someLost ? total * SAMPLES : SAMPLES, 2e-3 * SAMPLES);
    found.pop_back();
    double border = taken, foundInBorder = 0;
    for (size_t i = 0; i < cells.count(); i++) {
        if (!isBorder[i]) {
            border -= expected[i];
            continue;
        }
        foundInBorder += std::exchange(found[i], 0);
        expected[i] = 0;
    }
    if (cells.poolBorders) {
        expected.push_back(std::max(border, 0.0));
        found.push_back(foundInBorder);
    }
    const ChiSquared test = chiSquaredTest(expected, found);
    EXPECT_GT(test.p, sidakLevel(FAMILY_LEVEL, TESTS))
        << "chi-squared " << test.value << " of " << test.degrees << " degrees";
}

/// A scene whose only material shines.
Scene shiningScene()
{
    Scene scene = emptyScene(8, 8, 4);
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0.5f)).emission = vec3(2, 3, 1);
    lookFrom(scene, {0, 0, 9}, {0, 0, 0}, 40);
    return scene;
}

Scene sphereScene(vec3 centre, float radius)
{
    Scene scene = shiningScene();
    addSphere(scene, centre, radius);
    return scene;
}

Cells about(glm::dvec3 axis, double angleMax)
{
    return {glm::normalize(axis), angleMax};
}

Cells everywhere(glm::dvec3 axis)
{
    return about(axis, std::numbers::pi);
}

TEST(SphereLight, isSampledBySolidAngleFromOutside)
{
    const vec3 centre(1, 2, -0.5f);
    for (double distance : {1.01, 1.5, 4.0, 300.0}) {
        const glm::dvec3 axis = glm::normalize(glm::dvec3(1, 3, 0.5));
        const double rim = std::asin(1 / distance);
        expectSampledByDensity(sphereScene(centre, 0.7f), centre - vec3(axis * (0.7 * distance)),
                               about(axis, std::min(1.05 * rim, std::numbers::pi)));
    }
}

TEST(SphereLight, isSampledAllOverFromInside)
{
    for (double distance : {0.0, 0.5, 0.95}) {
        const vec3 centre(1, 2, -0.5f);
        const glm::dvec3 axis = glm::normalize(glm::dvec3(1, 3, 0.5));
        expectSampledByDensity(sphereScene(centre, 0.7f), centre - vec3(axis * (0.7 * distance)),
                               everywhere(axis));
    }
}

Scene placedScene(const std::function<void(Scene&)>& addShape, const glm::dmat3& linear)
{
    Scene scene = shiningScene();
    addShape(scene);
    scene.objects.push_back(std::exchange(scene.primitives, {}));
    Placement placement;
    placement.linear = linear;
    placement.translation = {0.5, 2.5, -0.25};
    scene.instances.push_back(placement);
    return scene;
}

// Stretched, sheared and mirrored.
const glm::dmat3 SKEW = {1.5, 0.2, 0, 0.3, -0.6, 0.1, 0, 0.4, 0.9};

TEST(SphereLight, isSampledAsAnEllipsoidWhereAnInstanceMakesItOne)
{
    const auto ball = [](Scene& scene) { addSphere(scene, {0.1f, -0.2f, 0.3f}, 0.7f); };
    expectSampledByDensity(placedScene(ball, SKEW), {0.2f, -1, 0.1f}, about({0.1, 1, 0}, 0.6));
    expectSampledByDensity(placedScene(ball, SKEW), {0.6f, 2.6f, -0.2f}, everywhere({0, 1, 0}));
    expectSampledByDensity(placedScene(ball, glm::dmat3(2)), {0.2f, -1, 0.1f},
                           about({0.1, 1, 0}, 0.7));
}

void addTriangle(Scene& scene)
{
    Primitive triangle = {};
    triangle.p0 = {-0.5f, 1, 0.2f};
    triangle.p1 = {1.1f, 1.4f, 0.3f};
    triangle.p2 = {0.1f, 1.6f, -1};
    triangle.number = static_cast<uint>(scene.primitives.size());
    triangle.shape = SHAPE_FLAT;
    scene.primitives.push_back(triangle);
}

TEST(TriangleLight, isSampledByArea)
{
    Scene scene = shiningScene();
    addTriangle(scene);
    expectSampledByDensity(scene, {0, 0, 0}, about({0.2, 1, -0.1}, 0.9));
    expectSampledByDensity(scene, {3, 1.8f, 2}, about({-2.8, -0.5, -2.2}, 0.6));
}

TEST(TriangleLight, isSampledByAreaInTheWorldWhereAnInstancePutsIt)
{
    expectSampledByDensity(placedScene(addTriangle, SKEW), {0.3f, 0, 0.1f},
                           about({0.3, 1, 0.3}, 1.2));
}

/// Shadow rays to lights of all shapes, from everywhere around and at all angles, also far from the
/// origin.
TEST(Lights, areNotInTheirOwnWay)
{
    const auto both = [](Scene& scene) {
        addTriangle(scene);
        addSphere(scene, {0.1f, -2, 0.3f}, 0.7f);
    };
    int seen = 0;
    for (const vec3& away : {vec3(0), vec3(300, -1000, 70)}) {
        for (bool isPlaced : {false, true}) {
            Scene scene = isPlaced ? placedScene(both, SKEW) : shiningScene();
            if (!isPlaced) both(scene);
            for (Primitive& shape : scene.primitives) {
                shape.p0 += away;
                if (shape.shape == SHAPE_SPHERE) continue;
                shape.p1 += away;
                shape.p2 += away;
            }
            for (Placement& placement : scene.instances) placement.translation += glm::dvec3(away);
            const PreparedScene prepared = prepareScene(std::move(scene), BvhBuild::sweep, 1);
            LightKernel kernel(prepared);
            for (uint i = 0; i < 100000; i++) {
                const vec4 u = kernel.random4(2, i, 0);
                SurfaceInteraction isect =
                    pointAt(away + (vec3(u) - 0.5f) * (i % 2 == 0 ? 3.0f : 30.0f));
                isect.pError = 2e-6f * (kernel.maxComponent(kernel.absolute3(isect.p)) + 1);
                const auto ls = kernel.sampleAt(isect, i);
                if (!(ls.distance > 0)) continue;
                Traversal walk = kernel.beginTraversal(ls.distance);
                kernel.stepsLeft = 0xffffffffu;
                kernel.traverse(kernel.offsetOrigin(isect, ls.wi), ls.wi, true, walk);
                if (walk.slot == NO_HIT) {
                    seen++;
                    continue;
                }
                // One of the two may be in the way of the other, or the sphere in that of its own
                // inside. A light in its own way would be met at the end of the shadow ray
                ASSERT_LT(walk.tHit, 0.99 * ls.distance) << isPlaced << " " << i;
            }
        }
    }
    EXPECT_GT(seen, 300000);
}

TEST(Lights, areChosenByTheirPower)
{
    // Two spheres apart: each is seen as often as its emission times its area asks.
    Scene scene = sphereScene({3, 0.5f, 0}, 0.5f);
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0.5f)).emission = vec3(20, 1, 4);
    addSphere(scene, {-2, 1, 0}, 0.25f);
    expectSampledByDensity(scene, {0, 0, 0}, {{0, 1, 0}, std::numbers::pi, 64, 128, 8});
}

/// Lamps, a probe and single lights together, as a surface on the ground finds them.
Scene mixedScene()
{
    Scene scene = sphereScene({3, 0.5f, 0}, 0.5f);
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0.5f)).emission = vec3(20, 1, 4);
    addSphere(scene, {-2, 1, 0}, 0.25f);
    scene.probe = addHalves(scene, vec3(0.2f), vec3(0.5f));
    addLight(scene, LIGHT_POINT, vec3(4)).position = {0, 2, 1};
    addLight(scene, LIGHT_POINT, vec3(9)).position = {0, -2, 1};  // below the ground
    addLight(scene, LIGHT_DIRECTIONAL, vec3(0.5f)).direction = {0, -1, 0};
    return scene;
}

/// How often each of many choices is made, of which the first two are probe and table.
std::vector<double> countsOfChoices(LightKernel& kernel, const SurfaceInteraction& isect,
                                    bool through, float carried, std::vector<double>& chances)
{
    std::vector<double> counts(2 + kernel.frame.singleCount + 1);
    chances.assign(counts.size(), 0);
    for (uint i = 0; i < SAMPLES; i++) {
        const auto choice = kernel.chooseLight(isect, through, carried, kernel.random4(0, i, 0).x);
        size_t k = counts.size() - 1;
        if (choice.light == Kernel<>::TAKE_PROBE)
            k = 0;
        else if (choice.light == Kernel<>::TAKE_TABLE)
            k = 1;
        else if (choice.light != Kernel<>::TAKE_NOTHING)
            k = 2 + choice.light;
        counts[k]++;
        chances[0] = choice.probeChance;
        chances[1] = choice.tableChance;
        if (k >= 2 && k + 1 < counts.size()) chances[k] = choice.chance;
    }
    return counts;
}

TEST(Lights, areChosenAsOftenAsTheChoiceSays)
{
    const PreparedScene prepared = prepareScene(mixedScene(), BvhBuild::sweep, 1);
    LightKernel kernel(prepared);
    ASSERT_EQ(kernel.frame.singleCount, 3u);
    for (float carried : {1.0f, 0.1f, 0.0f}) {
        for (bool through : {false, true}) {
            std::vector<double> chances;
            const std::vector<double> counts =
                countsOfChoices(kernel, pointAt({0, 0, 0}), through, carried, chances);
            double sum = 0;
            for (double chance : chances) sum += chance;
            EXPECT_NEAR(sum, carried == 1 ? 1 : carried == 0 ? 0.0625 : 0.4, 1e-7);
            EXPECT_EQ(counts[3] > 0, through) << "of the light below the ground";
            chances.back() = 1 - sum;
            for (size_t i = 0; i < counts.size(); i++) {
                const double sigma = std::sqrt(SAMPLES * chances[i] * (1 - chances[i]));
                EXPECT_NEAR(counts[i], SAMPLES * chances[i], 4.5 * sigma + 0.5) << i;
            }
        }
    }
}

TEST(Lights, areChosenByWhatArrivesWhereNothingIsInTheWay)
{
    Scene scene = sphereScene({0, -1000, 0}, 1);
    scene.materials[0].emission = vec3(0);
    addLight(scene, LIGHT_POINT, vec3(4)).position = {0, 2, 0};   // irradiance 1
    addLight(scene, LIGHT_POINT, vec3(27)).position = {0, 3, 0};  // 3
    const PreparedScene prepared = prepareScene(std::move(scene), BvhBuild::sweep, 1);
    LightKernel kernel(prepared);
    std::vector<double> chances;
    countsOfChoices(kernel, pointAt({0, 0, 0}), false, 1, chances);
    // Each is raised by a part of the sum
    EXPECT_NEAR(chances[2], (1 + 4 / 32.0) / (4 + 8 / 32.0), 1e-6);
    EXPECT_NEAR(chances[3], (3 + 4 / 32.0) / (4 + 8 / 32.0), 1e-6);
}

/// A probe whose texels are a random mixture of dark and bright, some of them black.
Scene probeScene(uint mapping, uint filter, uint32_t width, uint32_t height, const glm::dmat3& turn)
{
    Scene scene = emptyScene(8, 8, 4);
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0.5f));
    lookFrom(scene, {0, 0, 9}, {0, 0, 0}, 40);
    addSphere(scene, {0, -1000, 0}, 1);  // far below, so that there is a scene at all
    scene.probe = addProbe(scene, width, height, mapping, filter);
    scene.probe.axisX = vec3(turn[0]);
    scene.probe.axisY = vec3(turn[1]);
    scene.probe.axisZ = vec3(turn[2]);
    Kernel<> kernel;
    for (uint i = 0; i < scene.probeTexels.size(); i++) {
        const vec4 u = kernel.random4(i, 0, 0);
        if (u.x > 0.3f)
            scene.probeTexels[i] =
                vec4(u.y * u.y * u.y * (u.x > 0.95f ? 30.0f : 1.0f), u.z, u.w, 0);
    }
    return scene;
}

Cells wholeSphere(const glm::dvec3& axis)
{
    Cells cells = everywhere(axis);
    cells.poolBorders = false;
    return cells;
}

const glm::dmat3 UPRIGHT(1);
const glm::dmat3 TURNED = glm::dmat3(0.36, 0.48, -0.8, -0.8, 0.6, 0, 0.48, 0.64, 0.6);

TEST(Probe, isSampledByWhatLookingUpGives)
{
    for (uint filter : {FILTER_NEAREST, FILTER_BILINEAR}) {
        for (const glm::dmat3& turn : {UPRIGHT, TURNED}) {
            // The poles, where densities have no bound, are those of the cells
            expectSampledByDensity(probeScene(PROBE_LATLONG, filter, 24, 12, turn), vec3(0),
                                   wholeSphere(turn[1]));
            // Points beyond the rim of the map are no directions
            expectSampledByDensity(probeScene(PROBE_ANGULAR, filter, 16, 16, turn), vec3(0),
                                   wholeSphere(turn[2]), true);
        }
    }
}

}  // namespace
}  // namespace sahl::testing
