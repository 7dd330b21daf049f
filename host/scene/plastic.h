// What the coat of a plastic lets through: a number that the device does not work out by itself.
#pragma once

#include "shared/scene_types.h"

namespace sahl {

/// Share of evenly arriving light that enters a clear coat: the average of 1 minus its reflectance,
/// weighted by the cosine, for the coat of shaders/pathtrace/coat.glsl.
///   eta        index of refraction, >= 1
///   roughness  in [0,1]
double coatTransmittance(double eta, double roughness);

/// Sets `transmission` of a MATERIAL_PLASTIC from its eta and roughness.
void completePlastic(Material& material);

}  // namespace sahl
