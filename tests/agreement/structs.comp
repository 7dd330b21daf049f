// Reads every field of every shared struct and writes it back as one word, in order of declaration.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shared/film_types.h"
#include "shared/scene_types.h"

layout(local_size_x = 1) in;
layout(std430, binding = 0) readonly buffer Nodes { BvhNode nodes[]; };
layout(std430, binding = 1) readonly buffer Primitives { Primitive primitives[]; };
layout(std430, binding = 2) readonly buffer Normals { TriangleCorners normals[]; };
layout(std430, binding = 3) readonly buffer Materials { Material materials[]; };
layout(std430, binding = 4) readonly buffer Lights { Light lights[]; };
layout(std430, binding = 5) readonly buffer Frames { Frame frames[]; };
layout(std430, binding = 6) readonly buffer Blocks { PixelBlock blocks[]; };
layout(std430, binding = 7) readonly buffer Paths { SuspendedPath paths[]; };
layout(std430, binding = 8) readonly buffer Instances { ObjectInstance instances[]; };
layout(std430, binding = 9) readonly buffer Textures { Texture textures[]; };
layout(std430, binding = 10) writeonly buffer Words { uint words[]; };
layout(push_constant) uniform JobBlock { Dispatch job; };

uint count = 0u;

void put(uint value) { words[count++] = value; }
void put(float value) { put(floatBitsToUint(value)); }
void put(vec3 value)
{
    put(value.x);
    put(value.y);
    put(value.z);
}

void put(Probe p)
{
    put(p.width); put(p.height); put(p.mapping); put(p.filterMode);
    put(p.axisX); put(p.firstTexel); put(p.axisY); put(p.unused0); put(p.axisZ); put(p.unused1);
}

void put(Traversal w)
{
    put(w.ref); put(w.stackSize); put(w.slot); put(w.number); put(w.tHit); put(w.b1); put(w.b2);
    put(w.inside); put(w.instance); put(w.group); put(w.unused0); put(w.unused1);
}

void main()
{
    // The second element of each array: the stride counts as well.
    BvhNode n = nodes[1];
    put(n.lo0); put(n.ref0); put(n.hi0); put(n.ref1); put(n.lo1); put(n.unused0); put(n.hi1); put(n.unused1);
    Primitive t = primitives[1];
    put(t.p0); put(t.number); put(t.p1); put(t.material); put(t.p2); put(t.shape);
    TriangleCorners s = normals[1];
    put(s.n0); put(s.u0); put(s.n1); put(s.u1); put(s.n2); put(s.u2);
    put(s.v0); put(s.v1); put(s.v2); put(s.unused0);
    Material m = materials[1];
    put(m.baseColor); put(m.eta); put(m.emission); put(m.type);
    put(m.conductorEta); put(m.diffuseWeight); put(m.conductorK); put(m.specularWeight);
    put(m.specularColor); put(m.shininess); put(m.ambientColor); put(m.unused0);
    put(m.roughness); put(m.metallic); put(m.transmission); put(m.alphaCutoff);
    put(m.baseColorTexture); put(m.roughnessTexture); put(m.normalTexture); put(m.emissionTexture);
    Light l = lights[1];
    put(l.position); put(l.type); put(l.intensity); put(l.cosOuter); put(l.direction); put(l.cosInner);
    put(l.chance); put(l.slot); put(l.instance); put(l.unused0);
    Frame f = frames[1];
    put(f.camera.position); put(f.camera.type); put(f.camera.right); put(f.camera.focusDistance);
    put(f.camera.down); put(f.camera.unused0); put(f.camera.forward); put(f.camera.unused1);
    put(f.camera.lensRight); put(f.camera.unused2); put(f.camera.lensDown); put(f.camera.unused3);
    put(f.probe);
    put(f.background);
    put(f.width); put(f.height); put(f.seed); put(f.maxBounces);
    put(f.rootRef); put(f.lightCount); put(f.integrator); put(f.jitter);
    put(f.ambient); put(f.shading);
    put(f.samplerKind); put(f.rouletteDepth); put(f.clampIndirect); put(f.lightSampling);
    put(f.singleCount); put(f.choiceCount); put(f.clusterCount); put(f.lightPerPower);
    put(f.probeSlope); put(f.probeMean);
    put(f.gridAt); put(f.gridScale);
    put(f.lightsAt); put(f.aliasAt); put(f.texturesAt); put(f.textureTexelsAt);
    PixelBlock b = blocks[1];
    put(b.sum); put(b.sumY2); put(b.digest); put(b.samplesDone); put(b.status); put(b.badSamples);
    put(b.indirectRays); put(b.shadowRays); put(b.boxTests); put(b.primitiveTests);
    put(b.bounces); put(b.faults); put(b.clamped); put(b.unused0);
    PathState p = paths[1].path;
    put(p.org); put(p.phase); put(p.dir); put(p.depth); put(p.beta); put(p.pixel); put(p.L); put(p.sampleIndex);
    put(p.shadowOrg); put(p.shadowTMax); put(p.shadowDir); put(p.digest); put(p.Ld); put(p.mediumEta);
    put(p.pdf); put(p.etaScale); put(p.probeChance); put(p.tableChance);
    put(p.hit);
    put(paths[1].traversal);
    put(paths[1].indirectRays); put(paths[1].shadowRays); put(paths[1].boxTests); put(paths[1].primitiveTests);
    put(paths[1].bounces); put(paths[1].clamped); put(paths[1].unused0); put(paths[1].unused1);
    for (uint i = 0u; i < MAX_SUSPENDED_STACK; i++) put(paths[1].stack[i]);
    ObjectInstance o = instances[1];
    put(o.toObject0); put(o.rootRef); put(o.toObject1); put(o.firstNumber); put(o.toObject2); put(o.material);
    put(o.toWorld0); put(o.gridX); put(o.toWorld1); put(o.gridY); put(o.toWorld2); put(o.gridZ);
    put(o.translation); put(o.gridScale); put(o.lo); put(o.unused0); put(o.hi); put(o.unused1);
    Texture x = textures[1];
    put(x.firstTexel); put(x.width); put(x.height); put(x.flags); put(x.rowS); put(x.strength);
    put(x.rowT); put(x.unused0); put(x.mean); put(x.unused1);
    put(job.tileX); put(job.tileY); put(job.tileWidth); put(job.tileHeight);
    put(job.firstSample); put(job.sampleCount); put(job.stepBudget); put(job.samplesAtOnce);
}
