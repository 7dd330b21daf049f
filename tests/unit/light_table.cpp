// Which lights of a scene are sampled, and how often.
#include "render/prepare.h"
#include "support/small_scenes.h"

#include <gtest/gtest.h>

namespace sahl::testing {
namespace {

PreparedScene prepared(Scene scene, BvhBuild build = BvhBuild::sweep)
{
    return prepareScene(std::move(scene), build, 1);
}

/// A floor, a lamp of two triangles, one of a sphere; lights are added by the caller.
Scene lampsScene()
{
    Scene scene = emptyScene(8, 8, 4);
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0.5f));
    addLevel(scene, 0, 4);
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0.5f)).emission = vec3(3);
    addRectangle(scene, {0, 2, 0}, {1, 0, 0}, {0, 0, 2});
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0.5f)).emission = vec3(0, 2, 0);
    addSphere(scene, {2, 2, 0}, 0.5f);
    lookFrom(scene, {0, 1, 9}, {0, 0, 0}, 40);
    return scene;
}

TEST(LightTable, hasEveryShapeThatShinesByItsLuminanceTimesItsArea)
{
    const PreparedScene scene = prepared(lampsScene());
    const LightTable& table = scene.lightTable;
    ASSERT_EQ(table.choiceCount, 3u);
    const double sphere = 2 * 0.7152 * std::numbers::pi, sum = 3 * 2 + sphere;
    EXPECT_NEAR(table.lights[0].chance, 3 / sum, 1e-6);
    EXPECT_NEAR(table.lights[1].chance, 3 / sum, 1e-6);
    EXPECT_NEAR(table.lights[2].chance, sphere / sum, 1e-6);
    EXPECT_EQ(table.lights[0].type, LIGHT_TRIANGLE);
    EXPECT_EQ(table.lights[2].type, LIGHT_SPHERE);
    EXPECT_EQ(scene.bvh.primitives[table.lights[2].slot].shape, SHAPE_SPHERE);
    EXPECT_NEAR(table.lightPerPower, 1 / sum, 1e-6);
    EXPECT_EQ(table.probeMean, 0);
    EXPECT_EQ(scene.deviceScene().frame.lightCount, 0u) << "phong has no such lights";
}

TEST(LightTable, doesNotDependOnTheTree)
{
    Scene scene = lampsScene();
    appendShape(scene, makeSphere({-3, 1, 0}, 0.4, 5, false), {}, 2, "sphere");
    const PreparedScene a = prepared(scene, BvhBuild::sweep), b = prepared(scene, BvhBuild::binned);
    ASSERT_EQ(a.lightTable.choiceCount, 20483u);
    ASSERT_EQ(b.lightTable.choiceCount, 20483u);
    bool sameSlots = true;
    for (size_t i = 0; i < a.lightTable.choiceCount; i++) {
        const Light &p = a.lightTable.lights[i], &q = b.lightTable.lights[i];
        EXPECT_EQ(a.bvh.primitives[p.slot].number, b.bvh.primitives[q.slot].number);
        EXPECT_EQ(p.chance, q.chance);
        sameSlots = sameSlots && p.slot == q.slot;
    }
    const size_t clusters = a.lightTable.clusterCount;
    ASSERT_EQ(b.lightTable.clusterCount, clusters);
    for (size_t i = 20483; i < 20483 + clusters; i++) {
        EXPECT_EQ(a.lightTable.lights[i].position, b.lightTable.lights[i].position);
        EXPECT_EQ(a.lightTable.lights[i].intensity, b.lightTable.lights[i].intensity);
    }
    EXPECT_FALSE(sameSlots) << "the trees do not differ, so nothing was shown";
}

TEST(LightTable, hasTheShapesOfEveryInstanceAndItsMaterial)
{
    Scene scene = lampsScene();
    std::vector<Primitive> object;
    for (uint i = 0; i < 2; i++) object.push_back(scene.primitives[2 + i]);
    for (uint i = 0; i < 2; i++) object[i].number = i;
    scene.objects.push_back(object);
    for (uint material : {NO_MATERIAL, 0u, 2u}) {
        Placement placement;
        placement.linear = glm::dmat3(2);
        placement.translation = {0, 3, double(material % 5)};
        placement.material = material;
        scene.instances.push_back(placement);
    }
    const PreparedScene both = prepared(scene);
    ASSERT_EQ(both.lightTable.choiceCount, 7u);  // none of the instance that does not shine
    const auto& lights = both.lightTable.lights;
    EXPECT_EQ(lights[2].instance, NO_INSTANCE);
    EXPECT_EQ(lights[3].instance, 0u);
    EXPECT_EQ(lights[5].instance, 2u);
    EXPECT_NEAR(lights[3].chance, 4 * lights[0].chance, 1e-6);
    EXPECT_NEAR(lights[5].chance, 4 * lights[0].chance * 2 * 0.7152 / 3, 1e-6);
}

TEST(LightTable, ofBsdfOnlyHasWhatNoScatteringFinds)
{
    Scene scene = lampsScene();
    addLight(scene, LIGHT_POINT, vec3(1)).position = {0, 3, 0};
    scene.probe = addHalves(scene, vec3(1), vec3(0));
    scene.settings.lightSampling = LIGHTS_BSDF_ONLY;
    const PreparedScene some = prepared(scene);
    EXPECT_EQ(some.lightTable.singleCount, 1u);
    EXPECT_EQ(some.lightTable.choiceCount, 0u);
    EXPECT_EQ(some.lightTable.lightPerPower, 0) << "no shape is sampled";
    EXPECT_EQ(some.lightTable.probeMean, 0);
}

TEST(LightTable, leavesAllShapesToScatteringWhereThereAreTooMany)
{
    Scene scene = lampsScene();
    std::vector<Primitive> object(2048, scene.primitives[2]);
    for (uint i = 0; i < object.size(); i++) object[i].number = i;
    scene.objects.push_back(object);
    for (int i = 0; i < 513; i++) {
        Placement placement;
        placement.translation = {i, 3, 0};
        scene.instances.push_back(placement);
    }
    addLight(scene, LIGHT_POINT, vec3(1)).position = {0, 3, 0};
    const PreparedScene many = prepared(scene);
    EXPECT_EQ(many.lightTable.singleCount, 1u);
    EXPECT_EQ(many.lightTable.choiceCount, 0u);
    EXPECT_EQ(many.lightTable.lightPerPower, 0);
    scene.lights.clear();
    scene.instances.resize(10);
    EXPECT_EQ(prepared(scene).lightTable.choiceCount, 3u + 10 * 2048);
}

/// A floor under a probe.
Scene probeScene(uint mapping, uint filter, uint32_t width, uint32_t height)
{
    Scene scene = emptyScene(8, 8, 4);
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0.5f));
    addLevel(scene, 0, 4);
    lookFrom(scene, {0, 1, 9}, {0, 0, 0}, 40);
    scene.probe = addProbe(scene, width, height, mapping, filter);
    return scene;
}

TEST(ProbeTable, isNotMadeForLightThatIsTheSameFromEverywhere)
{
    for (float radiance : {0.0f, 3.0f}) {
        for (uint32_t size : {1u, 4u}) {
            Scene scene = probeScene(PROBE_LATLONG, FILTER_BILINEAR, size, size);
            for (vec4& texel : scene.probeTexels) texel = vec4(vec3(radiance), 0);
            const PreparedScene plain = prepared(scene);
            EXPECT_EQ(plain.lightTable.probeMean, 0);
            EXPECT_TRUE(plain.lightTable.entries.empty());
        }
    }
}

TEST(ProbeTable, givesOneBrightTexelAll)
{
    for (uint mapping : {PROBE_LATLONG, PROBE_ANGULAR}) {
        Scene scene = probeScene(mapping, FILTER_NEAREST, 8, 8);
        scene.probeTexels[8 * 3 + 5] = vec4(1, 2, 3, 0);
        const PreparedScene bright = prepared(scene);
        EXPECT_GT(bright.lightTable.probeMean, 0);
        ASSERT_EQ(bright.lightTable.entries.size(), 64u);
        for (const AliasEntry& entry : bright.lightTable.entries) EXPECT_EQ(entry.alias, 29u);
        const auto texels = bright.deviceScene().probeTexels;
        EXPECT_EQ(texels[29].w, 64);
        EXPECT_EQ(texels[28].w, 0);
    }
}

TEST(ProbeTable, weighsTexelsByTheSolidAngleThatTheyStandFor)
{
    Scene scene = probeScene(PROBE_LATLONG, FILTER_NEAREST, 4, 6);
    for (vec4& texel : scene.probeTexels) texel = vec4(1);
    scene.probeTexels[0] = vec4(1.001f);  // else it would not be sampled
    const auto texels = prepared(scene);
    for (uint row = 0; row < 6; row++) {
        const double share =
            (std::cos(std::numbers::pi * row / 6) - std::cos(std::numbers::pi * (row + 1) / 6)) / 2;
        EXPECT_NEAR(texels.deviceScene().probeTexels[row * 4 + 1].w, 6 * share, 1e-3);
    }
}

TEST(ProbeTable, knowsHowMuchComesFromWhere)
{
    // Upper half white, lower half black: mean 1/2, and 3/4 more per unit of height (3 times the
    // mean of the height where it is positive, times a half). Points are found with a density of
    // 1/(2 pi), so a fifth of it is for shadow rays
    for (uint mapping : {PROBE_LATLONG, PROBE_ANGULAR}) {
        Scene scene = probeScene(mapping, FILTER_NEAREST, 64, 64);
        for (uint y = 0; y < 32; y++) {
            for (uint x = 0; x < 64; x++) scene.probeTexels[64 * y + x] = vec4(1, 1, 1, 0);
        }
        const vec3 axes[] = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}};  // up is +X
        scene.probe.axisX = axes[0];
        scene.probe.axisY = axes[1];
        scene.probe.axisZ = axes[2];
        const LightTable table = prepared(scene).lightTable;
        EXPECT_NEAR(table.probeMean, 0.5 / 5, 5e-4) << mapping;
        EXPECT_NEAR(table.probeSlope.x, 0.75 / 5, 5e-4) << mapping;
        EXPECT_NEAR(table.probeSlope.y, 0, 2e-3) << mapping;
        EXPECT_NEAR(table.probeSlope.z, 0, 2e-3) << mapping;
    }
}

TEST(ProbeTable, leavesSoftLightToScatteredRaysAndLampsToShadowRays)
{
    // Of lat-long maps of one row all directions are as likely, so one texel of n that shines is
    // found with a density of n / (4 pi)
    for (uint n : {2u, 4u, 64u}) {
        Scene scene = probeScene(PROBE_LATLONG, FILTER_NEAREST, n, 1);
        scene.probeTexels[n - 1] = vec4(10, 10, 10, 0);
        const double share = n * n / (n * n + 16.0);
        EXPECT_NEAR(prepared(scene).lightTable.probeMean, 10.0 / n * share, 1e-5) << n;
    }
}

TEST(LightClusters, haveTheStrengthOfAllAndAreWhereItIs)
{
    Scene scene = lampsScene();
    const LightTable table = prepared(scene).lightTable;
    ASSERT_EQ(table.clusterCount, 3u) << "each of three lights by itself";
    double sum = 0;
    for (uint i = 0; i < 3; i++) {
        const Light& cluster = table.lights[3 + i];
        EXPECT_EQ(cluster.type, LIGHT_CLUSTER);
        sum += cluster.intensity.x;
        if (cluster.position.x > 1.5f) {
            EXPECT_NEAR(cluster.intensity.x, 2 * 0.7152 * std::numbers::pi * 0.25, 1e-6);
            EXPECT_NEAR(cluster.cosOuter, 0.25, 1e-6) << "squared radius of the sphere";
            EXPECT_EQ(cluster.position, vec3(2, 2, 0));
        }
    }
    EXPECT_NEAR(sum, 3 * 2 * 0.5 + 2 * 0.7152 * std::numbers::pi * 0.25, 1e-5);
}

TEST(LightClusters, areFewHoweverManyLightsThereAre)
{
    Scene scene = lampsScene();
    for (uint i = 0; i < 100; i++) {
        Light& light = addLight(scene, i % 2 == 0 ? LIGHT_POINT : LIGHT_DIRECTIONAL, vec3(1));
        light.position = {float(i), 3, float(i * i % 17)};
        light.direction = {0, -1, 0};
    }
    const LightTable table = prepared(scene).lightTable;
    EXPECT_EQ(table.singleCount, 0u);
    EXPECT_EQ(table.choiceCount, 103u);
    ASSERT_EQ(table.clusterCount, MAX_LIGHT_CLUSTERS);
    double sum = 0, everywhere = 0;
    for (uint i = 0; i < table.clusterCount; i++) {
        sum += table.lights[103 + i].intensity.x;
        everywhere += table.lights[103 + i].cosInner;
    }
    EXPECT_NEAR(sum, 50 + 3 + 2 * 0.7152 * std::numbers::pi * 0.25, 1e-4);
    EXPECT_NEAR(everywhere, 50, 1e-4);
}

}  // namespace
}  // namespace sahl::testing
