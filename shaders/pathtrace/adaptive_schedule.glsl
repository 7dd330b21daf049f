// Which blocks pixels get under the rule `crossed`, once it has decided. Integers alone.

uint larger(uint a, uint b) { return a < b ? b : a; }

uint smaller(uint a, uint b) { return b < a ? b : a; }

/// Pilots of each half.
uint pilotSamples(AdaptiveRule rule) { return rule.minSamples >> 1u; }

uint mostOfHalf(AdaptiveRule rule) { return rule.maxSamples >> 1u; }

/// Whether a half still lacks samples once it has `blocks` blocks.
bool lacksSamples(AdaptiveRule rule, uint wanted, uint blocks)
{
    return blocks * BLOCK_SIZE < smaller(wanted, mostOfHalf(rule));
}

/// Whether half A lacks samples after `passes` passes, at least those of the pilots. Pass p renders block p
/// of the pixels whose half (A when p is even, else B) lacks samples. So how many samples a half has after
/// any pass depends on what is wanted of that half alone, and a picture of fewer passes has no bias either.
bool lacksInA(AdaptiveRule rule, uint wantedA, uint passes) { return lacksSamples(rule, wantedA, (passes + 1u) >> 1u); }

bool lacksInB(AdaptiveRule rule, uint wantedB, uint passes) { return lacksSamples(rule, wantedB, passes >> 1u); }

/// A pixel's state after `passes` passes.
uint stateByCrossed(AdaptiveRule rule, uint wantedA, uint wantedB, uint passes)
{
    if (lacksInA(rule, wantedA, passes) || lacksInB(rule, wantedB, passes)) return PIXEL_ACTIVE;
    return larger(wantedA, wantedB) <= mostOfHalf(rule) ? PIXEL_CONVERGED : PIXEL_AT_MAXIMUM;
}

/// Whether a pixel that took block `pass` takes block pass + 2: of the same half.
bool halfGoesOn(AdaptiveRule rule, uint wantedA, uint wantedB, uint pass)
{
    return (pass & 1u) == 0u ? lacksInA(rule, wantedA, pass + 1u) : lacksInB(rule, wantedB, pass + 1u);
}
