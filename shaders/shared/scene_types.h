// What a scene is on the device: plain arrays of these structs, the same bytes for C++ and GLSL.
// Every vec3 stands before a scalar, so that std430, std140 and C++ lay the fields out alike.
#ifndef SAHL_SCENE_TYPES_H
#define SAHL_SCENE_TYPES_H

#include "shared/interop.h"

SHARED_BEGIN

// A reference to something in the tree is one uint:
//   inner node   its index in `nodes`; of a wide one also, from bit WIDE_CHILDREN_SHIFT on, its children - 1
//   leaf         REF_LEAF | first primitive << 3 | (primitive count - 1)
//   instance     REF_INSTANCE | its index in `instances`
//   way back     REF_LEAVE, only on the stack: the walk leaves the instance that it is in
//   nothing      REF_NONE
// All but an inner node have a bit of REF_NOT_INNER, so that "is an inner node" is one test.
SHARED_CONST uint REF_LEAF = 0x80000000u;
SHARED_CONST uint REF_INSTANCE = 0x40000000u;
SHARED_CONST uint REF_LEAVE = 0x7fffffffu;
SHARED_CONST uint REF_NOT_INNER = 0xc0000000u;
SHARED_CONST uint REF_NONE = 0xffffffffu;
SHARED_CONST uint LEAF_COUNT_BITS = 3u;
SHARED_CONST uint MAX_LEAF_SIZE = 8u;
SHARED_CONST uint MAX_PRIMITIVES = 0x0ffffff0u;  // so that no leaf reference equals REF_NONE
SHARED_CONST uint MAX_STACK_SIZE = 64u;         // bound of the tree's depth
SHARED_CONST uint STACK_REGISTERS = 16u;        // of a stack in registers
SHARED_CONST uint WIDE_CHILDREN_SHIFT = 28u;
SHARED_CONST uint WIDE_INDEX = 0x00ffffffu;     // bits of the index of a wide node
SHARED_CONST uint SHAPE_FLAT = 0xffffffffu;    // a triangle without normals or texture coordinates
SHARED_CONST uint SHAPE_SPHERE = 0xfffffffeu;
SHARED_CONST uint NO_HIT = 0xffffffffu;
SHARED_CONST uint NO_INSTANCE = 0xffffffffu;
SHARED_CONST uint NO_MATERIAL = 0xffffffffu;
SHARED_CONST uint MAX_INSTANCES = 1048576u;  // 2^20

// An inner node holds the boxes of its two children: one read serves two box tests.
// Nodes are as large as a line of the processor's cache and begin where one does: a visit reads one line, not two.
struct HOST_ALIGNED(64) BvhNode
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

// A node of the wide tree, which is made of the one above and walked in its place where it is faster: up to
// four children, their boxes' planes on a grid of 2^16 steps along each axis of the tree. A plane is at
//   (q + gridAt) 2^k,  q its 16 bits, gridAt a whole number, k an integer for each axis
// and the box that the planes bound encloses the child's box. GRID_BIAS + k are the bytes of gridScale, x
// lowest; gridAt and gridScale are the tree's: in Frame for the world, in ObjectInstance for an object.
struct HOST_ALIGNED(64) WideNode
{
    uvec4 x;     // of every child the lower plane's bits | the upper's << 16
    uvec4 y;
    uvec4 z;
    uvec4 refs;  // see above; inner nodes by their index in `wideNodes`; REF_NONE: no child
};
GPU_STRUCT_SIZE(WideNode, 64);
GPU_FIELD(WideNode, refs, 48);

SHARED_CONST uint GRID_BIAS = 127u;

// A triangle or a sphere. Stored in the order of the leaves.
struct Primitive
{
    vec3 p0;        // triangle: corners [m]; counter-clockwise seen from the front; in world space,
                    // those of an instanced object in its own
    uint number;    // of the primitive in the scene (object) as read: decides ties, names hits
    vec3 p1;        // sphere: centre in p0, radius in p1.x [m]
    uint material;  // index in `materials`
    vec3 p2;
    uint shape;     // triangle: index in `triangleCorners`, or SHAPE_FLAT; or SHAPE_SPHERE
};
GPU_STRUCT_SIZE(Primitive, 48);
GPU_FIELD(Primitive, number, 12);
GPU_FIELD(Primitive, shape, 44);

struct TriangleCorners
{
    vec3 n0;        // unit shading normals at the corners, world space; all zero: as the geometry
    float u0;       // texture coordinates (u, v), v up; (0, 0) where there are none
    vec3 n1;
    float u1;
    vec3 n2;
    float u2;
    float v0;
    float v1;
    float v2;
    uint unused0;
};
GPU_STRUCT_SIZE(TriangleCorners, 64);
GPU_FIELD(TriangleCorners, n2, 32);
GPU_FIELD(TriangleCorners, v0, 48);

// An object placed in the world: a tree of its own, in `nodes` and `primitives` like the world's, whose
// primitives are numbered from 0. Several instances may share one object. A point q of the object is at
//   p = toWorld q + translation        q = toObject (p - translation)
// in the world; the two matrices, of which the rows are stored, are inverse up to rounding.
struct ObjectInstance
{
    vec3 toObject0;
    uint rootRef;       // of the object's tree
    vec3 toObject1;
    uint firstNumber;   // added to the numbers of the object's primitives: they are unique in the scene
    vec3 toObject2;
    uint material;      // of all its primitives, or NO_MATERIAL: each has its own
    vec3 toWorld0;
    float gridX;        // gridAt of the object's wide tree; 0 in the binary one, as gridScale
    vec3 toWorld1;
    float gridY;
    vec3 toWorld2;
    float gridZ;
    vec3 translation;   // [m]
    uint gridScale;
    vec3 lo;            // box that a ray must meet to meet the object, world space [m]: that of the
    uint unused0;       // object, widened by what the ray's way into the object's space may be rounded
    vec3 hi;
    uint unused1;
};
GPU_STRUCT_SIZE(ObjectInstance, 144);
GPU_FIELD(ObjectInstance, firstNumber, 28);
GPU_FIELD(ObjectInstance, translation, 96);
GPU_FIELD(ObjectInstance, hi, 128);

SHARED_CONST uint MATERIAL_LAMBERT = 0u;     // diffuse, baseColor
SHARED_CONST uint MATERIAL_MIRROR = 1u;      // reflects baseColor of what arrives
SHARED_CONST uint MATERIAL_DIELECTRIC = 2u;  // smooth glass, water: eta; baseColor tints transmission
SHARED_CONST uint MATERIAL_CONDUCTOR = 3u;   // smooth metal: conductorEta, conductorK
SHARED_CONST uint MATERIAL_REPORT = 4u;      // the report's: weights of a diffuse and a dielectric part
SHARED_CONST uint MATERIAL_ROUGH_CONDUCTOR = 5u;   // as MATERIAL_CONDUCTOR, with a roughness
SHARED_CONST uint MATERIAL_ROUGH_DIELECTRIC = 6u;  // as MATERIAL_DIELECTRIC, with a roughness
SHARED_CONST uint MATERIAL_THIN_DIELECTRIC = 7u;   // a pane: eta; baseColor tints what passes through it
SHARED_CONST uint MATERIAL_PLASTIC = 8u;           // diffuse, baseColor, under a coat: eta, roughness
SHARED_CONST uint MATERIAL_METALLIC_ROUGHNESS = 9u;  // glTF's

SHARED_CONST uint NO_TEXTURE = 0u;  // textures of a material are counted from 1

struct Material
{
    vec3 baseColor;       // linear Rec. 709, in [0,1]
    float eta;            // index of refraction behind the surface, relative to that in front of it
                          // (MATERIAL_REPORT: to vacuum); > 0
    vec3 emission;        // radiance on both sides [W m^-2 sr^-1], linear Rec. 709
    uint type;            // one of MATERIAL_*
    vec3 conductorEta;    // complex index of refraction eta + i k at red, green and blue
    float diffuseWeight;  // MATERIAL_REPORT, in [0,1]
    vec3 conductorK;
    float specularWeight; // MATERIAL_REPORT, in [0,1]
    vec3 specularColor;   // INTEGRATOR_PHONG alone, as the rest: weight of the highlight, in [0,1]
    float shininess;      // exponent of the highlight, >= 0
    vec3 ambientColor;    // share of the ambient light that is sent back, in [0,1]
    uint unused0;
    float roughness;      // perceptual, in [0,1]: its square is GGX's alpha
    float metallic;       // in [0,1]
    float transmission;   // share of what is not metallic that lets light through, in [0,1];
                          // MATERIAL_PLASTIC: of even light the share that enters the coat
    float alphaCutoff;    // below this alpha there is no surface; 0: alpha is not asked for
    uint baseColorTexture;   // number in `textures` counted from 1, or NO_TEXTURE, as the rest
    uint roughnessTexture;   // green: roughness, blue: metallic
    uint normalTexture;      // in tangent space
    uint emissionTexture;
};
GPU_STRUCT_SIZE(Material, 128);
GPU_FIELD(Material, type, 28);
GPU_FIELD(Material, conductorK, 48);
GPU_FIELD(Material, shininess, 76);
GPU_FIELD(Material, ambientColor, 80);
GPU_FIELD(Material, roughness, 96);
GPU_FIELD(Material, emissionTexture, 124);

SHARED_CONST uint LIGHT_POINT = 0u;
SHARED_CONST uint LIGHT_SPOT = 1u;
SHARED_CONST uint LIGHT_DIRECTIONAL = 2u;
SHARED_CONST uint LIGHT_TRIANGLE = 3u;  // that shines: from here on `slot` and `instance` say all
SHARED_CONST uint LIGHT_SPHERE = 4u;
SHARED_CONST uint LIGHT_CLUSTER = 5u;   // many lights seen as one, to estimate what arrives of them:
                                        // position: their middle; intensity.x, of those that are somewhere:
                                        // irradiance at a distance of 1 [W]; cosOuter: mean of their
                                        // squared distances from the middle [m^2]; cosInner: irradiance
                                        // of the directional ones

SHARED_CONST uint MAX_SINGLE_LIGHTS = 32u;  // point, spot and directional lights that are chosen one by one
SHARED_CONST uint MAX_LIGHT_CLUSTERS = 8u;

struct Light
{
    vec3 position;    // point and spot: world space [m]
    uint type;        // one of LIGHT_*
    vec3 intensity;   // point and spot: radiant intensity [W sr^-1]; directional: irradiance of a
                      // surface that faces the light [W m^-2]; linear Rec. 709
    float cosOuter;   // spot: cosine of the angle beyond which there is no light
    vec3 direction;   // spot and directional: unit, the way the light goes
    float cosInner;   // spot: cosine of the angle within which the intensity is full
    float chance;     // probability that this one is taken of those that the alias table is for
    uint slot;        // of a shape that shines: its index in `primitives`
    uint instance;    // and the instance that it is in, or NO_INSTANCE
    uint unused0;
};
GPU_STRUCT_SIZE(Light, 64);
GPU_FIELD(Light, cosOuter, 28);
GPU_FIELD(Light, direction, 32);
GPU_FIELD(Light, chance, 48);

// One of n things is chosen by 32 random bits r: the high word of r * n is k, and the low word says
// whether it is k itself or its alias. Two entries are 16 bytes.
// Walker 1974, "New fast method for generating discrete random numbers with arbitrary frequency
// distributions", Electronics Letters 10(8).
struct AliasEntry
{
    uint threshold;  // k is taken where the low word is less than this; 0xffffffff: always
    uint alias;
};
GPU_STRUCT_SIZE(AliasEntry, 8);

SHARED_CONST uint TEXTURE_SRGB = 1u;     // red, green and blue are encoded
SHARED_CONST uint TEXTURE_CLAMP_S = 2u;  // rather than repeated
SHARED_CONST uint TEXTURE_CLAMP_T = 4u;
SHARED_CONST uint TEXTURE_NEAREST = 8u;  // rather than bilinear

// A way of looking up a picture of RGBA8 texels, a uint each with red lowest, top row first. The buffer of
// the texels of all pictures begins with the sRGB curve at 0 to 255 of 255, as the bits of floats.
SHARED_CONST uint SRGB_TABLE_SIZE = 256u;

struct Texture
{
    uint firstTexel;  // in the buffer of texture texels
    uint width;
    uint height;
    uint flags;       // TEXTURE_* bits
    vec3 rowS;        // texture coordinates (u, v) are looked up at s = rowS . (u, v, 1) and
    float strength;   // of a normal map: its x and y are multiplied by this
    vec3 rowT;        // t = rowT . (u, v, 1), t up
    uint unused0;
    vec3 mean;        // over all texels, of red, green and blue, linear
    uint unused1;
};
GPU_STRUCT_SIZE(Texture, 64);
GPU_FIELD(Texture, strength, 28);
GPU_FIELD(Texture, mean, 48);

SHARED_CONST uint CAMERA_PERSPECTIVE = 0u;
SHARED_CONST uint CAMERA_ORTHOGRAPHIC = 1u;

// With sx = x * 2/width - 1 and sy = y * 2/height - 1 for a point (x, y) of the picture, counted in
// pixels from the top left, a perspective camera looks along forward + right sx + down sy, so |right|
// and |down| are the tangents of half the fields of view; an orthographic one looks along forward from
// position + right sx + down sy, so they are half the width and height of what is seen [m].
struct Camera
{
    vec3 position;       // world space [m]
    uint type;           // one of CAMERA_*
    vec3 right;
    float focusDistance; // distance, along forward, of the plane that a lens shows sharply [m]
    vec3 down;
    float unused0;
    vec3 forward;        // unit
    float unused1;
    vec3 lensRight;      // radius of the thin lens times its axes; 0: a pinhole [m]
    float unused2;
    vec3 lensDown;
    float unused3;
};
GPU_STRUCT_SIZE(Camera, 96);
GPU_FIELD(Camera, forward, 48);
GPU_FIELD(Camera, lensDown, 80);

SHARED_CONST uint PROBE_LATLONG = 0u;  // Debevec's: centre of the picture is -Z, up is +Y
SHARED_CONST uint PROBE_ANGULAR = 1u;  // Debevec's angular map: centre -Z, rim +Z
SHARED_CONST uint FILTER_NEAREST = 0u;
SHARED_CONST uint FILTER_BILINEAR = 1u;

// Texels of all probes are one buffer of vec4 (RGB radiance, and the weight by which light sampling
// chooses the texel), top rows first.
struct Probe
{
    uint width;
    uint height;      // 0: no probe, black
    uint mapping;     // one of PROBE_*
    uint filterMode;  // one of FILTER_*
    vec3 axisX;       // a direction d is looked up at (axisX . d, axisY . d, axisZ . d)
    uint firstTexel;  // in the buffer of texels
    vec3 axisY;
    uint unused0;
    vec3 axisZ;
    uint unused1;
};
GPU_STRUCT_SIZE(Probe, 64);
GPU_FIELD(Probe, firstTexel, 28);

SHARED_CONST uint SAMPLER_INDEPENDENT = 0u;
SHARED_CONST uint SAMPLER_SOBOL = 1u;    // blocks of 8 samples go together
SHARED_CONST uint SAMPLER_SOBOL64 = 2u;  // blocks of 64

SHARED_CONST uint NO_ROULETTE = 0xffffffffu;

// Which of its two ways of finding a light a path uses where both could.
SHARED_CONST uint LIGHTS_MIS = 0u;        // both, weighted
SHARED_CONST uint LIGHTS_ONLY = 1u;       // shadow rays
SHARED_CONST uint LIGHTS_BSDF_ONLY = 2u;  // what scattered rays run into

SHARED_CONST uint INTEGRATOR_PATH = 0u;
SHARED_CONST uint INTEGRATOR_PHONG = 1u;  // local shading by the lights alone

// Bits of Frame.shading. The first four are for INTEGRATOR_PHONG.
SHARED_CONST uint SHADING_AMBIENT = 1u;    // terms that are added up
SHARED_CONST uint SHADING_DIFFUSE = 2u;
SHARED_CONST uint SHADING_SPECULAR = 4u;
SHARED_CONST uint SHADING_SHADOWS = 8u;    // lights count only where they are seen
SHARED_CONST uint SHADING_FLAT = 16u;      // geometric normals in place of interpolated ones
SHARED_CONST uint SHADING_DARK = 32u;      // no surface shines
SHARED_CONST uint SHADING_TERMS = 7u;      // all terms

// Everything that stays the same for a whole picture.
struct Frame
{
    Camera camera;
    Probe probe;         // lights the scene
    Probe background;    // what camera rays see that meet nothing
    uint width;          // of the full picture [pixels], whatever part is rendered
    uint height;
    uint seed;
    uint maxBounces;     // scatterings after which a path ends; it may still see light then
    uint rootRef;        // reference to the root of the tree
    uint lightCount;
    uint integrator;     // one of INTEGRATOR_*
    uint jitter;         // 1: samples spread over the pixel; 0: all go through its centre
    vec3 ambient;        // INTEGRATOR_PHONG: radiance that arrives from everywhere [W m^-2 sr^-1]
    uint shading;        // SHADING_* bits
    uint samplerKind;    // one of SAMPLER_*
    uint rouletteDepth;  // scatterings after which paths end by chance, or NO_ROULETTE
    float clampIndirect; // largest luminance of light scattered more than once, at a time; 0: any
    uint lightSampling;  // one of LIGHTS_*
    // `lights` are the scene's lights, the shapes that shine, clusters. A vertex chooses by what it would
    // receive among the probe, the single lights and all that the alias table is for (light_estimate.glsl).
    uint singleCount;    // lights that are chosen one by one: the first ones
    uint choiceCount;    // lights that the alias table is for: those that follow
    uint clusterCount;   // these as clusters, which follow them
    float lightPerPower; // 1 over the sum of the weights of the alias table; 0: shapes are left to chance
    vec3 probeSlope;     // the probe's luminance that shadow rays are for, linear in the direction: mean + slope . d
    float probeMean;     // 0: the probe is left to chance
    vec3 gridAt;         // of the world's wide tree
    uint gridScale;
    uint lightsAt;       // where parts of `tables` begin [16 bytes]; the device's own affair
    uint aliasAt;
    uint texturesAt;
    uint textureTexelsAt;
};
GPU_STRUCT_SIZE(Frame, 352);
GPU_FIELD(Frame, probe, 96);
GPU_FIELD(Frame, rootRef, 240);
GPU_FIELD(Frame, shading, 268);
GPU_FIELD(Frame, lightSampling, 284);
GPU_FIELD(Frame, probeMean, 316);
GPU_FIELD(Frame, textureTexelsAt, 348);

SHARED_END

#endif
