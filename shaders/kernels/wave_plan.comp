// Before every wave, one invocation: what the wave before has put into the queue becomes the queue of this one, and as many
// samples begin as there are free slots. Nothing of that goes by way of the host.
#version 460
#extension GL_GOOGLE_include_directive : require

#define WAVE_QUEUES_BINDING 0
#include "kernels/wave.glsl"

void main()
{
    if (waveInvocation() != 0u) return;
    uint goOn = counts.nextCount;
    uint fresh = min(job.slotCount - goOn, job.pixelCount * job.sampleCount - counts.begunCount);
    // The first samples of a tile have the slots of their own numbers.
    uint taken = counts.begunCount == 0u ? 0u : fresh;
    uint groupSize = gl_WorkGroupSize.x * gl_WorkGroupSize.y;
    counts.groups = uvec4((goOn + fresh + groupSize - 1u) / groupSize, 1u, 1u, 0u);
    counts.beginGroups = uvec4((fresh + groupSize - 1u) / groupSize, 1u, 1u, 0u);
    counts.entryCount = goOn + fresh;
    counts.freshCount = fresh;
    counts.begunCount += fresh;
    counts.queue = 1u - counts.queue;
    counts.freeCount -= taken;
    counts.firstFree = counts.freeCount;
    counts.nextCount = 0u;
    if (counts.outOfSteps != 0u) counts.resumedWaves++;
    counts.outOfSteps = 0u;
    if (goOn + fresh != 0u) counts.waves++;
}
