// Divides and takes roots as the device does it by itself, so that the host can see whether it rounds
// correctly (host/device/exact_math.h).
#version 460
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Operands
{
    vec2 operands[];
};
layout(std430, set = 0, binding = 1) writeonly buffer Results
{
    vec2 results[];
};

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= results.length()) return;
    results[i] = vec2(operands[i].x / operands[i].y, sqrt(operands[i].x));
}
