// A scene with rare bright samples.
#pragma once

#include "support/small_scenes.h"

namespace sahl::testing {

/// A floor and a glass ball under a small bright lamp that paths meet by chance: for most pixels
/// about one sample in a hundred is bright, all others are black.
inline Scene lampScene(uint32_t width, uint32_t height, uint32_t seed)
{
    Scene scene = emptyScene(width, height, 6);
    scene.settings.seed = seed;
    scene.settings.lightSampling = LIGHTS_BSDF_ONLY;
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0.7f));
    addLevel(scene, 0, 4);
    addMaterialOf(scene, MATERIAL_DIELECTRIC, vec3(1), 1.5f);
    addSphere(scene, {0, 0.5f, 0}, 0.5f);
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0)).emission = vec3(60);
    addLevel(scene, 3, 0.25, false);
    lookFrom(scene, {0, 1.2, 4}, {0, 0.5, 0}, 40);
    return scene;
}

}  // namespace sahl::testing
