// Fireflies of pictures that are known to have them, and of some that have none.
#include "film/fireflies.h"
#include "support/render_scenes.h"
#include "support/small_scenes.h"

#include <gtest/gtest.h>

namespace sahl::testing {
namespace {

/// A floor under a lamp; a ball of glass between them gathers its light, where scattered rays alone
/// find it.
Scene lampScene(float radius, float radiance, bool withGlass)
{
    Scene scene = emptyScene(48, 32, 32);
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0.6f));
    addLevel(scene, 0, 5);
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0)).emission = vec3(radiance);
    addSphere(scene, {0, 4.2f, 0}, radius);
    if (withGlass) {
        addMaterialOf(scene, MATERIAL_DIELECTRIC, vec3(1)).eta = 1.5f;
        addSphere(scene, {0, 1, 0}, 0.8f);
    }
    scene.settings.maxBounces = 6;
    lookFrom(scene, {0, 3, 6}, {0, 0.6, 0}, 40);
    return scene;
}

std::vector<Firefly> found(Scene scene, uint samplerKind, Film& film)
{
    scene.settings.samplerKind = samplerKind;
    const PreparedScene prepared = prepareScene(std::move(scene), BvhBuild::sweep, 2);
    film = renderFilm(*makeCpuDevice({}), prepared, 0, 128);
    return firefliesOf(film);
}

TEST(FirefliesOfScenes, areFoundInTheCausticOfASmallLamp)
{
    Film film;
    const std::vector<Firefly> fireflies =
        found(lampScene(0.1f, 400, true), SAMPLER_INDEPENDENT, film);
    ASSERT_FALSE(fireflies.empty());
    EXPECT_GT(excessShare(film, fireflies), 0.02);
    EXPECT_GT(fireflies[0].share, 0.4);
    // Below the ball, where the light is gathered, or in the ball itself
    EXPECT_NEAR(fireflies[0].x, 24, 12);
    EXPECT_GT(fireflies[0].y, 8u);
}

TEST(FirefliesOfScenes, areNoneWhereEveryLightIsSampled)
{
    for (uint sampler : {SAMPLER_INDEPENDENT, SAMPLER_SOBOL}) {
        Film film;
        EXPECT_TRUE(found(lampScene(0.3f, 40, false), sampler, film).empty()) << sampler;
    }
}

}  // namespace
}  // namespace sahl::testing
