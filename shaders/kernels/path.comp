// The megakernel: every invocation owns one pixel of the tile and takes it up to one sample further.
// With SAHL_FIRST_HITS a sample ends at what the camera ray meets, and goes into `firstHits`.
//
// A path that runs out of steps is saved and goes on in the next dispatch. An invocation in which a
// fault was seen (a loop cut short by the driver) changes nothing but the pixel's `faults`, so that
// the host can simply dispatch again with fewer steps.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "kernels/device.glsl"

layout(local_size_x_id = SPEC_GROUP_WIDTH, local_size_y_id = SPEC_GROUP_HEIGHT) in;

layout(std430, set = 0, binding = BINDING_PIXELS) buffer PixelsBlock
{
    PixelBlock pixels[];
};
#ifdef SAHL_FIRST_HITS
layout(std430, set = 0, binding = BINDING_FIRST_HITS) buffer FirstHitsBlock
{
    FirstHits firstHits[];
};
#endif
layout(push_constant) uniform DispatchBlock
{
    Dispatch job;
};

#include "pathtrace/pathtrace.glsl"
#include "kernels/suspend.glsl"

void main()
{
    uvec2 at = gl_GlobalInvocationID.xy;
    if (at.x >= job.tileWidth || at.y >= job.tileHeight) return;
    uint index = at.y * job.tileWidth + at.x;
    PixelBlock block = pixels[index];
    if (block.samplesDone >= job.sampleCount) return;

    stepsLeft = job.stepBudget;
    faults = 0u;
    tally = Tally(0u, 0u, 0u, 0u, 0u, 0u);
    PathState path;
    Traversal walk;
    if (block.status == BLOCK_SUSPENDED) {
        resumePath(index, path, walk);
    } else {
        path = beginPath(job.tileX + at.x, job.tileY + at.y, job.firstSample + block.samplesDone);
        walk = beginPathTraversal(path);
    }
#ifdef SAHL_FIRST_HITS
    advanceFirstHit(path, walk);
#else
    advancePath(path, walk);
#endif

    bool ended = path.phase == PHASE_ENDED;
    if (!ended && faults == 0u) {
        suspendPath(index, path, walk);
        // Half saved is as good as lost: the sample begins again.
        if (faults != 0u) pixels[index].status = BLOCK_IDLE;
    }
    if (faults != 0u) {
        pixels[index].faults = faults;
        return;
    }
    block.faults = 0u;
    if (ended) {
#ifdef SAHL_FIRST_HITS
        bool isFirst = block.samplesDone == 0u;
        FirstHits sums = firstHits[index];
        if (isFirst) sums = noFirstHits();
        addFirstHit(path, walk, isFirst, sums);
        firstHits[index] = sums;
        block.samplesDone++;
#else
        addSample(path, block);
#endif
    }
    block.status = ended ? BLOCK_IDLE : BLOCK_SUSPENDED;
    pixels[index] = block;
}
