// What the textbook tracer's files share: vectors, rays, and what a ray meets.
#pragma once

#include "oracle/textbook.h"

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

namespace textbook {

using std::numbers::pi;
constexpr double INFINITE = std::numeric_limits<double>::infinity();
constexpr double TINY = 1e-8;  ///< [m] hits nearer than this are where the ray started

inline Vec operator+(Vec a, Vec b)
{
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec operator-(Vec a, Vec b)
{
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec operator-(Vec a)
{
    return {-a.x, -a.y, -a.z};
}
inline Vec operator*(Vec a, double s)
{
    return {a.x * s, a.y * s, a.z * s};
}
inline Vec operator*(Vec a, Vec b)
{
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}
inline double dot(Vec a, Vec b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline double length(Vec a)
{
    return std::sqrt(dot(a, a));
}
inline Vec normalized(Vec a)
{
    return a * (1 / length(a));
}
inline Vec cross(Vec a, Vec b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

struct Ray {
    Vec origin;
    Vec direction;  ///< unit
};

/// What a ray meets first.
struct Hit {
    double t = INFINITE;
    Vec front;    ///< unit normal on the surface's front
    Vec shading;  ///< unit normal that stands in for it, interpolated
    size_t material = 0;
};

Hit closestHit(const World& world, const Ray& ray);

/// Fresnel's reflectance for unpolarised light that goes from index n1 to n2 and meets the surface
/// at angle thetaI.
double reflectance(double thetaI, std::complex<double> n1, std::complex<double> n2);

}  // namespace textbook
