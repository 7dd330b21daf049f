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
#include "kernels/wave_samples.glsl"
#include "kernels/wave_paths.glsl"
#include "kernels/wave_hits.glsl"
#include "kernels/wave_push.glsl"

/// The step of a path after a walk; returns its entry in the next wave, if it goes on.
uint shadeEntry(uint entry, out bool ends)
{
    ends = false;
    uint slot = entry & ENTRY_SLOT;
    faults = 0u;
    stepsLeft = job.stepBudget;
    uint place;
    PathState path = loadPath(slot, place);
    loadSample(place, path);
    Traversal hit = loadHit(slot, !HAS_PHONG || path.phase != PHASE_LIGHT);
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
    storeSample(place, path);
    ends = path.phase == PHASE_ENDED;
    if (!ends) {
        storeRay(slot, path.org, path.dir);
        storePath(slot, place, path);
        if (HAS_SHADOW_RAYS && inShadowPhase(path)) storeShadowRay(slot, path);
    }
    if (HAS_PHONG && path.phase == PHASE_LIGHT) return slot | ENTRY_OVER;
    if (seesTheEnvironmentOrNothing(path)) return slot | ENTRY_ANY_HIT;
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
