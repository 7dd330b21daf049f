// What the test of the BSDFs' bits asks and gets, the same bytes for C++ and GLSL.
#ifndef SAHL_BSDF_QUERY_H
#define SAHL_BSDF_QUERY_H

#include "shared/scene_types.h"

SHARED_BEGIN

struct BsdfQuery
{
    Material material;
    vec3 ng;          // as in SurfaceInteraction
    uint front;
    vec3 ns;
    float mediumEta;
    vec3 dir;         // of the ray that arrives
    uint unused0;
    vec3 wi;          // where the BSDF is evaluated
    uint unused1;
    vec4 u;
};
GPU_STRUCT_SIZE(BsdfQuery, 208);
GPU_FIELD(BsdfQuery, u, 192);

struct BsdfAnswer
{
    vec3 wi;          // of the sample, as the rest down to etaScale
    uint lobe;
    vec3 weight;
    float pdf;
    vec3 f;           // for the query's wi
    float pdfAtWi;
    float mediumEta;
    float etaScale;
    uint unused0;
    uint unused1;
};
GPU_STRUCT_SIZE(BsdfAnswer, 64);
GPU_FIELD(BsdfAnswer, mediumEta, 48);

SHARED_END

#endif
