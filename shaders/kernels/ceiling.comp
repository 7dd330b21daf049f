// What a device can do at most: reads from a buffer much larger than its caches, copies from one such buffer to
// another, or multiplies and adds in registers. One of SAHL_READ, SAHL_COPY, SAHL_ARITHMETIC is defined.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/ceiling_types.h"

layout(local_size_x = CEILING_GROUP) in;
layout(std430, set = 0, binding = 0) readonly buffer SourceBlock
{
    uvec4 source[];
};
layout(std430, set = 0, binding = 1) writeonly buffer TargetBlock
{
    uvec4 results[];
};
layout(push_constant) uniform JobBlock
{
    CeilingJob job;
};

void main()
{
    uint i = gl_GlobalInvocationID.x;
#if defined(SAHL_READ)
    // Neighbours read neighbours. All is used, so that no read can be left out.
    uvec4 all = uvec4(0u);
    for (uint at = i; at < job.elements; at += job.invocations) all ^= source[at];
    results[i] = all;
#elif defined(SAHL_COPY)
    for (uint at = i; at < job.elements; at += job.invocations) results[at] = source[at];
#else
    // Eight chains hide how long one operation takes; they meet a fixed point, so that nothing overflows.
    float x0 = float(i & 255u), x1 = x0 + 1.0f, x2 = x0 + 2.0f, x3 = x0 + 3.0f;
    float x4 = x0 + 4.0f, x5 = x0 + 5.0f, x6 = x0 + 6.0f, x7 = x0 + 7.0f;
    for (uint round = 0u; round < job.rounds; round++)
    {
        for (uint k = 0u; k < CEILING_UNROLLED; k++)
        {
            x0 = x0 * job.factor + job.summand;
            x1 = x1 * job.factor + job.summand;
            x2 = x2 * job.factor + job.summand;
            x3 = x3 * job.factor + job.summand;
            x4 = x4 * job.factor + job.summand;
            x5 = x5 * job.factor + job.summand;
            x6 = x6 * job.factor + job.summand;
            x7 = x7 * job.factor + job.summand;
        }
    }
    results[i] = floatBitsToUint(vec4(x0 + x4, x1 + x5, x2 + x6, x3 + x7));
#endif
}
