// What a surface of microfacets reflects, by integration over the microfacets in double precision: a
// witness for the path tracer's sampling that shares no line with it.
#pragma once

#include <functional>

namespace textbook {

/// Light that leaves after one reflection, of all that arrives from (or goes to) one direction.
///   cosine   of that direction with the surface's normal, > 0
///   alpha    width of the GGX distribution, > 0
///   fresnel  reflectance of a microfacet by the cosine of incidence on it; 1 for a white furnace
double microfacetAlbedo(double cosine, double alpha, const std::function<double(double)>& fresnel);

}  // namespace textbook
