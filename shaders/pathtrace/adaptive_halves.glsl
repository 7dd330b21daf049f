// The rules `crossed` and `joint`: decided between passes, from what the film's sums say of a pixel's
// noise and of its neighbours'. Needs adaptive_schedule.glsl and the picture's estimates: loadEstimate(x, y)
// within estimatesWidth() and estimatesHeight(). docs/adaptive.md says why the rules are as they are.

/// Mean luminance of n > 0 samples.
float meanLuminance(FilmSums sums, uint n)
{
    vec3 total = vec3(floatFromFixed(sums.red), floatFromFixed(sums.green), floatFromFixed(sums.blue));
    return flushed(luminance(total) * quotient(1.0f, float(n)));
}

/// Replicates among n samples: the samples, or whole blocks of them.
uint replicatesOf(AdaptiveRule rule, uint n) { return rule.overBlocks != 0u ? (n + 7u) >> 3u : n; }

/// Variance of a single sample's luminance, by the spread of n samples, 2 replicates at least, around their
/// mean. Of samples that are tied together in blocks: the variance that independent ones would need to have
/// for their means to be as noisy.
float sampleVariance(FilmSums sums, uint n, uint replicates, float mean)
{
    float excess = floatFromFixed(sums.y2) * quotient(1.0f, float(n)) - mean * mean;
    float variance = flushed(excess * quotient(float(n), float(replicates - 1u)));
    return variance > 0.0f ? variance : 0.0f;
}

/// What a pixel says of itself: see PixelEstimate. It has 2 replicates in each half at least.
PixelEstimate estimateOf(AdaptiveRule rule, FilmPixel film)
{
    PixelEstimate estimate;
    if (rule.rule == ADAPTIVE_CROSSED) {
        estimate.luminanceA = meanLuminance(film.sumsA, film.samplesA);
        estimate.varianceA = sampleVariance(film.sumsA, film.samplesA, replicatesOf(rule, film.samplesA),
                                            estimate.luminanceA);
        estimate.luminanceB = meanLuminance(film.sumsB, film.samplesB);
        estimate.varianceB = sampleVariance(film.sumsB, film.samplesB, replicatesOf(rule, film.samplesB),
                                            estimate.luminanceB);
        return estimate;
    }
    FilmSums both = film.sumsA;
    both.red = fixedSum(both.red, film.sumsB.red);
    both.green = fixedSum(both.green, film.sumsB.green);
    both.blue = fixedSum(both.blue, film.sumsB.blue);
    both.y2 = fixedSum(both.y2, film.sumsB.y2);
    uint n = samplesOf(film);
    estimate.luminanceA = meanLuminance(both, n);
    float ofSample = sampleVariance(both, n, replicatesOf(rule, n), estimate.luminanceA);
    estimate.varianceA = flushed(ofSample * quotient(1.0f, float(n)));
    estimate.luminanceB = 0.0f;
    estimate.varianceB = 0.0f;
    return estimate;
}

/// The standard error that a pixel may have [W m^-2 sr^-1], squared.
float allowedVariance(AdaptiveRule rule, float meanY, float leastY)
{
    float error = rule.targetError * max2(meanY, leastY);
    return flushed(error * error);
}

bool isWithin(uint x, uint y) { return x < estimatesWidth() && y < estimatesHeight(); }

// ---------------------------------------------------------------------------------------------------
// crossed: each half gets as many samples as the other half's pilots ask for, once.

CONST uint MOST_WANTED = 0x01000000u;  // where floats still count by ones

/// Samples for a half whose other half has this mean and this variance of a sample, in whole blocks. The
/// picture is the mean of the halves' means: with n samples in each its variance is variance / (2 n).
uint samplesFor(AdaptiveRule rule, float meanY, float variance, float leastY)
{
    float allowed = allowedVariance(rule, meanY, leastY);
    float perSample = allowed + allowed;
    // In this order nothing overflows.
    if (!(variance > perSample)) return BLOCK_SIZE;
    if (!(variance < perSample * 16777216.0f)) return MOST_WANTED;
    float n = quotient(variance, perSample);
    uint whole = uint(n);
    if (float(whole) < n) whole++;
    return smaller((whole + 7u) & ~7u, MOST_WANTED);
}

/// Samples that pixel (x, y)'s own pilots ask of half A (x) and half B (y); none outside of the picture.
uvec2 asked(AdaptiveRule rule, AdaptiveFloors floors, uint x, uint y)
{
    if (!isWithin(x, y)) return uvec2(0u, 0u);
    PixelEstimate estimate = loadEstimate(x, y);
    uint ofA = samplesFor(rule, estimate.luminanceB, estimate.varianceB, floors.ofB);
    uint ofB = samplesFor(rule, estimate.luminanceA, estimate.varianceA, floors.ofA);
    return uvec2(ofA, ofB);
}

uvec2 askedInRow(AdaptiveRule rule, AdaptiveFloors floors, uint x, uint y)
{
    uvec2 before = asked(rule, floors, x - 1u, y);
    uvec2 here = asked(rule, floors, x, y);
    uvec2 after = asked(rule, floors, x + 1u, y);
    return uvec2(larger(larger(before.x, here.x), after.x), larger(larger(before.y, here.y), after.y));
}

/// Samples that the rule wants of half A (x) and half B (y) of a pixel: the most that it or one of its
/// eight neighbours asks for, and the pilots at least.
uvec2 wantedByCrossed(AdaptiveRule rule, AdaptiveFloors floors, uint x, uint y)
{
    uvec2 above = askedInRow(rule, floors, x, y - 1u);
    uvec2 here = askedInRow(rule, floors, x, y);
    uvec2 below = askedInRow(rule, floors, x, y + 1u);
    uint pilots = pilotSamples(rule);
    return uvec2(larger(larger(larger(above.x, here.x), below.x), pilots),
                 larger(larger(larger(above.y, here.y), below.y), pilots));
}

// ---------------------------------------------------------------------------------------------------
// joint: a pixel goes on until its error and its neighbours' meet the target.

bool meetsTarget(AdaptiveRule rule, float leastY, uint x, uint y)
{
    if (!isWithin(x, y)) return true;
    PixelEstimate estimate = loadEstimate(x, y);
    return !(estimate.varianceA > allowedVariance(rule, estimate.luminanceA, leastY));
}

bool rowMeetsTarget(AdaptiveRule rule, float leastY, uint x, uint y)
{
    return meetsTarget(rule, leastY, x - 1u, y) && meetsTarget(rule, leastY, x, y) &&
           meetsTarget(rule, leastY, x + 1u, y);
}

/// State of a pixel that was active and has `n` samples, n >= minSamples.
uint stateByJoint(AdaptiveRule rule, AdaptiveFloors floors, uint x, uint y, uint n)
{
    bool isMet = rowMeetsTarget(rule, floors.ofA, x, y - 1u) && rowMeetsTarget(rule, floors.ofA, x, y) &&
                 rowMeetsTarget(rule, floors.ofA, x, y + 1u);
    if (isMet) return PIXEL_CONVERGED;
    return n >= rule.maxSamples ? PIXEL_AT_MAXIMUM : PIXEL_ACTIVE;
}
