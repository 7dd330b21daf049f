// The render loop of adaptive sampling: passes over the pixels that still need samples.
#pragma once

#include "render/render.h"

namespace sahl {

/// How far the rule came.
struct AdaptiveOutcome {
    uint64_t pixels = 0;     ///< of the picture
    uint64_t converged = 0;  ///< that the rule stopped
    uint64_t atMaximum = 0;  ///< that have maxSamples without; the others were interrupted
};

struct AdaptiveResult {
    RenderResult render;  ///< interrupted: whole passes only, unless it was in the first one
    AdaptiveOutcome outcome;
};

/// Renders plan.width x plan.height pixels by a rule; plan.firstSample is 0, and plan.sampleCount
/// has no meaning. Tiles go through passes together as far as the device has room for their pixels,
/// then the next ones do. The device's scene must be set. `report` is called after every pass of a
/// tile.
AdaptiveResult renderAdaptive(Device& device, const RenderPlan& plan, const AdaptiveRule& rule,
                              const std::function<void(const RenderProgress&)>& report);

}  // namespace sahl
