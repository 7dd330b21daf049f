// What a kernel provides to the path tracer's text: buffers behind accessors, and the frame.
// SAHL_TEXEL_BUFFERS chooses uniform texel buffers; otherwise the scene is read from storage buffers. With
// SAHL_TREE_IMAGES beside it nodes and primitives are read from storage texel buffers, as images: some drivers read texels
// by calls of a function and images in place (host/device/driver_habits.h).

#define CONST const
#define OUT(T) out T
#define INOUT(T) inout T
#define READ(T) T
#define fusedMultiplyAdd(a, b, c) fma(a, b, c)

#include "shared/bindings.h"
#include "shared/features.h"
#include "shared/film_types.h"
#include "shared/scene_types.h"

layout(constant_id = SPEC_STACK_SIZE) const uint STACK_SIZE = 64u;
layout(constant_id = SPEC_NODE_WIDTH) const uint NODE_WIDTH = 2u;
layout(constant_id = SPEC_STACK_IN_REGISTERS) const bool STACK_IN_REGISTERS = false;
layout(constant_id = SPEC_STEP_BY_STEP) const bool STEP_BY_STEP = false;
layout(constant_id = SPEC_WATCHED) const bool WALKS_ARE_WATCHED = true;
layout(constant_id = SPEC_RESUMES) const bool RESUMES = true;
const bool BRANCHES_ARE_GUESSED = false;
layout(constant_id = SPEC_ORDER) const uint TRAVERSAL_ORDER = ORDER_NEAR_FIRST;
layout(constant_id = SPEC_MATH) const uint MATH = MATH_NATIVE;
layout(constant_id = SPEC_FEATURES) const uint FEATURES = FEATURES_ALL;

#include "kernels/axes.glsl"
#include "kernels/four.glsl"
#include "kernels/uniforms.glsl"

layout(std140, set = 0, binding = BINDING_FRAME) uniform FrameBlock
{
    Frame frames[1];
};
#define frame frames[UNIFORMS_AT]

Frame frameToHold()
{
    Frame read;
    if (UNIFORMS_HIDDEN) read = frames[UNIFORMS_AT];
    return read;
}
Frame heldFrame = frameToHold();

/// A number or a vector of the frame. Mesa 22's lavapipe reads a uniform in 22 instructions, for each invocation by itself and
/// each time anew: there it is read once, at the start, and what nobody asks for is not read at all.
#define UNIFORM(field) (UNIFORMS_HIDDEN ? heldFrame.field : frame.field)

Probe sceneProbe()
{
    if (UNIFORMS_HIDDEN) return heldFrame.probe;
    return frame.probe;
}

Probe backgroundProbe()
{
    if (UNIFORMS_HIDDEN) return heldFrame.background;
    return frame.background;
}

#ifdef SAHL_TEXEL_BUFFERS
#define SCENE_BUFFER(bindingIndex, name) layout(set = 0, binding = bindingIndex) uniform utextureBuffer name
#define FETCH(name, index) texelFetch(name, int(index))
#else
#define SCENE_BUFFER(bindingIndex, name) \
    layout(std430, set = 0, binding = bindingIndex) readonly buffer name##Block { uvec4 name[]; }
#define FETCH(name, index) name[index]
#endif

#ifdef SAHL_TREE_IMAGES
#define TREE_BUFFER(bindingIndex, name) \
    layout(set = 0, binding = bindingIndex, rgba32ui) uniform readonly uimageBuffer name
#define TREE_FETCH(name, index) imageLoad(name, int(index))
#else
#define TREE_BUFFER SCENE_BUFFER
#define TREE_FETCH FETCH
#endif

// 16 bytes an element, whatever the struct.
TREE_BUFFER(BINDING_NODES, nodeWords);
TREE_BUFFER(BINDING_PRIMITIVES, primitiveWords);
SCENE_BUFFER(BINDING_CORNERS, cornerWords);
SCENE_BUFFER(BINDING_MATERIALS, materialWords);
SCENE_BUFFER(BINDING_TABLES, tableWords);
SCENE_BUFFER(BINDING_PROBE, probeWords);
layout(set = 0, binding = BINDING_INSTANCES) uniform utextureBuffer instanceWords;

// Of the node that a reference or a number names.
uvec4 loadWideX(uint ref) { return TREE_FETCH(nodeWords, (ref & WIDE_INDEX) * 4u); }
uvec4 loadWideY(uint ref) { return TREE_FETCH(nodeWords, (ref & WIDE_INDEX) * 4u + 1u); }
uvec4 loadWideZ(uint ref) { return TREE_FETCH(nodeWords, (ref & WIDE_INDEX) * 4u + 2u); }
uvec4 loadWideRefs(uint ref) { return TREE_FETCH(nodeWords, (ref & WIDE_INDEX) * 4u + 3u); }

// Of use on processors that read ahead; see host/reference/kernel.h.
void expectRef(uint ref) {}

BvhNode loadNode(uint index)
{
    uvec4 a = TREE_FETCH(nodeWords, index * 4u);
    uvec4 b = TREE_FETCH(nodeWords, index * 4u + 1u);
    uvec4 c = TREE_FETCH(nodeWords, index * 4u + 2u);
    uvec4 d = TREE_FETCH(nodeWords, index * 4u + 3u);
    return BvhNode(uintBitsToFloat(a.xyz), a.w, uintBitsToFloat(b.xyz), b.w,
                   uintBitsToFloat(c.xyz), c.w, uintBitsToFloat(d.xyz), d.w);
}

Primitive loadPrimitive(uint index)
{
    uvec4 a = TREE_FETCH(primitiveWords, index * 3u);
    uvec4 b = TREE_FETCH(primitiveWords, index * 3u + 1u);
    uvec4 c = TREE_FETCH(primitiveWords, index * 3u + 2u);
    return Primitive(uintBitsToFloat(a.xyz), a.w, uintBitsToFloat(b.xyz), b.w,
                     uintBitsToFloat(c.xyz), c.w);
}

TriangleCorners loadCorners(uint index)
{
    uvec4 a = FETCH(cornerWords, index * 4u);
    uvec4 b = FETCH(cornerWords, index * 4u + 1u);
    uvec4 c = FETCH(cornerWords, index * 4u + 2u);
    uvec4 d = FETCH(cornerWords, index * 4u + 3u);
    return TriangleCorners(uintBitsToFloat(a.xyz), uintBitsToFloat(a.w), uintBitsToFloat(b.xyz),
                           uintBitsToFloat(b.w), uintBitsToFloat(c.xyz), uintBitsToFloat(c.w),
                           uintBitsToFloat(d.x), uintBitsToFloat(d.y), uintBitsToFloat(d.z), d.w);
}

Material loadMaterial(uint index)
{
    uvec4 a = FETCH(materialWords, index * 8u);
    uvec4 b = FETCH(materialWords, index * 8u + 1u);
    uvec4 c = FETCH(materialWords, index * 8u + 2u);
    uvec4 d = FETCH(materialWords, index * 8u + 3u);
    uvec4 e = FETCH(materialWords, index * 8u + 4u);
    uvec4 f = FETCH(materialWords, index * 8u + 5u);
    uvec4 g = FETCH(materialWords, index * 8u + 6u);
    uvec4 h = FETCH(materialWords, index * 8u + 7u);
    return Material(uintBitsToFloat(a.xyz), uintBitsToFloat(a.w), uintBitsToFloat(b.xyz), b.w,
                    uintBitsToFloat(c.xyz), uintBitsToFloat(c.w), uintBitsToFloat(d.xyz),
                    uintBitsToFloat(d.w), uintBitsToFloat(e.xyz), uintBitsToFloat(e.w),
                    uintBitsToFloat(f.xyz), f.w, uintBitsToFloat(g.x), uintBitsToFloat(g.y),
                    uintBitsToFloat(g.z), uintBitsToFloat(g.w), h.x, h.y, h.z, h.w);
}

Light loadLight(uint index)
{
    uint at = UNIFORM(lightsAt) + index * 4u;
    uvec4 a = FETCH(tableWords, at);
    uvec4 b = FETCH(tableWords, at + 1u);
    uvec4 c = FETCH(tableWords, at + 2u);
    uvec4 d = FETCH(tableWords, at + 3u);
    return Light(uintBitsToFloat(a.xyz), a.w, uintBitsToFloat(b.xyz), uintBitsToFloat(b.w),
                 uintBitsToFloat(c.xyz), uintBitsToFloat(c.w), uintBitsToFloat(d.x), d.y, d.z, d.w);
}

AliasEntry loadAliasEntry(uint index)
{
    uvec4 two = FETCH(tableWords, UNIFORM(aliasAt) + (index >> 1u));
    return (index & 1u) == 0u ? AliasEntry(two.x, two.y) : AliasEntry(two.z, two.w);
}

Texture loadTexture(uint index)
{
    uint at = UNIFORM(texturesAt) + index * 4u;
    uvec4 a = FETCH(tableWords, at);
    uvec4 b = FETCH(tableWords, at + 1u);
    uvec4 c = FETCH(tableWords, at + 2u);
    uvec4 d = FETCH(tableWords, at + 3u);
    return Texture(a.x, a.y, a.z, a.w, uintBitsToFloat(b.xyz), uintBitsToFloat(b.w),
                   uintBitsToFloat(c.xyz), c.w, uintBitsToFloat(d.xyz), d.w);
}

uint loadTextureTexel(uint index)
{
    return FETCH(tableWords, UNIFORM(textureTexelsAt) + (index >> 2u))[index & 3u];
}

ObjectInstance loadInstance(uint index)
{
    int at = int(index) * 9;
    uvec4 a = texelFetch(instanceWords, at);
    uvec4 b = texelFetch(instanceWords, at + 1);
    uvec4 c = texelFetch(instanceWords, at + 2);
    uvec4 d = texelFetch(instanceWords, at + 3);
    uvec4 e = texelFetch(instanceWords, at + 4);
    uvec4 f = texelFetch(instanceWords, at + 5);
    uvec4 g = texelFetch(instanceWords, at + 6);
    uvec4 h = texelFetch(instanceWords, at + 7);
    uvec4 i = texelFetch(instanceWords, at + 8);
    return ObjectInstance(uintBitsToFloat(a.xyz), a.w, uintBitsToFloat(b.xyz), b.w,
                    uintBitsToFloat(c.xyz), c.w, uintBitsToFloat(d.xyz), uintBitsToFloat(d.w),
                    uintBitsToFloat(e.xyz), uintBitsToFloat(e.w), uintBitsToFloat(f.xyz), uintBitsToFloat(f.w),
                    uintBitsToFloat(g.xyz), g.w, uintBitsToFloat(h.xyz), h.w,
                    uintBitsToFloat(i.xyz), i.w);
}

vec4 loadProbeTexel(uint index)
{
    return uintBitsToFloat(FETCH(probeWords, index));
}
