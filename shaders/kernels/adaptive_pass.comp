// What surrounds a pass of adaptive sampling, over one queue at a time: its blocks go into the film
// once the next pass begins, it is inspected for blocks that are not complete, and pixels that the rule
// has not stopped are put into the queue of a later pass. Their order there is free.
#version 460
#extension GL_GOOGLE_include_directive : require

#define CONST const
#define OUT(T) out T
#define INOUT(T) inout T
#define ADAPTIVE_BINDING 0
#include "kernels/adaptive.glsl"
#include "pathtrace/film_sums.glsl"
#include "pathtrace/adaptive_schedule.glsl"

void fold(uint index)
{
    FilmPixel film = pixels[index].film;
    addBlock(pixels[index].block, pixels[index].firstSample, film);
    pixels[index].film = film;
    pixels[index].block = emptyBlock();
}

void inspect(uint index)
{
    PixelBlock block = pixels[index].block;
    if (block.faults != 0u) atomicOr(counts.faults, block.faults);
    atomicAdd(counts.samplesDone, block.samplesDone);
    if (pixels[index].state != PIXEL_ACTIVE || block.samplesDone == BLOCK_SIZE) return;
    uint samples = pixels[index].film.samplesA + pixels[index].film.samplesB;
    uint wanted = min(BLOCK_SIZE, job.rule.maxSamples - samples);
    atomicMax(counts.samplesMissing, wanted - block.samplesDone);
}

void advance(uint index)
{
    if (counts.samplesMissing != 0u) return;
    PixelBlock block = pixels[index].block;
    uint rays = block.samplesDone + block.indirectRays + block.shadowRays;
    uint before = atomicAdd(counts.rays.x, rays);
    if (before + rays < before) atomicAdd(counts.rays.y, 1u);
    if (job.nextQueue == QUEUE_NONE || pixels[index].state != PIXEL_ACTIVE) return;
    if (job.rule.rule == ADAPTIVE_CROSSED && pixels[index].wantedA != 0u) {
        uint wantedA = pixels[index].wantedA;
        uint wantedB = pixels[index].wantedB;
        pixels[index].state = stateByCrossed(job.rule, wantedA, wantedB, job.pass + 1u);
        if (!halfGoesOn(job.rule, wantedA, wantedB, job.pass)) return;
    }
    uint place = atomicAdd(counts.activePixels, 1u);
    pixels[place].queue[job.nextQueue] = index;
}

void main()
{
    uint slot = queueSlot();
    if (slot >= job.queueSize) return;
    uint index = queuedPixel(slot);
    if (job.stage == STAGE_FOLD) {
        fold(index);
    } else if (job.stage == STAGE_INSPECT) {
        inspect(index);
    } else {
        advance(index);
    }
}
