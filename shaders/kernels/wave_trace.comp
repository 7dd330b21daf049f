// Walks the rays of a wave, one an invocation. Where a fault was seen (a loop cut short by the driver) the walk is as it
// was before.
//
// With RESUMES a walk that runs out of steps is saved and goes on in the next wave. Without, it begins again there,
// in a kernel that saves it: some drivers run every branch, and few walks are ever that long.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "kernels/device.glsl"

#define WAVE_QUEUES_BINDING BINDING_WAVE_QUEUES
#include "kernels/wave.glsl"
#include "pathtrace/pathtrace.glsl"
#include "kernels/wave_samples.glsl"
#include "kernels/wave_paths.glsl"
#include "kernels/wave_hits.glsl"

layout(std430, set = 0, binding = BINDING_WAVE_WALKS) buffer WaveWalksBlock
{
    WaveWalk walks[];
};
layout(std430, set = 0, binding = BINDING_WAVE_STACKS) buffer WaveStacksBlock
{
    uint stacks[];
};

void suspendWalk(uint slot, Traversal walk)
{
    walks[slot].traversal = walk;
    walks[slot].boxTests = tally.boxTests;
    walks[slot].primitiveTests = tally.primitiveTests;
    uint i = 0u;
    for (; i < walk.stackSize; i++) stacks[slot * STACK_SIZE + i] = stackEntry(i);
    if (i != walk.stackSize) faults |= FAULT_LOOP_CUT;
}

Traversal resumedWalk(uint slot)
{
    Traversal walk = walks[slot].traversal;
    tally.boxTests = walks[slot].boxTests;
    tally.primitiveTests = walks[slot].primitiveTests;
    uint i = 0u;
    for (; i < walk.stackSize; i++) setStackEntry(i, stacks[slot * STACK_SIZE + i]);
    if (i != walk.stackSize) faults |= FAULT_LOOP_CUT;
    return walk;
}

void main()
{
    uint index = waveInvocation();
    if (index >= counts.entryCount) return;
    uint at = queueAt(counts.queue) + index;
    uint entry = entries[at];
    if ((entry & ENTRY_OVER) != 0u) return;

    uint slot = entry & ENTRY_SLOT;
    bool shadow = HAS_SHADOW_RAYS && (entry & ENTRY_SHADOW) != 0u;
    uint ray = slot * WAVE_RAY_ROWS + (shadow ? 2u : 0u);
    uvec4 row = rays[ray];
    vec3 org = vectorIn(row);
    vec3 dir = vectorIn(rays[ray + 1u]);
    float tMax = shadow ? uintBitsToFloat(row.w) : RAY_INFINITY;

    stepsLeft = job.stepBudget;
    faults = 0u;
    tally = Tally(0u, 0u, 0u, 0u, 0u, 0u);
    Traversal walk = beginTraversal(tMax);
    if (RESUMES && (entry & ENTRY_BEGUN) != 0u) walk = resumedWalk(slot);
    bool over = traverse(org, dir, shadow || (entry & ENTRY_ANY_HIT) != 0u, walk);
    if (!over && faults == 0u) {
        atomicAdd(counts.outOfSteps, 1u);
        if (RESUMES) {
            suspendWalk(slot, walk);
            // Half saved is as good as lost: the walk begins again.
            entries[at] = faults == 0u ? entry | ENTRY_BEGUN : entry & ~ENTRY_BEGUN;
        }
    }
    if (faults != 0u) {
        atomicOr(counts.faults, faults);
        return;
    }
    if (!over) return;
    storeHit(slot, shadow, walk);
    entry = (entry & ~ENTRY_BEGUN) | ENTRY_OVER;
    if (shadow && walk.slot != NO_HIT) entry |= ENTRY_BLOCKED;
    entries[at] = entry;
}
