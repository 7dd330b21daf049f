// Adaptive sampling: what a device keeps of each pixel from pass to pass, and how work is handed to it.
#ifndef SAHL_ADAPTIVE_TYPES_H
#define SAHL_ADAPTIVE_TYPES_H

#include "shared/film_types.h"

SHARED_BEGIN

// How a pixel comes to its number of samples (docs/adaptive.md).
SHARED_CONST uint ADAPTIVE_NONE = 0u;    // all pixels have the same
SHARED_CONST uint ADAPTIVE_REPORT = 1u;  // until a sample hardly moves the mean

struct AdaptiveRule
{
    uint rule;        // one of ADAPTIVE_*
    float epsilon;    // ADAPTIVE_REPORT: movement of the mean, in the channel that moves most [W m^-2 sr^-1]
    uint minSamples;  // no pixel stops before
    uint maxSamples;  // every pixel stops here
};
GPU_STRUCT_SIZE(AdaptiveRule, 16);

SHARED_CONST uint PIXEL_ACTIVE = 0u;
SHARED_CONST uint PIXEL_CONVERGED = 1u;   // the rule stopped it
SHARED_CONST uint PIXEL_AT_MAXIMUM = 2u;  // it has maxSamples, and the rule had not stopped it

// Sums of one half (A or B) of a pixel: 64.64 fixed point, lowest word first (pathtrace/film_sums.glsl).
struct FilmSums
{
    uvec4 red;
    uvec4 green;
    uvec4 blue;
    uvec4 y2;     // squared luminance of the samples
};
GPU_STRUCT_SIZE(FilmSums, 64);

// A pixel of the film as devices add it up. Counts of 64 bits have their low word in x.
struct FilmPixel
{
    FilmSums sumsA;
    FilmSums sumsB;
    uint samplesA;
    uint samplesB;
    uint digest;
    uint badSamples;
    uvec2 indirectRays;
    uvec2 shadowRays;
    uvec2 boxTests;
    uvec2 primitiveTests;
    uvec2 bounces;
    uint unused0;
    uint unused1;
};
GPU_STRUCT_SIZE(FilmPixel, 192);
GPU_FIELD(FilmPixel, samplesA, 128);
GPU_FIELD(FilmPixel, bounces, 176);

// All that is kept of a pixel. The newest pass stands apart from the film, so that the picture after
// the pass before can still be had when a signal comes in the middle of a pass.
struct AdaptivePixel
{
    FilmPixel film;    // of all passes but the newest
    PixelBlock block;  // of the newest
    vec3 mean;         // running mean of all samples, in float [W m^-2 sr^-1]
    uint state;        // one of PIXEL_*
    uint queue[2];     // entry i of two queues of pixels stands in element i: one binding serves for all
    uint unused0;
    uint unused1;
};
GPU_STRUCT_SIZE(AdaptivePixel, 288);
GPU_FIELD(AdaptivePixel, mean, 256);
GPU_FIELD(AdaptivePixel, queue, 272);

// What the host reads after a pass. Stands before the first AdaptivePixel of a tile.
struct AdaptiveCounts
{
    uint samplesMissing;  // of the pixel that lacks most to its block; only then 0 is the pass complete
    uint faults;          // FAULT_* of any pixel
    uint samplesDone;     // in the blocks of this pass
    uint activePixels;    // in the queue of the next pass
    uvec2 rays;           // of all kinds, in the blocks of this pass
    uint unused0;
    uint unused1;
};
GPU_STRUCT_SIZE(AdaptiveCounts, 32);
GPU_FIELD(AdaptiveCounts, rays, 16);

SHARED_CONST uint QUEUE_ALL = 2u;  // instead of a queue's number: all pixels of the tile

SHARED_CONST uint STAGE_FOLD = 0u;     // blocks of the pass before go into the film
SHARED_CONST uint STAGE_INSPECT = 1u;  // which blocks are complete?
SHARED_CONST uint STAGE_ADVANCE = 2u;  // if all are: the queue of the next pass

// One dispatch over a queue. Push constants.
struct AdaptiveDispatch
{
    uint tileX;         // [pixels] in the full picture
    uint tileY;
    uint tileWidth;
    uint queue;         // 0, 1 or QUEUE_ALL
    uint queueSize;
    uint nextQueue;     // STAGE_ADVANCE: 0 or 1
    uint stage;         // one of STAGE_*
    uint stepBudget;    // steps of traversal that one invocation may take
    AdaptiveRule rule;
};
GPU_STRUCT_SIZE(AdaptiveDispatch, 48);
GPU_FIELD(AdaptiveDispatch, rule, 32);

SHARED_END

#endif
