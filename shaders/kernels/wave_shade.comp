// What happens where the rays of a wave ended: every path whose walk is over takes the step that follows it, and goes on in
// the next wave or leaves its slot. Where a fault was seen the path is as it was before, and has its turn again.
#version 460
#extension GL_GOOGLE_include_directive : require
#ifndef SAHL_SHARED_QUEUES
#extension GL_KHR_shader_subgroup_ballot : require
#endif

#include "kernels/device.glsl"

#define WAVE_QUEUES_BINDING BINDING_WAVE_QUEUES
#include "kernels/wave.glsl"
#include "pathtrace/pathtrace.glsl"
#include "kernels/wave_paths.glsl"
#include "kernels/wave_push.glsl"

/// What a finished walk has found.
Traversal loadHit(uint slot)
{
    WaveHit hit = hits[slot];
    Traversal walk = beginTraversal(hit.tHit);
    walk.slot = hit.slot;
    walk.number = hit.number;
    walk.b1 = hit.b1;
    walk.b2 = hit.b2;
    walk.instance = hit.instance;
    return walk;
}

PathState loadPath(uint slot)
{
    PathState path;
    path.org = rays[2u * slot].org;
    path.dir = rays[2u * slot].dir;
    path.beta = paths[slot].beta;
    path.depth = paths[slot].depth;
    path.phase = paths[slot].phase;
    path.pixel = paths[slot].pixel;
    path.sampleIndex = paths[slot].sampleIndex;
    path.mediumEta = paths[slot].mediumEta;
    path.etaScale = paths[slot].etaScale;
    path.Ld = vec3(0.0f);
    path.pdf = 0.0f;
    path.probeChance = 0.0f;
    path.tableChance = 0.0f;
    path.shadowOrg = vec3(0.0f);
    path.shadowTMax = 0.0f;
    path.shadowDir = vec3(0.0f);
    if (HAS_SHADOW_RAYS) {
        path.Ld = paths[slot].Ld;
        path.pdf = paths[slot].pdf;
        path.probeChance = paths[slot].probeChance;
        path.tableChance = paths[slot].tableChance;
    }
    uint place = paths[slot].place;
    path.L = samples[place].L;
    path.digest = samples[place].digest;
    tally.indirectRays = samples[place].indirectRays;
    tally.shadowRays = samples[place].shadowRays;
    tally.bounces = samples[place].bounces;
    tally.clamped = samples[place].clamped;
    return path;
}

void storePath(uint slot, PathState path)
{
    uint place = paths[slot].place;
    samples[place].L = path.L;
    samples[place].digest = path.digest;
    samples[place].indirectRays = tally.indirectRays;
    samples[place].shadowRays = tally.shadowRays;
    samples[place].bounces = tally.bounces;
    samples[place].clamped = tally.clamped;
    if (path.phase == PHASE_ENDED) return;
    rays[2u * slot].org = path.org;
    rays[2u * slot].dir = path.dir;
    paths[slot].beta = path.beta;
    paths[slot].depth = path.depth;
    paths[slot].phase = path.phase;
    paths[slot].mediumEta = path.mediumEta;
    paths[slot].etaScale = path.etaScale;
    if (HAS_SHADOW_RAYS) {
        paths[slot].pdf = path.pdf;
        paths[slot].probeChance = path.probeChance;
        paths[slot].tableChance = path.tableChance;
        if (inShadowPhase(path)) {
            paths[slot].Ld = path.Ld;
            rays[2u * slot + 1u].org = path.shadowOrg;
            rays[2u * slot + 1u].dir = path.shadowDir;
            rays[2u * slot + 1u].tMax = path.shadowTMax;
        }
    }
}

/// The step of a path after a walk; returns its entry in the next wave, if it goes on.
uint shadeEntry(uint entry, out bool ends)
{
    ends = false;
    uint slot = entry & ENTRY_SLOT;
    faults = 0u;
    stepsLeft = job.stepBudget;
    tally = Tally(0u, 0u, 0u, 0u, 0u, 0u);
    PathState path = loadPath(slot);
    Traversal hit = loadHit(slot);
    path.hit = hit;
    if (HAS_SHADOW_RAYS && (entry & ENTRY_SHADOW) != 0u) {
        hit.slot = (entry & ENTRY_BLOCKED) != 0u ? 0u : NO_HIT;
        finishShadow(hit, path);
    } else {
        shadePath(hit, path);
    }
    if (faults != 0u) {
        atomicOr(counts.faults, faults);
        return entry;
    }
    storePath(slot, path);
    ends = path.phase == PHASE_ENDED;
    if (HAS_PHONG && path.phase == PHASE_LIGHT) return slot | ENTRY_OVER;
    return inShadowPhase(path) ? slot | ENTRY_SHADOW : slot;
}

void main()
{
    uint index = waveInvocation();
    bool isThere = index < counts.entryCount;
    uint entry = 0u;
    bool ends = false;
    if (isThere) {
        entry = entries[queueAt(counts.queue) + index];
        if ((entry & ENTRY_OVER) != 0u) entry = shadeEntry(entry, ends);
    }
    pushAll(isThere && !ends, entry, ends, entry & ENTRY_SLOT);
}
