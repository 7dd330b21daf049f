// The scene for which two ways of finding light were first put together.
#pragma once

#include "support/small_scenes.h"

#include <cmath>

namespace sahl::testing {

/// Veach 1997, Fig. 9.2: four plates of metal, rougher from one to the next, show four spheres of
/// equal power and very different size.
inline Scene veachScene(uint32_t width, uint32_t height)
{
    Scene scene = emptyScene(width, height, 1);
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0.2f));
    addLevel(scene, -4.2, 10);
    struct {
        double lowY, lowZ, highY, highZ;
        float alpha;
    } const plates[] = {{-2.70651, 0.25609, -2.08375, -0.526323, 0.005f},
                        {-3.28825, 1.36972, -2.83856, 0.476536, 0.02f},
                        {-3.73096, 2.70046, -3.43378, 1.74564, 0.05f},
                        {-3.99615, 4.0667, -3.82069, 3.08221, 0.1f}};
    for (const auto& plate : plates) {
        Material& metal = addMaterialOf(scene, MATERIAL_ROUGH_CONDUCTOR, vec3(1));
        metal.roughness = std::sqrt(plate.alpha);
        metal.conductorEta = vec3(0.2f, 0.92f, 1.1f);
        metal.conductorK = vec3(3.9f, 2.45f, 2.14f);
        addRectangle(scene, {-4, plate.lowY, plate.lowZ}, {8, 0, 0},
                     {0, plate.highY - plate.lowY, plate.highZ - plate.lowZ});
    }
    const float radii[] = {0.0333333f, 0.1f, 0.3f, 0.9f};
    for (int i = 0; i < 4; i++) {
        addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0)).emission = vec3(1 / (radii[i] * radii[i]));
        addSphere(scene, {-3.75f + 2.5f * float(i), 0, 0}, radii[i]);
    }
    lookFrom(scene, {0, 2, 15}, {0, -2, 2.5}, 34);
    return scene;
}

}  // namespace sahl::testing
