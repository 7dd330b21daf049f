// What kernels of adaptive sampling share: the pixels of a tile and the queues in them. The includer
// defines ADAPTIVE_BINDING.

#include "kernels/uniforms.glsl"
#include "shared/adaptive_types.h"
#include "shared/bindings.h"

layout(local_size_x_id = SPEC_GROUP_WIDTH, local_size_y_id = SPEC_GROUP_HEIGHT) in;

layout(std430, set = 0, binding = ADAPTIVE_BINDING) buffer AdaptiveBlock
{
    AdaptiveCounts counts;
    AdaptivePixel pixels[];
};
layout(push_constant) uniform AdaptiveDispatchBlock
{
    AdaptiveDispatch jobs[1];
};
#define job jobs[UNIFORMS_AT]

/// Place of this invocation in the queue, from 0 to job.queueSize - 1 or beyond its end.
uint queueSlot()
{
    uint groupSize = gl_WorkGroupSize.x * gl_WorkGroupSize.y;
    return gl_WorkGroupID.x * groupSize + gl_LocalInvocationIndex;
}

/// Pixel that stands there, counted within the tile.
uint queuedPixel(uint slot)
{
    return job.queue == QUEUE_ALL ? slot : pixels[slot].queue[job.queue];
}
