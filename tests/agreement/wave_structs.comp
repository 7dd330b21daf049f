// Reads every field of the structs of waves and writes it back as one word, in order of declaration.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shared/wave_types.h"

layout(local_size_x = 1) in;
layout(std430, binding = 0) readonly buffer Counts { WaveCounts counts[]; };
layout(std430, binding = 1) readonly buffer Walks { WaveWalk walks[]; };
layout(std430, binding = 2) writeonly buffer Words { uint words[]; };
layout(push_constant) uniform JobBlock { WaveDispatch job; };

uint count = 0u;

void put(uint value) { words[count++] = value; }
void put(float value) { put(floatBitsToUint(value)); }
void put(uvec4 value) { put(value.x); put(value.y); put(value.z); put(value.w); }

void main()
{
    // The second element of each array: the stride counts as well.
    WaveCounts c = counts[1];
    put(c.groups); put(c.beginGroups);
    put(c.entryCount); put(c.freshCount); put(c.begunCount); put(c.queue); put(c.firstFree); put(c.nextCount);
    put(c.freeCount); put(c.faults); put(c.outOfSteps); put(c.resumedWaves); put(c.waves); put(c.unused0);
    Traversal w = walks[1].traversal;
    put(w.ref); put(w.stackSize); put(w.slot); put(w.number); put(w.tHit); put(w.b1); put(w.b2);
    put(w.inside); put(w.instance); put(w.group); put(w.unused0); put(w.unused1);
    put(walks[1].boxTests); put(walks[1].primitiveTests); put(walks[1].unused0); put(walks[1].unused1);
    put(job.tileX); put(job.tileY); put(job.tileWidth); put(job.pixelCount);
    put(job.firstSample); put(job.sampleCount); put(job.stepBudget); put(job.slotCount);
}
