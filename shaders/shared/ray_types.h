// Rays that the host gives to be traced, for measurements and tests, and what they meet.
#ifndef SAHL_RAY_TYPES_H
#define SAHL_RAY_TYPES_H

#include "shared/film_types.h"

SHARED_BEGIN

struct TraceRay
{
    vec3 org;     // world space [m]
    float tMax;   // end of the ray [m]
    vec3 dir;     // unit
    uint unused0;
};
GPU_STRUCT_SIZE(TraceRay, 32);

SHARED_CONST uint TRACE_IDLE = 0u;       // not traced yet
SHARED_CONST uint TRACE_SUSPENDED = 1u;  // ran out of steps and waits in `walks`
SHARED_CONST uint TRACE_DONE = 2u;

// The closest hit of a ray, or some hit where any would do; and the work that it took.
struct TraceHit
{
    uint number;          // of the primitive in the scene, or NO_HIT
    float tHit;           // distance [m]; the ray's end where nothing is hit
    float b1;             // barycentric coordinates
    float b2;
    uint boxTests;
    uint primitiveTests;
    uint status;          // one of TRACE_*
    uint faults;          // FAULT_* of the last dispatch; such a dispatch changes nothing else
};
GPU_STRUCT_SIZE(TraceHit, 32);
GPU_FIELD(TraceHit, boxTests, 16);

struct SuspendedWalk
{
    Traversal traversal;
    uint boxTests;        // counted for this ray so far
    uint primitiveTests;
    uint unused0;
    uint unused1;
    uint stack[MAX_SUSPENDED_STACK];
};
GPU_STRUCT_SIZE(SuspendedWalk, 64 + 4 * 64);

// One dispatch: every ray that is not done yet is taken further. Push constants.
struct TraceDispatch
{
    uint rayCount;
    uint anyHit;      // 1: the first hit found will do
    uint stepBudget;  // steps of traversal that one invocation may take
    uint begin;       // 1: all rays start anew
};
GPU_STRUCT_SIZE(TraceDispatch, 16);

SHARED_END

#endif
