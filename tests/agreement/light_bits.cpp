// Light of every kind has the same bits on every device, however it is looked for.
#include "film/fireflies.h"
#include "statistical/lamp_scene.h"
#include "support/device_test.h"
#include "support/light_scenes.h"
#include "support/render_scenes.h"

namespace sahl::testing {
namespace {

class LightBits : public DeviceTest {
protected:
    /// Of small pictures, all on one device.
    static void expectSameBits(const std::vector<LightScene>& scenes, uint32_t way)
    {
        auto device = openFirstDevice({});
        auto cpu = makeCpuDevice({});
        for (const LightScene& lit : scenes) {
            Scene scene = lit.scene;
            scene.settings.lightSampling = way;
            const PreparedScene prepared = prepareScene(std::move(scene), BvhBuild::sweep, 2);
            const Film expected = renderFilm(*cpu, prepared, 0, 8);
            EXPECT_TRUE(renderFilm(*device, prepared, 0, 8) == expected) << lit.name;
            EXPECT_EQ(expected.counters.badSamples, 0u) << lit.name;
            EXPECT_EQ(expected.counters.shadowRays > 0,
                      way != LIGHTS_BSDF_ONLY || lit.name == "all")
                << lit.name;
        }
    }
};

using LongLightBits = LightBits;

TEST_F(LightBits, areEqualForAllLightsTogetherByEveryWayOfFindingThem)
{
    const LightScene all = lightScenes(16).back();
    for (uint32_t way : {LIGHTS_MIS, LIGHTS_ONLY, LIGHTS_BSDF_ONLY}) expectSameBits({all}, way);
}

TEST_F(LongLightBits, areEqualForEveryKindOfLight)
{
    expectSameBits(lightScenes(24), LIGHTS_MIS);
}

TEST_F(LightBits, firefliesAreTheSame)
{
    const PreparedScene lamp = prepareScene(lampScene(24, 16, 1), BvhBuild::sweep, 2);
    const std::vector<Firefly> expected = firefliesOf(renderFilm(*makeCpuDevice({}), lamp, 0, 16));
    const std::vector<Firefly> found = firefliesOf(renderFilm(*openFirstDevice(), lamp, 0, 16));
    EXPECT_GT(expected.size(), 10u);
    ASSERT_EQ(found.size(), expected.size());
    for (size_t i = 0; i < found.size(); i++) {
        EXPECT_EQ(found[i].x, expected[i].x);
        EXPECT_EQ(found[i].y, expected[i].y);
        EXPECT_EQ(found[i].luminance, expected[i].luminance);
        EXPECT_EQ(found[i].around, expected[i].around);
        EXPECT_EQ(found[i].share, expected[i].share);
    }
}

}  // namespace
}  // namespace sahl::testing
