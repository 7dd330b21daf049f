// After the last wave of a tile: adds the samples of each pixel to its block, in their order, as a megakernel does.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "kernels/device.glsl"

#define WAVE_QUEUES_BINDING BINDING_WAVE_QUEUES
#include "kernels/wave.glsl"
#include "pathtrace/pathtrace.glsl"
#include "shared/adaptive_types.h"
#include "pathtrace/film_sums.glsl"
#include "kernels/wave_samples.glsl"

layout(std430, set = 0, binding = BINDING_WAVE_PIXELS) writeonly buffer PixelsBlock
{
    PixelBlock pixels[];
};

void main()
{
    uint pixel = waveInvocation();
    if (pixel >= job.pixelCount) return;
    PixelBlock block = emptyBlock();
    uint i = 0u;
    for (; i < job.sampleCount; i++) {
        PathState path;
        loadSample(pixel * job.sampleCount + i, path);
        addSample(path, block);
    }
    block.faults = i == job.sampleCount ? 0u : FAULT_LOOP_CUT;
    pixels[pixel] = block;
}
