// Decisions that look at more than one pixel, between two passes: the estimates of all pixels of the picture
// are made first, tile by tile; then every tile decides by them who goes on.
#version 460
#extension GL_GOOGLE_include_directive : require

#define CONST const
#define OUT(T) out T
#define INOUT(T) inout T
#define fusedMultiplyAdd(a, b, c) fma(a, b, c)
#define ADAPTIVE_BINDING 0
#include "kernels/adaptive.glsl"

layout(constant_id = SPEC_MATH) const uint MATH = MATH_NATIVE;

layout(std430, set = 0, binding = 1) buffer EstimatesBlock
{
    PixelEstimate estimates[];
};

uint estimatesWidth() { return job.windowWidth; }

uint estimatesHeight() { return job.windowHeight; }

PixelEstimate loadEstimate(uint x, uint y) { return estimates[y * job.windowWidth + x]; }

#include "pathtrace/exact.glsl"
#include "pathtrace/math.glsl"
#include "pathtrace/film_sums.glsl"
#include "pathtrace/adaptive_schedule.glsl"
#include "pathtrace/adaptive_halves.glsl"

void putIntoQueue(uint queue, uint place, uint index) { pixels[place].queue[queue] = index; }

void decideByCrossed(uint index, uint x, uint y)
{
    uvec2 wanted = wantedByCrossed(job.rule, job.floors, x, y);
    uint passes = job.pass + 1u;
    pixels[index].wantedA = wanted.x;
    pixels[index].wantedB = wanted.y;
    pixels[index].state = stateByCrossed(job.rule, wanted.x, wanted.y, passes);
    // The pilots of both halves are as many, so that half A comes next, then B.
    if (lacksInA(job.rule, wanted.x, passes)) putIntoQueue(job.nextQueue, atomicAdd(counts.activePixels, 1u), index);
    if (lacksInB(job.rule, wanted.y, passes)) {
        putIntoQueue((job.nextQueue + 1u) % QUEUE_COUNT, atomicAdd(counts.activeInB, 1u), index);
    }
}

void decideByJoint(uint index, uint x, uint y)
{
    uint n = samplesOf(pixels[index].film) + pixels[index].block.samplesDone;
    uint state = stateByJoint(job.rule, job.floors, x, y, n);
    pixels[index].state = state;
    if (state == PIXEL_ACTIVE) putIntoQueue(job.nextQueue, atomicAdd(counts.activePixels, 1u), index);
}

void main()
{
    uint slot = queueSlot();
    if (slot >= job.queueSize) return;
    uint index = queuedPixel(slot);
    uint x = job.tileX - job.windowLeft + index % job.tileWidth;
    uint y = job.tileY - job.windowTop + index / job.tileWidth;
    if (job.stage == STAGE_ESTIMATE) {
        FilmPixel film = pixels[index].film;
        addBlock(pixels[index].block, pixels[index].firstSample, film);
        estimates[y * job.windowWidth + x] = estimateOf(job.rule, film);
    } else if (job.rule.rule == ADAPTIVE_CROSSED) {
        decideByCrossed(index, x, y);
    } else {
        decideByJoint(index, x, y);
    }
}
