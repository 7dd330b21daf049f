// The megakernel of adaptive sampling: every invocation takes one pixel of the queue up to one sample
// further, and asks the rule after it. Suspension and faults are as in path.comp.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "kernels/device.glsl"

#define ADAPTIVE_BINDING BINDING_PIXELS
#include "kernels/adaptive.glsl"
#include "pathtrace/pathtrace.glsl"
#include "pathtrace/adaptive.glsl"
#include "kernels/suspend.glsl"

void main()
{
    uint slot = queueSlot();
    if (slot >= job.queueSize) return;
    uint index = queuedPixel(slot);
    PixelBlock block = pixels[index].block;
    if (block.samplesDone == BLOCK_SIZE || pixels[index].state != PIXEL_ACTIVE) return;
    uint sampleIndex = job.pass * BLOCK_SIZE + block.samplesDone;
    pixels[index].firstSample = job.pass * BLOCK_SIZE;

    stepsLeft = job.stepBudget;
    faults = 0u;
    tally = Tally(0u, 0u, 0u, 0u, 0u, 0u);
    PathState path;
    Traversal walk;
    if (RESUMES && block.status == BLOCK_SUSPENDED) {
        resumePath(index, path, walk);
    } else {
        path = beginPath(job.tileX + index % job.tileWidth, job.tileY + index / job.tileWidth, sampleIndex);
        walk = beginPathTraversal(path);
    }
    advancePath(path, walk);

    bool ended = path.phase == PHASE_ENDED;
    if (RESUMES && !ended && faults == 0u) {
        suspendPath(index, path, walk);
        // Half saved is as good as lost: the sample begins again.
        if (faults != 0u) pixels[index].block.status = BLOCK_IDLE;
    }
    if (faults != 0u) {
        pixels[index].block.faults = faults;
        return;
    }
    block.faults = 0u;
    block.status = ended || !RESUMES ? BLOCK_IDLE : BLOCK_SUSPENDED;
    if (ended) {
        vec3 L = addSample(path, block);
        vec3 mean = pixels[index].mean;
        pixels[index].state = stateAfter(job.rule, L, sampleIndex + 1u, mean);
        pixels[index].mean = mean;
    }
    pixels[index].block = block;
}
