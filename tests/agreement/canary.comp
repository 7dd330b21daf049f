// Two expressions that a compiler may contract or rearrange unless they are decorated. The test runs
// them undecorated and decorated: the former must differ from C++ somewhere, the latter nowhere.
#version 460
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Inputs { float inputs[]; };
layout(std430, binding = 1) writeonly buffer Outputs { float outputs[]; };

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i * 2u >= outputs.length()) return;
    float x = inputs[i * 4u];
    float y = inputs[i * 4u + 1u];
    float z = inputs[i * 4u + 2u];
    float w = inputs[i * 4u + 3u];
    outputs[i * 2u] = x * y + y * z + z * x;
    outputs[i * 2u + 1u] = w + (0.2126f * (x * y) + 0.7152f * (y * z) + 0.0722f * (z * x));
}
