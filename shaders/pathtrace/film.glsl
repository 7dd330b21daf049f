// What a finished sample adds to its pixel's block.

bool isRadiance(float x) { return isFiniteNumber(x) && !(x < 0.0f); }

/// A block as one replicate: samples in it times the squared luminance of its mean. So the squares of
/// blocks of any size add up to what tells how they spread (docs/sampling.md).
///   sumY  luminance of the sum of `n` samples
float squareOfBlock(float sumY, uint n) { return flushed(sumY * quotient(sumY, float(n))); }

/// Adds the path's radiance to the block, in sample order, and returns what was added. A sample that is
/// negative or not finite counts as black and is counted.
vec3 addSample(READ(PathState) path, INOUT(PixelBlock) block)
{
    vec3 L = flushed3(path.L);
    float y = luminance(L);
    float y2 = flushed(y * y);
    if (!(isRadiance(L.x) && isRadiance(L.y) && isRadiance(L.z) && isFiniteNumber(y2))) {
        L = vec3(0.0f);
        y2 = 0.0f;
        block.badSamples++;
    }
    block.sum = block.sum + L;
    block.digest += path.digest;
    block.samplesDone++;
    if (!HAS_BLOCKS || (HAS_INDEPENDENT && UNIFORM(samplerKind) == SAMPLER_INDEPENDENT)) {
        block.sumY2 = block.sumY2 + y2;
    } else {
        block.sumY2 = squareOfBlock(luminance(block.sum), block.samplesDone);
    }
    block.indirectRays += tally.indirectRays;
    block.shadowRays += tally.shadowRays;
    block.boxTests += tally.boxTests;
    block.primitiveTests += tally.primitiveTests;
    block.bounces += tally.bounces;
    block.clamped += tally.clamped;
    return L;
}
