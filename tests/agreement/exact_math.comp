// The text's exact division and square root, with an error put into the device's guess.
#version 460
#extension GL_GOOGLE_include_directive : require

#define CONST const
#define fusedMultiplyAdd(a, b, c) fma(a, b, c)
#include "pathtrace/exact.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Operands { uvec2 operands[]; };
layout(std430, binding = 1) writeonly buffer Results { uvec4 results[]; };
layout(push_constant) uniform JobBlock { int nudge; };

void main()
{
    uint i = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * 64u;
    if (i >= results.length()) return;
    float a = uintBitsToFloat(operands[i].x);
    float b = uintBitsToFloat(operands[i].y);
    results[i] = uvec4(floatBitsToUint(exactQuotient(a, b, nudge)), floatBitsToUint(exactRoot(a, nudge)),
                       floatBitsToUint(fusedQuotient(a, b, nudge)), 0u);
}
