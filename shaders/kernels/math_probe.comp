// Divides and takes roots as the device does it by itself, and multiplies and adds, so that the host can see how it
// rounds (host/device/exact_math.h).
#version 460
#extension GL_GOOGLE_include_directive : require

#define CONST const
#define fusedMultiplyAdd(a, b, c) fma(a, b, c)
#include "pathtrace/exact.glsl"

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Operands
{
    vec2 operands[];
};
layout(std430, set = 0, binding = 1) writeonly buffer Results
{
    vec4 results[];
};

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= results.length()) return;
    float a = operands[i].x;
    float b = operands[i].y;
    results[i] = vec4(a / b, sqrt(a), fusedQuotient(a, b, 0), fusedMultiplyAdd(a, b, -(a * b)));
}
