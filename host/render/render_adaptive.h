// The render loop of adaptive sampling: passes over the pixels that still need samples.
#pragma once

#include "render/render.h"

namespace sahl {

/// Renders the plan's window by a rule, from sample 0 on; plan.firstSample and sampleCount have no
/// meaning. Tiles go through passes together as far as the device has room for their pixels, then
/// the next ones do. The device's scene must be set. `report` is called after every pass of a tile,
/// `passDone` after every whole pass with a function that gives the picture so far: that takes a
/// moment, since it is on the device.
RenderResult renderAdaptive(
    Device& device, const RenderPlan& plan, const AdaptiveRule& rule,
    const std::function<void(const RenderProgress&)>& report,
    const std::function<void(const std::function<RenderResult()>&)>& passDone = {});

}  // namespace sahl
