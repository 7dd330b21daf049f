// The rule `report`: decided after every sample, from that pixel's samples alone. Other rules decide
// between passes (adaptive_halves.glsl).

/// The report's rule: stop when a sample has moved the mean by less than epsilon in every channel,
/// |m(n) - m(n-1)| = |a(n) - m(n-1)| / n, once there are minSamples (and two means to compare).
///   L     the sample as the film has it: finite, not negative
///   n     number of samples with it, at most 2^24
///   mean  of the samples before; with it on return
bool stopsByReport(AdaptiveRule rule, vec3 L, uint n, INOUT(vec3) mean)
{
    vec3 change = flushed3((L - mean) * quotient(1.0f, float(n)));
    mean = flushed3(mean + change);
    return n >= 2u && n >= rule.minSamples && maxComponent(absolute3(change)) < rule.epsilon;
}

/// Takes the newest sample of a pixel into account and gives the pixel's PIXEL_*.
uint stateAfter(AdaptiveRule rule, vec3 L, uint n, INOUT(vec3) mean)
{
    if (rule.rule != ADAPTIVE_REPORT) return PIXEL_ACTIVE;
    if (stopsByReport(rule, L, n, mean)) return PIXEL_CONVERGED;
    return n >= rule.maxSamples ? PIXEL_AT_MAXIMUM : PIXEL_ACTIVE;
}
