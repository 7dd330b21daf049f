#include "scene/sampling.h"

#include <algorithm>

namespace sahl {

static_assert(SAMPLER_INDEPENDENT == 0 && SAMPLER_SOBOL == 1 && SAMPLER_SOBOL64 == 2);

const char* samplerName(uint32_t samplerKind)
{
    return std::data(SAMPLERS)[samplerKind];
}

uint32_t samplerNamed(const std::string& name)
{
    return static_cast<uint32_t>(std::ranges::find(SAMPLERS, name) - SAMPLERS.begin());
}

static_assert(LIGHTS_MIS == 0 && LIGHTS_ONLY == 1 && LIGHTS_BSDF_ONLY == 2);

const char* lightSamplingName(uint32_t lightSampling)
{
    return std::data(LIGHT_SAMPLINGS)[lightSampling];
}

void readSampling(const JsonObject& integrator, RenderSettings& settings)
{
    settings.samplerKind = samplerNamed(integrator.choice("sampler", SAMPLERS));
    settings.rouletteDepth = NO_ROULETTE;
    if (integrator.has("rouletteDepth"))
        settings.rouletteDepth = integrator.uint("rouletteDepth", 0, 0, MAX_ROULETTE_DEPTH);
    settings.clampIndirect = 0;
    if (integrator.has("clampIndirect"))
        settings.clampIndirect =
            static_cast<float>(integrator.number("clampIndirect", 0, CLAMP_RANGE));
    const std::string lights = integrator.choice("lightSampling", LIGHT_SAMPLINGS);
    settings.lightSampling =
        static_cast<uint32_t>(std::ranges::find(LIGHT_SAMPLINGS, lights) - LIGHT_SAMPLINGS.begin());
}

void applySamplingOptions(RenderSettings& settings, const SceneOptions& options)
{
    settings.samplerKind = options.samplerKind.value_or(settings.samplerKind);
    settings.rouletteDepth = options.rouletteDepth.value_or(settings.rouletteDepth);
    settings.clampIndirect = options.clampIndirect.value_or(settings.clampIndirect);
    settings.lightSampling = options.lightSampling.value_or(settings.lightSampling);
}

}  // namespace sahl
