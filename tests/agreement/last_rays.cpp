// The last ray of a path where no surface shines ends at any hit: that saves work and changes nothing else.

#include "support/adaptive_scenes.h"
#include "support/device_test.h"
#include "support/small_scenes.h"

namespace sahl::testing {
namespace {

constexpr uint32_t SIDE = 24, SPP = 8;

/// Balls in a trough under a sky, so that last rays meet something, and behind it something else.
Scene trough()
{
    Scene scene = emptyScene(SIDE, SIDE, 2);
    scene.settings.spp = SPP;
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0.6f));
    addLevel(scene, 0, 4);
    for (float x : {-1.2f, 0.0f, 1.2f}) {
        for (float z : {-1.2f, 0.0f, 1.2f}) addSphere(scene, {x, 0.5f, z}, 0.55f);
    }
    scene.probe = addProbe(scene, 4, 2, PROBE_LATLONG, FILTER_NEAREST);
    for (vec4& texel : scene.probeTexels) texel = vec4(1, 2, 3, 0);
    lookFrom(scene, {0, 3, 5}, {0, 0.5, 0}, 40);
    return scene;
}

std::vector<PixelBlock> blocksOf(Device& device, const DeviceScene& scene)
{
    std::vector<PixelBlock> blocks(size_t{SIDE} * SIDE);
    device.setScene(scene);
    device.render({0, 0, SIDE, SIDE, 0, SPP}, blocks);
    return blocks;
}

class LastRays : public DeviceTest {
protected:
    static void expectLessWorkAndTheSameLight(Device& device)
    {
        const PreparedScene prepared = prepareScene(trough(), BvhBuild::sweep, 2);
        DeviceScene scene = prepared.deviceScene();
        ASSERT_NE(scene.frame.shading & SHADING_DARK, 0u);
        const std::vector<PixelBlock> any = blocksOf(device, scene);
        scene.frame.shading &= ~SHADING_DARK;
        const std::vector<PixelBlock> closest = blocksOf(device, scene);
        uint64_t boxesOfAny = 0, boxesOfClosest = 0, testsOfAny = 0, testsOfClosest = 0;
        for (size_t i = 0; i < any.size(); i++) {
            EXPECT_EQ(any[i].sum, closest[i].sum) << i;
            EXPECT_EQ(any[i].sumY2, closest[i].sumY2) << i;
            EXPECT_EQ(any[i].indirectRays, closest[i].indirectRays) << i;
            EXPECT_EQ(any[i].shadowRays, closest[i].shadowRays) << i;
            EXPECT_EQ(any[i].bounces, closest[i].bounces) << i;
            boxesOfAny += any[i].boxTests;
            boxesOfClosest += closest[i].boxTests;
            testsOfAny += any[i].primitiveTests;
            testsOfClosest += closest[i].primitiveTests;
        }
        EXPECT_LE(boxesOfAny, boxesOfClosest);
        EXPECT_LT(testsOfAny, testsOfClosest);
        EXPECT_GT(testsOfAny, testsOfClosest / 2);
    }
};

TEST_F(LastRays, endAtAnyHitOnTheCpu)
{
    expectLessWorkAndTheSameLight(*makeCpuDevice({}));
}

TEST_F(LastRays, endAtAnyHitOnTheDevice_wholeAndInWaves)
{
    expectLessWorkAndTheSameLight(*openFirstDevice());
    DeviceOptions inWaves;
    inWaves.variant = "texel-wave";
    expectLessWorkAndTheSameLight(*openFirstDevice(inWaves));
}

TEST_F(LastRays, findTheClosestHitWhereASurfaceShines)
{
    Scene scene = trough();
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0.2f)).emission = vec3(5);
    addSphere(scene, {0, 2, 0}, 0.3f);
    const PreparedScene prepared = prepareScene(std::move(scene), BvhBuild::sweep, 2);
    EXPECT_EQ(prepared.deviceScene().frame.shading & SHADING_DARK, 0u);
    EXPECT_TRUE(renderFilm(*openFirstDevice(), prepared) == renderFilm(*makeCpuDevice({}), prepared));
}

}  // namespace
}  // namespace sahl::testing
