// What the kernels of waves share: the queues, and the invocation's entry in them. The includer defines
// WAVE_QUEUES_BINDING.

#include "kernels/uniforms.glsl"
#include "shared/bindings.h"
#include "shared/wave_types.h"

layout(local_size_x_id = SPEC_GROUP_WIDTH, local_size_y_id = SPEC_GROUP_HEIGHT) in;

layout(std430, set = 0, binding = WAVE_QUEUES_BINDING) buffer WaveQueuesBlock
{
    WaveCounts counts;
    uint entries[];
};
layout(push_constant) uniform WaveDispatchBlock
{
    WaveDispatch jobs[1];
};
#define job jobs[UNIFORMS_AT]

/// Number of this invocation in its dispatch: the place of its entry in the queue, or beyond its end.
uint waveInvocation()
{
    return gl_WorkGroupID.x * (gl_WorkGroupSize.x * gl_WorkGroupSize.y) + gl_LocalInvocationIndex;
}

uint queueAt(uint queue) { return queue * job.slotCount; }
uint freeSlotsAt() { return 2u * job.slotCount; }
