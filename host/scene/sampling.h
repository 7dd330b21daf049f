// How samples are drawn and weighed, as a scene file and the command line ask for it: the sampler,
// Russian roulette, the clamp of indirect light, how lights are looked for.
#pragma once

#include "scene/json_fields.h"
#include "scene/scene.h"

namespace sahl {

constexpr uint32_t MAX_ROULETTE_DEPTH = 65535;
constexpr Range CLAMP_RANGE = {1e-20, 1e18};  ///< of luminance [W m^-2 sr^-1]

/// All samplers, in the order of SAMPLER_*.
constexpr std::initializer_list<const char*> SAMPLERS = {"independent", "sobol", "sobol64"};

/// "independent", "sobol" or "sobol64".
const char* samplerName(uint32_t samplerKind);

/// SAMPLER_* of one of these names.
uint32_t samplerNamed(const std::string& name);

/// In the order of LIGHTS_*.
constexpr std::initializer_list<const char*> LIGHT_SAMPLINGS = {"mis", "lights", "bsdf"};

/// "mis", "lights" or "bsdf".
const char* lightSamplingName(uint32_t lightSampling);

/// Reads "sampler", "rouletteDepth", "clampIndirect" and "lightSampling" of the integrator. What is absent is
/// off; of the last it is "mis".
void readSampling(const JsonObject& integrator, RenderSettings& settings);

/// Takes over what the command line says.
void applySamplingOptions(RenderSettings& settings, const SceneOptions& options);

}  // namespace sahl
