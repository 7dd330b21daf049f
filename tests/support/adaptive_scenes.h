// Scenes and films for tests of adaptive sampling.
#pragma once

#include "render/render_adaptive.h"
#include "support/render_scenes.h"

namespace sahl::testing {

inline AdaptiveRule reportRule(float epsilon, uint32_t minSamples, uint32_t maxSamples)
{
    return {ADAPTIVE_REPORT, epsilon, minSamples, maxSamples};
}

inline RenderResult renderAdaptiveFilm(Device& device, const PreparedScene& scene,
                                       const AdaptiveRule& rule, uint32_t tileSize = 0)
{
    device.setScene(scene.deviceScene());
    const RenderSettings& settings = scene.scene.settings;
    RenderPlan plan = {settings.width, settings.height, 0, 0, tileSize};
    return renderAdaptive(device, plan, rule, [](const RenderProgress&) {});
}

inline uint32_t samplesOf(const Film& film, size_t pixel)
{
    return film.half[0][pixel].samples + film.half[1][pixel].samples;
}

}  // namespace sahl::testing
