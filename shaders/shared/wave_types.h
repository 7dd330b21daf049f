// Paths in waves: what a kernel leaves in memory for the next one.
//
// The samples of a tile are numbered, all of a pixel in a row. A sample under way has one of a fixed number of places,
// its slot. A wave takes every path under way one ray further: wave_plan decides how many samples begin, wave_begin gives
// them their camera rays, wave_trace walks the rays, wave_shade does what happens where they end and puts those that go
// on into the queue of the next wave (docs/variants.md).
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
SHARED_CONST uint ENTRY_ANY_HIT = 0x10000000u;  // no shadow ray's, but ends at any hit all the same
SHARED_CONST uint MAX_WAVE_SLOTS = 0x00ffffffu;

// Head of the buffer of queues. After it: two queues, of this wave and of the next in turns, then the slots that are
// free again; each has room for all slots.
struct WaveCounts
{
    uvec4 groups;       // workgroups of this wave, as vkCmdDispatchIndirect reads their first three words
    uvec4 beginGroups;  // of wave_begin
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
};
GPU_STRUCT_SIZE(WaveCounts, 80);
GPU_FIELD(WaveCounts, nextCount, 52);

// Rows of 16 bytes: what there is of a slot, and of a sample of the tile. kernels/wave_paths.glsl says what they hold.
SHARED_CONST uint WAVE_PATH_ROWS = 4u;
SHARED_CONST uint WAVE_RAY_ROWS = 4u;
SHARED_CONST uint WAVE_HIT_ROWS = 2u;
SHARED_CONST uint WAVE_SAMPLE_ROWS = 3u;

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
