// Scenes and films for tests of adaptive sampling.
#pragma once

#include "render/render_adaptive.h"
#include "support/forwarding_device.h"
#include "support/render_scenes.h"

namespace sahl::testing {

inline AdaptiveRule reportRule(float epsilon, uint32_t minSamples, uint32_t maxSamples)
{
    return {ADAPTIVE_REPORT, epsilon, minSamples, maxSamples, 0, 0, 0, 0};
}

/// `rule`: ADAPTIVE_CROSSED or ADAPTIVE_JOINT; samples in multiples of 16 and of 8.
inline AdaptiveRule targetRule(uint32_t rule, float target, uint32_t minSamples, uint32_t maxSamples)
{
    return {rule, 0, minSamples, maxSamples, target, 0, 0, 0};
}

inline RenderResult renderAdaptiveFilm(Device& device, const PreparedScene& scene,
                                       const AdaptiveRule& rule, uint32_t tileSize = 0)
{
    device.setScene(scene.deviceScene());
    const RenderSettings& settings = scene.scene.settings;
    RenderPlan plan = {settings.width, settings.height, 0, 0, tileSize};
    return renderAdaptive(device, plan, rule, [](const RenderProgress&) {});
}

/// A device that has room for few pixels under adaptive sampling.
struct SmallDevice : ForwardingDevice {
    uint64_t maxAdaptivePixels() const override { return 300; }
};

inline uint32_t samplesOf(const Film& film, size_t pixel)
{
    return film.half[0][pixel].samples + film.half[1][pixel].samples;
}

}  // namespace sahl::testing
