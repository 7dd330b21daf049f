// Rough and layered surfaces of the textbook tracer: values of their BSDFs and ways to sample them.
#pragma once

#include "oracle/textbook_parts.h"

#include <functional>

namespace textbook {

/// A rough or layered surface at one point, seen from one side.
struct RoughSurface {
    const Material* material;
    Vec normal;   ///< unit, on the viewer's side
    Vec viewer;   ///< unit direction to the viewer
    double here;  ///< index of refraction on the viewer's side, and beyond
    double beyond;
};

/// Where a path goes on and what the radiance from there counts.
struct Scattering {
    Vec out;
    Vec weight;
    bool lost = false;
};

/// Works out what needs an integral: how much even light enters the coat.
void finishMaterial(Material& material);

/// BSDF for light from the unit direction `light`, of all but mirror directions.
Vec roughBsdf(const RoughSurface& surface, Vec light);

/// A direction and its weight, all lobes included; `uniform` gives numbers in [0,1).
Scattering roughSample(const RoughSurface& surface, const std::function<double()>& uniform);

}  // namespace textbook
