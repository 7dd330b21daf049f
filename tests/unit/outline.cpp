// What is told of scenes before their trees are built: that kernels made for it are those that are needed.
#include "render/outline.h"

#include "device/scene_features.h"
#include "device/walked_tree.h"
#include "support/render_scenes.h"
#include "support/source_folder.h"

#include <gtest/gtest.h>

namespace sahl::testing {
namespace {

TEST(SceneOutline, hasTheFeaturesAndTheFormOfTheSceneWithItsTree)
{
    for (const char* name : {"default/default.json", "showcase/showcase.json", "report/fig05/teapot.json",
                             "report/fig07/phong.json", "report/fig12/shadows.json", "report/fig14/mirror.json",
                             "report/fig15/reflection.json", "report/fig20/path_tracing.json"}) {
        Scene scene = loadScene(sourceFolder() / "scenes" / name, {});
        const SceneOutline outline = outlineOf(scene);
        const PreparedScene prepared = prepareScene(std::move(scene), BvhBuild::automatic, 2);
        const DeviceScene whole = prepared.deviceScene();
        EXPECT_EQ(outline.features, featuresOf(whole)) << name;
        for (const bool registers : {true, false}) {
            for (const bool few : {true, false}) {
                const WalkForm expected = expectedWalkForm(outline.primitives, 4, registers, few);
                const WalkForm needed = walkFormFor(whole, 4, registers);
                EXPECT_EQ(expected.nodeWidth, needed.nodeWidth) << name;
                EXPECT_EQ(expected.stackInRegisters, needed.stackInRegisters) << name;
                EXPECT_GE(expected.stackEntries, needed.stackEntries) << name;
            }
        }
    }
}

TEST(SceneOutline, lightsThatPathsDoNotLookFor_areNoFeatures)
{
    Scene scene = builtInScene(smallPicture(8, 8, 1));
    scene.settings.lightSampling = LIGHTS_BSDF_ONLY;
    const SceneOutline outline = outlineOf(scene);
    const PreparedScene prepared = prepareScene(std::move(scene), BvhBuild::sweep, 1);
    EXPECT_EQ(outline.features, featuresOf(prepared.deviceScene()));
}

}  // namespace
}  // namespace sahl::testing
