// Paths in waves: what a kernel leaves in memory for the next one.
//
// The samples of a tile are numbered, all of a pixel in a row. A sample under way has one of a fixed number of places,
// its slot. A wave takes every path under way one ray further: wave_plan decides how many samples begin, wave_trace
// walks the rays, wave_shade does what happens where they end and puts those that go on into the queue of the next wave.
#ifndef SAHL_WAVE_TYPES_H
#define SAHL_WAVE_TYPES_H

#include "shared/film_types.h"

SHARED_BEGIN

// An entry of a queue: a slot, whose ray it is, and how far the walk is.
SHARED_CONST uint ENTRY_SLOT = 0x00ffffffu;
SHARED_CONST uint ENTRY_SHADOW = 0x01000000u;   // the walk is the shadow ray's
SHARED_CONST uint ENTRY_BLOCKED = 0x02000000u;  // which has met something
SHARED_CONST uint ENTRY_BEGUN = 0x04000000u;    // the walk ran out of steps and waits in `walks`
SHARED_CONST uint ENTRY_OVER = 0x08000000u;     // the walk is over: it is wave_shade's turn
SHARED_CONST uint MAX_WAVE_SLOTS = 0x00ffffffu;

// Head of the buffer of queues. After it: two queues, of this wave and of the next in turns, then the slots that are
// free again; each has room for all slots.
struct WaveCounts
{
    uint groups;        // workgroups of this wave: with the next two as vkCmdDispatchIndirect reads them
    uint one0;
    uint one1;
    uint entryCount;    // paths in this wave
    uint freshCount;    // of these, that begin; they stand behind the others
    uint begunCount;    // samples of the tile that have begun, those included
    uint queue;         // of this wave: 0 or 1
    uint firstFree;     // place of the first free slot for those that begin
    uint nextCount;     // entries in the queue of the next wave so far
    uint freeCount;     // slots that are free again
    uint faults;        // FAULT_* of all waves since the host cleared it
    uint outOfSteps;    // walks of this wave that were saved
    uint resumedWaves;  // waves with such walks, since the tile began
    uint waves;         // with paths in them, since the tile began
    uint unused0;
    uint unused1;
};
GPU_STRUCT_SIZE(WaveCounts, 64);
GPU_FIELD(WaveCounts, nextCount, 32);

// A path between two kernels; its rays, its hit and what it has gathered are apart.
struct WavePath
{
    vec3 beta;          // as in PathState, down to tableChance
    uint depth;
    uint phase;
    uint pixel;
    uint sampleIndex;
    uint place;         // of the sample in `samples`
    vec3 Ld;
    float pdf;
    float mediumEta;
    float etaScale;
    float probeChance;
    float tableChance;
};
GPU_STRUCT_SIZE(WavePath, 64);
GPU_FIELD(WavePath, Ld, 32);

// A ray of a path: two a slot, first the one that continues it, then its shadow ray.
struct WaveRay
{
    vec3 org;     // [m]
    float tMax;   // of shadow rays [m]
    vec3 dir;     // unit
    uint unused0;
};
GPU_STRUCT_SIZE(WaveRay, 32);

// What the ray that continues a path has met: fields of Traversal.
struct WaveHit
{
    uint slot;
    uint number;
    float tHit;
    float b1;
    float b2;
    uint instance;
    uint unused0;
    uint unused1;
};
GPU_STRUCT_SIZE(WaveHit, 32);

// A sample: light and work so far.
struct WaveSample
{
    vec3 L;
    uint digest;
    uint indirectRays;
    uint shadowRays;
    uint boxTests;
    uint primitiveTests;
    uint bounces;
    uint clamped;
    uint unused0;
    uint unused1;
};
GPU_STRUCT_SIZE(WaveSample, 48);

// A walk that ran out of steps. Its stack lies apart, as large as the kernel's.
struct WaveWalk
{
    Traversal traversal;
    uint boxTests;  // counted for this ray so far
    uint primitiveTests;
    uint unused0;
    uint unused1;
};
GPU_STRUCT_SIZE(WaveWalk, 64);

// Push constants of all these kernels.
struct WaveDispatch
{
    uint tileX;        // [pixels] in the full picture
    uint tileY;
    uint tileWidth;
    uint pixelCount;   // of the tile
    uint firstSample;  // of the block, a multiple of BLOCK_SIZE
    uint sampleCount;  // of the block, 1 to BLOCK_SIZE
    uint stepBudget;   // steps that a walk may take in a wave
    uint slotCount;
};
GPU_STRUCT_SIZE(WaveDispatch, 32);

SHARED_END

#endif
