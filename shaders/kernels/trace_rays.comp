// Rays given by the host, one an invocation: traversal alone, for measurements and tests.
// Suspension and faults are as in path.comp.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "kernels/device.glsl"
#include "shared/ray_types.h"

layout(local_size_x_id = SPEC_GROUP_WIDTH, local_size_y_id = SPEC_GROUP_HEIGHT) in;

SCENE_BUFFER(BINDING_RAYS, rayWords);
layout(std430, set = 0, binding = BINDING_RAY_HITS) buffer HitsBlock
{
    TraceHit hits[];
};
layout(std430, set = 0, binding = BINDING_RAY_WALKS) buffer WalksBlock
{
    SuspendedWalk walks[];
};
layout(push_constant) uniform DispatchBlock
{
    TraceDispatch jobs[1];
};
#define job jobs[UNIFORMS_AT]

#include "pathtrace/pathtrace.glsl"

void suspendWalk(uint index, Traversal walk)
{
    walks[index].traversal = walk;
    walks[index].boxTests = tally.boxTests;
    walks[index].primitiveTests = tally.primitiveTests;
    uint i = 0u;
    for (; i < walk.stackSize; i++) walks[index].stack[i] = stackEntry(i);
    if (i != walk.stackSize) faults |= FAULT_LOOP_CUT;
}

Traversal resumedWalk(uint index)
{
    Traversal walk = walks[index].traversal;
    tally.boxTests = walks[index].boxTests;
    tally.primitiveTests = walks[index].primitiveTests;
    uint i = 0u;
    for (; i < walk.stackSize; i++) setStackEntry(i, walks[index].stack[i]);
    if (i != walk.stackSize) faults |= FAULT_LOOP_CUT;
    return walk;
}

TraceRay loadRay(uint index)
{
    uvec4 a = FETCH(rayWords, index * 2u);
    uvec4 b = FETCH(rayWords, index * 2u + 1u);
    return TraceRay(uintBitsToFloat(a.xyz), uintBitsToFloat(a.w), uintBitsToFloat(b.xyz), b.w);
}

void main()
{
    uint index = gl_WorkGroupID.x * (gl_WorkGroupSize.x * gl_WorkGroupSize.y) + gl_LocalInvocationIndex;
    if (index >= job.rayCount) return;
    uint status = job.begin != 0u ? TRACE_IDLE : hits[index].status;
    if (status == TRACE_DONE) return;

    stepsLeft = job.stepBudget;
    faults = 0u;
    tally = Tally(0u, 0u, 0u, 0u, 0u, 0u);
    TraceRay ray = loadRay(index);
    Traversal walk;
    if (RESUMES && status == TRACE_SUSPENDED) {
        walk = resumedWalk(index);
    } else {
        walk = beginTraversal(ray.tMax);
    }
    bool over = traverse(ray.org, ray.dir, job.anyHit != 0u, walk);
    if (RESUMES && !over && faults == 0u) {
        suspendWalk(index, walk);
        status = faults == 0u ? TRACE_SUSPENDED : TRACE_IDLE;  // half saved is as good as lost
    }
    if (faults != 0u) {
        hits[index].status = status;
        hits[index].faults = faults;
        return;
    }
    hits[index] = TraceHit(walk.number, walk.tHit, walk.b1, walk.b2, tally.boxTests, tally.primitiveTests,
                           over ? TRACE_DONE : RESUMES ? TRACE_SUSPENDED : TRACE_IDLE, 0u);
}
