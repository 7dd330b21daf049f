// The megakernel: every invocation owns one pixel of the tile and takes it some samples further. An invocation
// whose path has ended begins its next sample at once: machines that run several invocations in step wait for the
// longest path of all samples together, not of each.
// With SAHL_FIRST_HITS a sample ends at what the camera ray meets, and goes into `firstHits`.
//
// With RESUMES a path that runs out of steps is saved and goes on in the next dispatch. Without, it begins again there, in
// a kernel that saves it: some drivers run every branch, and few paths are ever that long. An invocation in which a
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
    Dispatch jobs[1];
};
#define job jobs[UNIFORMS_AT]

#include "pathtrace/pathtrace.glsl"
#include "kernels/suspend.glsl"

#ifdef SAHL_FIRST_HITS
FirstHits sums;
#endif

/// Takes the sample one ray further; when it has ended, adds it to the pixel.
void stepSample(inout PathState path, inout Traversal walk, inout PixelBlock block)
{
#ifdef SAHL_FIRST_HITS
    advanceFirstHit(path, walk);
#else
    stepPath(path, walk);
#endif
    if (path.phase != PHASE_ENDED || faults != 0u) return;
#ifdef SAHL_FIRST_HITS
    addFirstHit(path, walk, block.samplesDone == 0u, sums);
    block.samplesDone++;
#else
    addSample(path, block);
#endif
}

/// The invocation's pixel of the tile: four invocations that follow each other take a square, eight two squares side by side,
/// as their paths are more alike than those of a line. For machines that run so many in step.
uvec2 pixelInTile()
{
    uint width = gl_WorkGroupSize.x;
    if ((width & 3u) != 0u || (gl_WorkGroupSize.y & 1u) != 0u) return gl_GlobalInvocationID.xy;
    uint i = gl_LocalInvocationIndex;
    uvec2 cell = uvec2((i >> 3u) % (width >> 2u), (i >> 3u) / (width >> 2u));
    uvec2 inCell = uvec2((i & 1u) | ((i >> 1u) & 2u), (i >> 1u) & 1u);
    return gl_WorkGroupID.xy * gl_WorkGroupSize.xy + cell * uvec2(4u, 2u) + inCell;
}

void main()
{
    uvec2 at = pixelInTile();
    if (at.x >= job.tileWidth || at.y >= job.tileHeight) return;
    uint index = at.y * job.tileWidth + at.x;
    PixelBlock block = pixels[index];
    uint wanted = min(job.sampleCount, block.samplesDone + job.samplesAtOnce);
    if (block.samplesDone >= wanted) return;

#ifdef SAHL_FIRST_HITS
    sums = noFirstHits();
    if (block.samplesDone != 0u) sums = firstHits[index];
#endif
    uvec2 pixel = uvec2(job.tileX, job.tileY) + at;
    uint firstSample = job.firstSample;
    stepsLeft = job.stepBudget;
    faults = 0u;
    PathState path;
    Traversal walk;
    if (RESUMES && block.status == BLOCK_SUSPENDED) {
        resumePath(index, path, walk);
    } else {
        path.phase = PHASE_ENDED;
    }
    for (;;) {  // the end stands behind the work: see traverse.glsl
        if (path.phase == PHASE_ENDED) {
            tally = Tally(0u, 0u, 0u, 0u, 0u, 0u);
            path = beginPath(pixel.x, pixel.y, firstSample + block.samplesDone);
            walk = beginPathTraversal(path);
        }
        stepSample(path, walk, block);
        if (block.samplesDone == wanted || stepsLeft == 0u || faults != 0u) break;
    }
    if (block.samplesDone != wanted && stepsLeft != 0u) faults |= FAULT_LOOP_CUT;

    bool between = path.phase == PHASE_ENDED;
    if (RESUMES && !between && faults == 0u) {
        suspendPath(index, path, walk);
        // Half saved is as good as lost: the sample begins again.
        if (faults != 0u) pixels[index].status = BLOCK_IDLE;
    }
    if (faults != 0u) {
        pixels[index].faults = faults;
        return;
    }
    block.faults = 0u;
    block.status = between || !RESUMES ? BLOCK_IDLE : BLOCK_SUSPENDED;
    pixels[index] = block;
#ifdef SAHL_FIRST_HITS
    firstHits[index] = sums;
#endif
}
