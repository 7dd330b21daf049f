// Walks the rays of a wave, one an invocation, and lets its new samples begin. A walk that runs out of steps is saved and
// goes on in the next wave. Where a fault was seen (a loop cut short by the driver) the walk is as it was before.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "kernels/device.glsl"

#define WAVE_QUEUES_BINDING BINDING_WAVE_QUEUES
#include "kernels/wave.glsl"
#include "pathtrace/pathtrace.glsl"
#include "kernels/wave_paths.glsl"

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
    for (; i < walk.stackSize; i++) stacks[slot * STACK_SIZE + i] = stack[i];
    if (i != walk.stackSize) faults |= FAULT_LOOP_CUT;
}

Traversal resumedWalk(uint slot)
{
    Traversal walk = walks[slot].traversal;
    tally.boxTests = walks[slot].boxTests;
    tally.primitiveTests = walks[slot].primitiveTests;
    uint i = 0u;
    for (; i < walk.stackSize; i++) stack[i] = stacks[slot * STACK_SIZE + i];
    if (i != walk.stackSize) faults |= FAULT_LOOP_CUT;
    return walk;
}

/// Begins a sample of the tile; returns its entry. All samples of a pixel stand side by side, for their rays are much alike.
uint beginSample(uint number)
{
    uint slot = number;
    if (number >= job.slotCount) {
        uint before = counts.begunCount - counts.freshCount;
        slot = entries[freeSlotsAt() + counts.firstFree + (number - before)];
    }
    uint pixel = number / job.sampleCount;
    uint sampleIndex = job.firstSample + number % job.sampleCount;
    PathState path = beginPath(job.tileX + pixel % job.tileWidth, job.tileY + pixel / job.tileWidth, sampleIndex);
    rays[2u * slot].org = path.org;
    rays[2u * slot].dir = path.dir;
    paths[slot] = WavePath(path.beta, path.depth, path.phase, path.pixel, sampleIndex, number, path.Ld, path.pdf,
                           path.mediumEta, path.etaScale, path.probeChance, path.tableChance);
    samples[number] = WaveSample(path.L, path.digest, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u);
    return slot;
}

void main()
{
    uint index = waveInvocation();
    if (index >= counts.entryCount) return;
    uint at = queueAt(counts.queue) + index;
    uint goOn = counts.entryCount - counts.freshCount;
    uint entry;
    if (index < goOn) {
        entry = entries[at];
    } else {
        entry = beginSample(counts.begunCount - counts.entryCount + index);
        entries[at] = entry;
    }
    if ((entry & ENTRY_OVER) != 0u) return;

    uint slot = entry & ENTRY_SLOT;
    bool shadow = HAS_SHADOW_RAYS && (entry & ENTRY_SHADOW) != 0u;
    uint ray = 2u * slot + (shadow ? 1u : 0u);
    vec3 org = rays[ray].org;
    vec3 dir = rays[ray].dir;
    float tMax = RAY_INFINITY;
    if (shadow) tMax = rays[ray].tMax;

    stepsLeft = job.stepBudget;
    faults = 0u;
    tally = Tally(0u, 0u, 0u, 0u, 0u, 0u);
    Traversal walk = beginTraversal(tMax);
    if ((entry & ENTRY_BEGUN) != 0u) walk = resumedWalk(slot);
    bool over = traverse(org, dir, shadow, walk);
    if (!over && faults == 0u) {
        suspendWalk(slot, walk);
        atomicAdd(counts.outOfSteps, 1u);
        // Half saved is as good as lost: the walk begins again.
        entries[at] = faults == 0u ? entry | ENTRY_BEGUN : entry & ~ENTRY_BEGUN;
    }
    if (faults != 0u) {
        atomicOr(counts.faults, faults);
        return;
    }
    if (!over) return;
    uint place = paths[slot].place;
    samples[place].boxTests += tally.boxTests;
    samples[place].primitiveTests += tally.primitiveTests;
    entry = (entry & ~ENTRY_BEGUN) | ENTRY_OVER;
    if (shadow) {
        if (walk.slot != NO_HIT) entry |= ENTRY_BLOCKED;
    } else {
        hits[slot] = WaveHit(walk.slot, walk.number, walk.tHit, walk.b1, walk.b2, walk.instance, 0u, 0u);
    }
    entries[at] = entry;
}
