// What the device hands back, and how work is handed to it.
#ifndef SAHL_FILM_TYPES_H
#define SAHL_FILM_TYPES_H

#include "shared/interop.h"

SHARED_BEGIN

// Samples come in blocks of 8. Block k of a pixel holds its samples 8k .. 8k+7 and belongs to half A
// of the film when k is even, to half B when it is odd.
SHARED_CONST uint BLOCK_SIZE = 8u;

SHARED_CONST uint BLOCK_IDLE = 0u;       // between two samples
SHARED_CONST uint BLOCK_SUSPENDED = 1u;  // a path ran out of steps and waits in `suspended`

SHARED_CONST uint FAULT_LOOP_CUT = 1u;       // a loop ended without its own condition
SHARED_CONST uint FAULT_STACK_OVERFLOW = 2u; // more pending nodes than the stack holds

// One block of one pixel: what the kernel adds up and the host puts into the film.
struct PixelBlock
{
    vec3 sum;            // radiance of the samples, added in sample order [W m^-2 sr^-1]
    float sumY2;         // of the replicates: squared luminance of the samples, or under SAMPLER_SOBOL of
                         // the block's mean times the samples in it
    uint digest;         // sum over all bounces of a hash of what was hit
    uint samplesDone;    // samples in this block so far
    uint status;         // one of BLOCK_*
    uint badSamples;     // samples that were not finite or negative and count as black
    uint indirectRays;   // rays that continue a path after a scattering
    uint shadowRays;
    uint boxTests;
    uint primitiveTests;
    uint bounces;        // surface hits
    uint faults;         // FAULT_* of the last dispatch; such a dispatch changes nothing else
    uint clamped;        // contributions of light that were clamped
    uint unused0;
};
GPU_STRUCT_SIZE(PixelBlock, 64);
GPU_FIELD(PixelBlock, digest, 16);
GPU_FIELD(PixelBlock, faults, 52);

// What the camera rays of a pixel met first: sums over the samples that hit something, for the pictures
// that go along with the light (albedo, normals, depth, position).
struct FirstHits
{
    vec3 albedo;
    float depth;     // distance along the ray [m]
    vec3 ns;         // shading normal, on the viewer's side
    uint hits;       // samples that hit something
    vec3 ng;         // geometric normal, on the viewer's side
    uint number;     // primitive that the first sample hit, or NO_HIT
    vec3 position;   // world space [m]
    uint material;   // of that primitive, or NO_HIT
};
GPU_STRUCT_SIZE(FirstHits, 64);
GPU_FIELD(FirstHits, hits, 28);

SHARED_CONST uint MAX_SUSPENDED_STACK = 64u; // = MAX_STACK_SIZE of scene_types.h

SHARED_CONST uint PHASE_EXTEND = 0u;  // the path's ray looks for the closest hit
SHARED_CONST uint PHASE_SHADOW = 1u;  // its shadow ray looks for any hit
SHARED_CONST uint PHASE_LAST_SHADOW = 2u;  // the same, and the path ends after it
SHARED_CONST uint PHASE_ENDED = 3u;
SHARED_CONST uint PHASE_LIGHT = 4u;  // INTEGRATOR_PHONG: no ray; the next light's turn at what was hit

// A walk through the tree that can stop between two nodes and go on later.
struct Traversal
{
    uint ref;          // what to visit next
    uint stackSize;    // entries on the stack
    uint slot;         // closest hit so far: index in `primitives`, or NO_HIT
    uint number;       // of its primitive in the scene
    float tHit;        // its distance [m]; the ray's end while nothing is hit
    float b1;          // its barycentric coordinates
    float b2;
    uint inside;       // instance that the walk is in, or NO_INSTANCE: in the world
    uint instance;     // that the closest hit is in, or NO_INSTANCE
    uint group;        // STACK_IN_REGISTERS: what is next on the stack (pathtrace/stack.glsl)
    uint unused0;
    uint unused1;
};
GPU_STRUCT_SIZE(Traversal, 48);

// A path between two steps.
struct PathState
{
    vec3 org;          // ray that continues the path: origin [m]
    uint phase;        // one of PHASE_*
    vec3 dir;          // unit
    uint depth;        // scatterings so far; INTEGRATOR_PHONG: lights so far
    vec3 beta;         // throughput
    uint pixel;        // y * width + x in the full picture
    vec3 L;            // radiance gathered so far [W m^-2 sr^-1]
    uint sampleIndex;  // within the pixel
    vec3 shadowOrg;    // shadow ray
    float shadowTMax;  // distance to the light [m]
    vec3 shadowDir;    // unit
    uint digest;
    vec3 Ld;           // what the light adds when the shadow ray arrives
    float mediumEta;   // index of refraction where the path is, by the report's rule
    float pdf;         // density with which dir was chosen at the last vertex [1/sr]; 0: not by density
    float etaScale;    // square of the index of refraction that beta's radiance is scaled by
    float probeChance; // that the last vertex looked for the probe, and not for a light
    float tableChance; // that it looked for one of the lights of the alias table
    Traversal hit;     // INTEGRATOR_PHONG: what the camera ray met, while shadow rays walk
};
GPU_STRUCT_SIZE(PathState, 176);
GPU_FIELD(PathState, Ld, 96);
GPU_FIELD(PathState, pdf, 112);
GPU_FIELD(PathState, hit, 128);

struct SuspendedPath
{
    PathState path;
    Traversal traversal;
    uint indirectRays;   // counted for this sample so far
    uint shadowRays;
    uint boxTests;
    uint primitiveTests;
    uint bounces;
    uint clamped;
    uint unused0;
    uint unused1;
    uint stack[MAX_SUSPENDED_STACK];
};
GPU_STRUCT_SIZE(SuspendedPath, 256 + 4 * 64);
GPU_FIELD(SuspendedPath, stack, 256);

// One dispatch: some samples more for every pixel of a tile. Push constants.
struct Dispatch
{
    uint tileX;        // [pixels] in the full picture
    uint tileY;
    uint tileWidth;
    uint tileHeight;
    uint firstSample;  // of the block, a multiple of BLOCK_SIZE
    uint sampleCount;  // of the block, 1 to BLOCK_SIZE
    uint stepBudget;   // steps of traversal that one invocation may take
    uint samplesAtOnce;  // that the dispatch may add to a pixel
};
GPU_STRUCT_SIZE(Dispatch, 32);

SHARED_END

#endif
