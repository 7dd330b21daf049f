// When rules of adaptive sampling look at the picture: what devices and the render loop agree on.
#pragma once

#include "shared/adaptive_types.h"
#include "shared/film_types.h"

namespace sahl {

/// Whether a pixel's number of samples depends on its neighbours: all tiles go through passes
/// together.
inline bool looksAtNeighbours(const AdaptiveRule& rule)
{
    return rule.rule == ADAPTIVE_CROSSED || rule.rule == ADAPTIVE_JOINT;
}

/// Whether a decision follows the pass after which there were `passes`: once under `crossed`, when
/// all pilots are there; under `joint` after every pass from then on.
inline bool decisionIsDue(const AdaptiveRule& rule, uint32_t passes)
{
    const uint32_t pilots = rule.minSamples / BLOCK_SIZE;
    if (rule.rule == ADAPTIVE_CROSSED) return passes == pilots;
    return rule.rule == ADAPTIVE_JOINT && passes >= pilots;
}

/// Whether every half of a pixel has a queue of its own in the passes after `passes`.
inline bool halvesGoApart(const AdaptiveRule& rule, uint32_t passes)
{
    return rule.rule == ADAPTIVE_CROSSED && passes >= rule.minSamples / BLOCK_SIZE;
}

}  // namespace sahl
