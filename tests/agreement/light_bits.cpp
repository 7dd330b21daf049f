// Light of every kind has the same bits on every device, however it is looked for.
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

TEST_F(LightBits, areEqualForEveryKindOfLight)
{
    expectSameBits(lightScenes(20), LIGHTS_MIS);
}

TEST_F(LightBits, areEqualForShadowRaysAndScatteredRaysAlone)
{
    const LightScene all = lightScenes(20).back();
    for (uint32_t way : {LIGHTS_ONLY, LIGHTS_BSDF_ONLY}) expectSameBits({all}, way);
}

}  // namespace
}  // namespace sahl::testing
