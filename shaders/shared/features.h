// What a scene may have that others lack: bits of SPEC_FEATURES. A kernel made for a scene leaves out what the scene
// has no use for (pathtrace/features.glsl).
#ifndef SAHL_FEATURES_H
#define SAHL_FEATURES_H

#include "shared/interop.h"

SHARED_BEGIN

SHARED_CONST uint FEATURE_INSTANCES = 1u;
SHARED_CONST uint FEATURE_TEXTURES = 2u;
SHARED_CONST uint FEATURE_CUTOUTS = 4u;        // materials with holes
SHARED_CONST uint FEATURE_SPHERES = 8u;
SHARED_CONST uint FEATURE_SMOOTH = 16u;        // materials between MATERIAL_LAMBERT and the glossy ones
SHARED_CONST uint FEATURE_GLOSSY = 32u;        // materials from MATERIAL_ROUGH_CONDUCTOR on
SHARED_CONST uint FEATURE_PATHS = 64u;         // INTEGRATOR_PATH
SHARED_CONST uint FEATURE_PHONG = 128u;        // INTEGRATOR_PHONG
SHARED_CONST uint FEATURE_INDEPENDENT = 256u;  // SAMPLER_INDEPENDENT
SHARED_CONST uint FEATURE_SOBOL = 512u;        // SAMPLER_SOBOL
SHARED_CONST uint FEATURE_FAR_LIGHTS = 1024u;  // point, spot and directional ones
SHARED_CONST uint FEATURE_SHAPE_LIGHTS = 2048u;  // shapes that light sampling looks for
SHARED_CONST uint FEATURE_PROBE_LIGHT = 4096u;   // likewise the probe
SHARED_CONST uint FEATURE_LATLONG = 8192u;     // probes of PROBE_LATLONG
SHARED_CONST uint FEATURE_ANGULAR = 16384u;    // probes of PROBE_ANGULAR
SHARED_CONST uint FEATURE_MANY_TEXELS = 32768u;  // probes of more than one texel
SHARED_CONST uint FEATURE_SOBOL64 = 65536u;    // SAMPLER_SOBOL64
SHARED_CONST uint FEATURES_ALL = 0xffffffffu;

SHARED_END

#endif
