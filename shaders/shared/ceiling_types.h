// What kernels/ceiling.comp is told.
#ifndef SAHL_CEILING_TYPES_H
#define SAHL_CEILING_TYPES_H

#include "shared/interop.h"

SHARED_BEGIN

SHARED_CONST uint CEILING_GROUP = 64u;    // invocations of a workgroup
SHARED_CONST uint CEILING_UNROLLED = 8u;  // steps of a round
SHARED_CONST uint CEILING_OPERATIONS = 128u;  // of an invocation in a round: 8 chains, 8 steps, * and +

struct CeilingJob
{
    uint invocations;
    uint elements;  // of the buffers [16 bytes]; a multiple of `invocations`
    uint rounds;    // of arithmetic
    float factor;   // below 1
    float summand;
};
GPU_STRUCT_SIZE(CeilingJob, 20);
GPU_FIELD(CeilingJob, factor, 12);

SHARED_END

#endif
