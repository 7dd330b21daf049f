// The hashes that tell scenes apart: what changes them and what does not.
#include "render/scene_hash.h"
#include "support/render_scenes.h"

#include <gtest/gtest.h>

#include <functional>

namespace sahl::testing {
namespace {

SceneHashes hashesWith(const std::function<void(Scene&)>& alter, BvhBuild build = BvhBuild::sweep)
{
    Scene scene = builtInScene(smallPicture(32, 24, 8));
    alter(scene);
    return hashesOf(prepareScene(std::move(scene), build, 1).deviceScene());
}

const SceneHashes& plain()
{
    static const SceneHashes hashes = hashesWith([](Scene&) {});
    return hashes;
}

TEST(SceneHash, sameScene_hasTheSameHashes)
{
    EXPECT_EQ(hashesWith([](Scene&) {}).scene, plain().scene);
    EXPECT_EQ(hashesWith([](Scene&) {}).tree, plain().tree);
    EXPECT_EQ(hashesWith([](Scene& scene) { scene.name = "other"; }).scene, plain().scene);
}

TEST(SceneHash, settingsThatPicturesTell_areNotInIt)
{
    const SceneHashes hashes = hashesWith([](Scene& scene) {
        scene.settings.spp = 99;
        scene.settings.seed = 7;
        scene.settings.maxBounces = 1;
        scene.settings.integrator = INTEGRATOR_PHONG;
        scene.settings.shading = SHADING_FLAT;
    });
    EXPECT_EQ(hashes.scene, plain().scene);
    EXPECT_EQ(hashes.tree, plain().tree);
}

TEST(SceneHash, anotherTree_changesTheHashOfTheTreeAlone)
{
    const SceneHashes hashes = hashesWith([](Scene&) {}, BvhBuild::binned);
    EXPECT_EQ(hashes.scene, plain().scene);
    EXPECT_NE(hashes.tree, plain().tree);
}

TEST(SceneHash, everyPartOfTheScene_changesIt)
{
    const std::function<void(Scene&)> changes[] = {
        [](Scene& scene) { scene.primitives[5].p0.x += 1e-6f; },
        [](Scene& scene) { scene.primitives[5].material ^= 1; },
        [](Scene& scene) { scene.triangleCorners[3].n1.y *= 0.5f; },
        [](Scene& scene) { scene.materials[0].baseColor.z *= 0.5f; },
        [](Scene& scene) { scene.lights[0].intensity.x *= 2; },
        [](Scene& scene) { scene.lights.push_back(scene.lights[0]); },
        [](Scene& scene) { scene.probeTexels[1].y *= 2; },
        [](Scene& scene) { scene.probe.axisX.y += 0.25f; },
        [](Scene& scene) { scene.background = plainProbe(0, 0, PROBE_LATLONG, FILTER_NEAREST); },
        [](Scene& scene) { scene.camera.position.x += 1; },
        [](Scene& scene) { scene.settings.jitter = false; },
        [](Scene& scene) { scene.settings.ambient.y = 0.5f; },
        [](Scene& scene) { scene.primitives.pop_back(); },
    };
    size_t number = 0;
    for (const auto& change : changes)
        EXPECT_NE(hashesWith(change).scene, plain().scene) << number++;
}

}  // namespace
}  // namespace sahl::testing
