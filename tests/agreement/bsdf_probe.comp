// Samples and evaluates BSDFs for given numbers, so that the host can compare the bits.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "kernels/device.glsl"
#include "bsdf_query.h"

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Queries { BsdfQuery queries[]; };
layout(std430, set = 0, binding = 1) writeonly buffer Answers { BsdfAnswer answers[]; };

#include "pathtrace/pathtrace.glsl"

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= answers.length()) return;
    BsdfQuery q = queries[i];
    SurfaceInteraction isect;
    isect.p = vec3(0.0f);
    isect.pError = 1e-6f;
    isect.ng = q.ng;
    isect.ns = q.ns;
    isect.nsStored = q.front != 0u ? q.ns : -q.ns;
    isect.front = q.front != 0u;
    isect.material = 0u;
    BsdfSample bs = sampleBsdf(q.material, isect, q.dir, q.mediumEta, q.u);
    BsdfAnswer a;
    a.wi = bs.wi;
    a.lobe = bs.lobe;
    a.weight = bs.weight;
    a.pdf = bs.pdf;
    BsdfValue value = evalBsdf(q.material, isect, -q.dir, q.wi);
    a.f = value.f;
    a.pdfAtWi = value.pdf;
    a.mediumEta = bs.mediumEta;
    a.etaScale = bs.etaScale;
    a.unused0 = 0u;
    a.unused1 = 0u;
    answers[i] = a;
}
