// What a scene is on the device: plain arrays of these structs, the same bytes for C++ and GLSL.
// Every vec3 stands before a scalar, so that std430, std140 and C++ lay the fields out alike.
#ifndef SAHL_SCENE_TYPES_H
#define SAHL_SCENE_TYPES_H

#include "shared/interop.h"

SHARED_BEGIN

// A reference to something in the tree is one uint:
//   inner node   its index in `nodes`
//   leaf         REF_LEAF | first triangle << 3 | (triangle count - 1)
//   nothing      REF_NONE (it has the leaf bit, so that "is an inner node" is one test)
SHARED_CONST uint REF_LEAF = 0x80000000u;
SHARED_CONST uint REF_NONE = 0xffffffffu;
SHARED_CONST uint LEAF_COUNT_BITS = 3u;
SHARED_CONST uint MAX_LEAF_SIZE = 8u;
SHARED_CONST uint MAX_TRIANGLES = 0x0ffffff0u;  // so that no leaf reference equals REF_NONE
SHARED_CONST uint MAX_STACK_SIZE = 64u;         // bound of the tree's depth
SHARED_CONST uint NO_NORMALS = 0xffffffffu;
SHARED_CONST uint NO_HIT = 0xffffffffu;

// An inner node holds the boxes of its two children: one read serves two box tests.
struct BvhNode
{
    vec3 lo0;   // box of child 0, world space [m]
    uint ref0;  // see above
    vec3 hi0;
    uint ref1;
    vec3 lo1;   // box of child 1
    uint unused0;
    vec3 hi1;
    uint unused1;
};
GPU_STRUCT_SIZE(BvhNode, 64);
GPU_FIELD(BvhNode, ref1, 28);
GPU_FIELD(BvhNode, hi1, 48);

// Stored in the order of the leaves.
struct Triangle
{
    vec3 p0;        // corners, world space [m]; counter-clockwise seen from the front
    uint primitive; // number of the triangle in the scene as read: decides ties, names hits
    vec3 p1;
    uint material;  // index in `materials`
    vec3 p2;
    uint normals;   // index in `triangleNormals`, or NO_NORMALS for a flat triangle
};
GPU_STRUCT_SIZE(Triangle, 48);
GPU_FIELD(Triangle, primitive, 12);
GPU_FIELD(Triangle, normals, 44);

struct TriangleNormals
{
    vec3 n0;        // unit shading normals at the corners, world space
    uint unused0;
    vec3 n1;
    uint unused1;
    vec3 n2;
    uint unused2;
};
GPU_STRUCT_SIZE(TriangleNormals, 48);
GPU_FIELD(TriangleNormals, n2, 32);

SHARED_CONST uint MATERIAL_LAMBERT = 0u;

struct Material
{
    vec3 baseColor;   // reflectance, linear Rec. 709, in [0,1]
    float unused0;
    vec3 emission;    // radiance on both sides [W m^-2 sr^-1], linear Rec. 709
    uint type;        // one of MATERIAL_*
};
GPU_STRUCT_SIZE(Material, 32);
GPU_FIELD(Material, type, 28);

SHARED_CONST uint LIGHT_POINT = 0u;

struct Light
{
    vec3 position;    // world space [m]
    uint type;        // one of LIGHT_*
    vec3 intensity;   // radiant intensity [W sr^-1], linear Rec. 709
    float unused0;
};
GPU_STRUCT_SIZE(Light, 32);
GPU_FIELD(Light, type, 12);

// A pixel (x, y), counted from the top left, is seen along
//   forward + right * (x * 2/width - 1) + down * (y * 2/height - 1),
// so |right| and |down| are the tangents of half the fields of view.
struct Camera
{
    vec3 position;    // world space [m]
    float unused0;
    vec3 right;
    float unused1;
    vec3 down;
    float unused2;
    vec3 forward;     // unit
    float unused3;
};
GPU_STRUCT_SIZE(Camera, 64);
GPU_FIELD(Camera, forward, 48);

SHARED_CONST uint PROBE_LATLONG = 0u;  // Debevec's: centre of the picture is -Z, up is +Y
SHARED_CONST uint PROBE_ANGULAR = 1u;  // Debevec's angular map: centre -Z, rim +Z
SHARED_CONST uint FILTER_NEAREST = 0u;
SHARED_CONST uint FILTER_BILINEAR = 1u;

// The light probe's texels are a buffer of vec4 (RGB radiance, unused), top row first.
struct Probe
{
    uint width;
    uint height;      // 0: no environment, black
    uint mapping;     // one of PROBE_*
    uint filterMode;  // one of FILTER_*
};
GPU_STRUCT_SIZE(Probe, 16);

// Everything that stays the same for a whole picture.
struct Frame
{
    Camera camera;
    Probe probe;
    uint width;       // of the full picture [pixels], whatever part is rendered
    uint height;
    uint seed;
    uint maxBounces;  // scatterings after which a path ends; it may still see light then
    uint rootRef;     // reference to the root of the tree
    uint lightCount;
    uint triangleCount;
    uint unused0;
};
GPU_STRUCT_SIZE(Frame, 112);
GPU_FIELD(Frame, probe, 64);
GPU_FIELD(Frame, rootRef, 96);

SHARED_END

#endif
