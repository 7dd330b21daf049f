// Reads every field of the structs of adaptive sampling and writes it back as one word, in order of
// declaration.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shared/adaptive_types.h"

layout(local_size_x = 1) in;
layout(std430, binding = 0) readonly buffer Pixels { AdaptivePixel pixels[]; };
layout(std430, binding = 1) readonly buffer Counts { AdaptiveCounts counts[]; };
layout(std430, binding = 2) readonly buffer Estimates { PixelEstimate estimates[]; };
layout(std430, binding = 3) writeonly buffer Words { uint words[]; };
layout(push_constant) uniform JobBlock { AdaptiveDispatch job; };

uint count = 0u;

void put(uint value) { words[count++] = value; }
void put(float value) { put(floatBitsToUint(value)); }
void put(uvec2 value) { put(value.x); put(value.y); }
void put(uvec4 value) { put(value.x); put(value.y); put(value.z); put(value.w); }
void put(vec3 value) { put(value.x); put(value.y); put(value.z); }
void put(FilmSums s) { put(s.red); put(s.green); put(s.blue); put(s.y2); }

void put(FilmPixel f)
{
    put(f.sumsA); put(f.sumsB); put(f.samplesA); put(f.samplesB); put(f.digest); put(f.badSamples);
    put(f.indirectRays); put(f.shadowRays); put(f.boxTests); put(f.primitiveTests); put(f.bounces);
    put(f.clamped);
}

void put(PixelBlock b)
{
    put(b.sum); put(b.sumY2); put(b.digest); put(b.samplesDone); put(b.status); put(b.badSamples);
    put(b.indirectRays); put(b.shadowRays); put(b.boxTests); put(b.primitiveTests);
    put(b.bounces); put(b.faults); put(b.clamped); put(b.unused0);
}

void put(AdaptiveRule r)
{
    put(r.rule); put(r.epsilon); put(r.minSamples); put(r.maxSamples);
    put(r.targetError); put(r.overBlocks); put(r.unused0); put(r.unused1);
}

void main()
{
    // The second element of each array: the stride counts as well.
    put(pixels[1].film); put(pixels[1].block); put(pixels[1].mean); put(pixels[1].state);
    put(pixels[1].firstSample); put(pixels[1].wantedA); put(pixels[1].wantedB); put(pixels[1].unused0);
    for (uint i = 0u; i < QUEUE_COUNT; i++) put(pixels[1].queue[i]);
    put(counts[1].samplesMissing); put(counts[1].faults); put(counts[1].samplesDone); put(counts[1].activePixels);
    put(counts[1].rays); put(counts[1].activeInB); put(counts[1].unused0);
    put(estimates[1].luminanceA); put(estimates[1].varianceA);
    put(estimates[1].luminanceB); put(estimates[1].varianceB);
    put(job.tileX); put(job.tileY); put(job.tileWidth); put(job.queue); put(job.queueSize); put(job.nextQueue);
    put(job.stage); put(job.stepBudget); put(job.pass); put(job.windowLeft); put(job.windowTop);
    put(job.windowWidth); put(job.windowHeight); put(job.unused0); put(job.floors.ofA); put(job.floors.ofB);
    put(job.rule);
}
