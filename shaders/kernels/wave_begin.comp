// Lets the new samples of a wave begin, one an invocation: each gets a slot, a path and a camera ray.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "kernels/device.glsl"

#define WAVE_QUEUES_BINDING BINDING_WAVE_QUEUES
#include "kernels/wave.glsl"
#include "pathtrace/pathtrace.glsl"
#include "kernels/wave_samples.glsl"
#include "kernels/wave_paths.glsl"

void main()
{
    uint index = waveInvocation();
    if (index >= counts.freshCount) return;
    uint number = counts.begunCount - counts.freshCount + index;
    uint slot = number;
    if (number >= job.slotCount) slot = entries[freeSlotsAt() + counts.firstFree + index];
    // All samples of a pixel stand side by side: their rays are much alike.
    uint pixel = number / job.sampleCount;
    uint sampleIndex = job.firstSample + number % job.sampleCount;
    PathState path = beginPath(job.tileX + pixel % job.tileWidth, job.tileY + pixel / job.tileWidth, sampleIndex);
    tally = Tally(0u, 0u, 0u, 0u, 0u, 0u);
    storeRay(slot, path.org, path.dir);
    storeNewPath(slot, number, path);
    storeSample(number, path);
    entries[queueAt(counts.queue) + counts.entryCount - counts.freshCount + index] = slot;
}
