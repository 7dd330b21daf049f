// Adaptive sampling: what a device keeps of each pixel from pass to pass, and how work is handed to it.
#ifndef SAHL_ADAPTIVE_TYPES_H
#define SAHL_ADAPTIVE_TYPES_H

#include "shared/film_types.h"

SHARED_BEGIN

// How a pixel comes to its number of samples (docs/adaptive.md).
SHARED_CONST uint ADAPTIVE_NONE = 0u;    // all pixels have the same
SHARED_CONST uint ADAPTIVE_REPORT = 1u;  // until a sample hardly moves the mean
SHARED_CONST uint ADAPTIVE_CROSSED = 2u; // each half has as many as the other half's pilots ask for
SHARED_CONST uint ADAPTIVE_JOINT = 3u;   // until the error of both halves together meets the target

struct AdaptiveRule
{
    uint rule;          // one of ADAPTIVE_*
    float epsilon;      // ADAPTIVE_REPORT: movement of the mean, in the channel that moves most [W m^-2 sr^-1]
    uint minSamples;    // no pixel stops before; ADAPTIVE_CROSSED: the pilots of both halves together
    uint maxSamples;    // every pixel stops here
    float targetError;  // ADAPTIVE_CROSSED, _JOINT: one standard error of a pixel, relative to its luminance
    uint overBlocks;    // 1: noise is seen by the spread of blocks of samples (SAMPLER_SOBOL), 0: of samples.
                        // Whoever runs the rule sets it by the scene's sampler
    uint unused0;
    uint unused1;
};
GPU_STRUCT_SIZE(AdaptiveRule, 32);
GPU_FIELD(AdaptiveRule, targetError, 16);

// Luminances below which the error of a pixel is taken relative to these: 1 % of the picture's median
// [W m^-2 sr^-1].
struct AdaptiveFloors
{
    float ofA;  // ADAPTIVE_CROSSED: from A's pilots; ADAPTIVE_JOINT: from both halves'
    float ofB;  // ADAPTIVE_CROSSED: from B's pilots
};
GPU_STRUCT_SIZE(AdaptiveFloors, 8);

// What a pixel's samples say of its noise. ADAPTIVE_CROSSED: each half's pilots, variance of a single
// sample. ADAPTIVE_JOINT: both halves in A's place, variance of their mean.
struct PixelEstimate
{
    float luminanceA;  // mean [W m^-2 sr^-1]
    float varianceA;
    float luminanceB;
    float varianceB;
};
GPU_STRUCT_SIZE(PixelEstimate, 16);

SHARED_CONST uint PIXEL_ACTIVE = 0u;
SHARED_CONST uint PIXEL_CONVERGED = 1u;   // the rule stopped it
SHARED_CONST uint PIXEL_AT_MAXIMUM = 2u;  // it has maxSamples, and the rule had not stopped it

// Sums of one half (A or B) of a pixel: 64.64 fixed point, lowest word first (pathtrace/film_sums.glsl).
struct FilmSums
{
    uvec4 red;
    uvec4 green;
    uvec4 blue;
    uvec4 y2;     // sumY2 of the blocks
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
    uvec2 clamped;
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
    vec3 mean;         // ADAPTIVE_REPORT: running mean of all samples, in float [W m^-2 sr^-1]
    uint state;        // one of PIXEL_*
    uint firstSample;  // of `block`
    uint wantedA;      // ADAPTIVE_CROSSED: samples that B's pilots ask of half A; 0 before the decision
    uint wantedB;      // and A's pilots of half B. A half gets at most half of maxSamples
    uint unused0;
    uint queue[4];     // entry i of four queues of pixels stands in element i: one binding serves for all
};
GPU_STRUCT_SIZE(AdaptivePixel, 304);
GPU_FIELD(AdaptivePixel, mean, 256);
GPU_FIELD(AdaptivePixel, wantedA, 276);
GPU_FIELD(AdaptivePixel, queue, 288);

// What the host reads after a pass. Stands before the first AdaptivePixel of a tile.
struct AdaptiveCounts
{
    uint samplesMissing;  // of the pixel that lacks most to its block; only then 0 is the pass complete
    uint faults;          // FAULT_* of any pixel
    uint samplesDone;     // in the blocks of this pass
    uint activePixels;    // in the queue that this pass or decision filled
    uvec2 rays;           // of all kinds, in the blocks of this pass
    uint activeInB;       // ADAPTIVE_CROSSED, after the decision: in the queue of the pass after the next
    uint unused0;
};
GPU_STRUCT_SIZE(AdaptiveCounts, 32);
GPU_FIELD(AdaptiveCounts, rays, 16);

// The pixels of pass p, counted from 0, stand in queue p % 4: while a pass runs, that of the pass before is
// still to be put into the film, and those of the two passes after it are filled.
SHARED_CONST uint QUEUE_COUNT = 4u;
SHARED_CONST uint QUEUE_ALL = 4u;   // instead of a queue's number: all pixels of the tile
SHARED_CONST uint QUEUE_NONE = 5u;  // the pass fills none, since a decision follows

// Of kernels/adaptive_pass.comp.
SHARED_CONST uint STAGE_FOLD = 0u;     // blocks of the pass before go into the film
SHARED_CONST uint STAGE_INSPECT = 1u;  // which blocks are complete?
SHARED_CONST uint STAGE_ADVANCE = 2u;  // if all are: the queue of a later pass
// Of kernels/adaptive_decide.comp.
SHARED_CONST uint STAGE_ESTIMATE = 3u; // what the pixels' samples say goes into the picture's estimates
SHARED_CONST uint STAGE_DECIDE = 4u;   // by the estimates of pixels and their neighbours: who goes on

// One dispatch over a queue. Push constants.
struct AdaptiveDispatch
{
    uint tileX;          // [pixels] in the full picture
    uint tileY;
    uint tileWidth;
    uint queue;          // 0 to 3, or QUEUE_ALL
    uint queueSize;
    uint nextQueue;      // the one that is filled: 0 to 3, or QUEUE_NONE
    uint stage;          // one of STAGE_*
    uint stepBudget;     // steps of traversal that one invocation may take
    uint pass;           // from 0 on: it renders block `pass` of its pixels. STAGE_DECIDE: the newest
    uint windowLeft;     // of all tiles together [pixels] in the full picture
    uint windowTop;
    uint windowWidth;
    uint windowHeight;
    uint unused0;
    AdaptiveFloors floors;
    AdaptiveRule rule;
};
GPU_STRUCT_SIZE(AdaptiveDispatch, 96);
GPU_FIELD(AdaptiveDispatch, floors, 56);
GPU_FIELD(AdaptiveDispatch, rule, 64);

SHARED_END

#endif
