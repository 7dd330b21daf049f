// What the scenes of several terms have in common.
#pragma once

#include "support/small_scenes.h"

namespace sahl::testing {

/// A picture of 32 x 32 pixels.
inline Scene scene32(uint32_t maxBounces)
{
    return emptyScene(32, 32, maxBounces);
}

/// A sky that varies smoothly in colour and brightness with the texel's row and column. All texels
/// are bright, so that little noise comes from it.
inline Probe addSky(Scene& scene, uint mapping, uint filter)
{
    const uint32_t width = mapping == PROBE_ANGULAR ? 12 : 16,
                   height = mapping == PROBE_ANGULAR ? 12 : 8;
    const Probe probe = addProbe(scene, width, height, mapping, filter);
    for (uint32_t y = 0; y < height; y++) {
        for (uint32_t x = 0; x < width; x++) {
            const float u = (static_cast<float>(x) + 0.5f) / static_cast<float>(width);
            const float v = (static_cast<float>(y) + 0.5f) / static_cast<float>(height);
            const float wave = std::sin(2 * std::numbers::pi_v<float> * u);
            scene.probeTexels[probe.firstTexel + y * width + x] =
                vec4(1.5f - v + 0.3f * wave, 1.2f - 0.6f * v * v, 0.5f + v - 0.4f * wave, 0);
        }
    }
    return probe;
}

inline void setSky(Scene& scene)
{
    scene.probe = addSky(scene, PROBE_LATLONG, FILTER_BILINEAR);
    scene.background = blackProbe();
}

inline void scaleBaseColors(Scene& scene, float by)
{
    for (Material& material : scene.materials) material.baseColor *= 1 + by;
}

inline void scaleEtas(Scene& scene, float by)
{
    for (Material& material : scene.materials) material.eta *= 1 + by;
}

inline void scaleProbes(Scene& scene, float by)
{
    for (vec4& texel : scene.probeTexels) texel *= 1 + by;
}

/// Two walls that see the sky and each other. The background is black and nothing shines, so all
/// light has been reflected by the material.
inline Scene corner(uint type, uint32_t maxBounces)
{
    Scene scene = scene32(maxBounces);
    addMaterialOf(scene, type, {0.8f, 0.7f, 0.5f});
    addRectangle(scene, {-3, 0, -1}, {0, 0, 4}, {6, 0, 0});
    addRectangle(scene, {-3, 0, -1}, {6, 0, 0}, {0, 3, 0});
    setSky(scene);
    lookFrom(scene, {0.3, 2, 4}, {0, 0.8, 0}, 35);
    return scene;
}

}  // namespace sahl::testing
