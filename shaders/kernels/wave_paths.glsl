// The buffers in which paths wait between two kernels of a wave.

layout(std430, set = 0, binding = BINDING_WAVE_SAMPLES) buffer WaveSamplesBlock
{
    WaveSample samples[];
};
layout(std430, set = 0, binding = BINDING_WAVE_PATHS) buffer WavePathsBlock
{
    WavePath paths[];
};
layout(std430, set = 0, binding = BINDING_WAVE_RAYS) buffer WaveRaysBlock
{
    WaveRay rays[];
};
layout(std430, set = 0, binding = BINDING_WAVE_HITS) buffer WaveHitsBlock
{
    WaveHit hits[];
};

/// Whether a scene has shadow rays at all.
CONST bool HAS_SHADOW_RAYS = (FEATURES & (FEATURE_FAR_LIGHTS | FEATURE_SHAPE_LIGHTS | FEATURE_PROBE_LIGHT | FEATURE_PHONG)) != 0u;
