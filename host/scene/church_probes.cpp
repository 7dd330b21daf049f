// Two interiors for scenes that show what a light probe does: a dim red cathedral with bright
// windows and lamps, and a warm basilica of stone. Both are round rooms seen from eye height in
// their middle: a floor, a wall of bays, a vault. The apse is where -Z points.
#include "scene/angles.h"
#include "scene/probe.h"
#include "scene/soft_edges.h"

#include <cmath>

namespace sahl {

namespace {

using glm::dvec3;

constexpr double EYE = 1.7;  // above the floor [m]

/// A line of sight, and where in the room it ends.
struct Sight {
    double azimuth;    ///< [degrees] from -Z (the middle of the picture) towards +X
    double elevation;  ///< [degrees]
    double x, z;       ///< on the floor, below the horizon [m]
    double height;     ///< on the wall, above the eye [m]
};

Sight sightOf(double azimuth, double elevation, double roomRadius)
{
    const double level = cosDeg(elevation), rise = sinDeg(elevation);
    const double slope = rise / std::max(level, 1e-9);
    const double distance = slope < 0 ? std::min(EYE / -slope, roomRadius) : roomRadius;
    return {azimuth, elevation, distance * sinDeg(azimuth), -distance * cosDeg(azimuth),
            roomRadius * slope};
}

/// The bay of a wall that an azimuth falls in, counted from the apse, and where in it: -1 to 1.
struct Bay {
    double number;
    double across;
};

Bay bayOf(double azimuth, double widthDeg)
{
    const double number = std::floor(azimuth / widthDeg + 0.5);
    return {number, 2 * (azimuth / widthDeg - number)};
}

/// An opening in a bay: `halfWidth` of the bay's half, from `sill` up to an arch whose top is at
/// `top` and which comes down by `drop` towards its sides.
double arch(const Bay& bay, double height, double halfWidth, double sill, double top, double drop)
{
    const double side = bay.across / halfWidth;
    return softBand(-1, 1, 0.08, side) *
           softBand(sill, top - drop * std::min(side * side, 1.0), 0.25, height);
}

/// A round spot on the sphere of directions; sizes in degrees.
double spot(const Sight& s, double azimuth, double elevation, double radius, double fade)
{
    double turn = std::abs(s.azimuth - azimuth);
    turn = std::min(turn, 360 - turn) * cosDeg(elevation);
    const double rise = s.elevation - elevation;
    return 1 - smoothStep(radius - fade, radius + fade, std::sqrt(turn * turn + rise * rise));
}

/// -1 and 1 in squares of side `size`, smooth where they meet.
double checks(double x, double z, double size)
{
    const double a = sinDeg(180 * x / size), b = sinDeg(180 * z / size);
    return std::clamp(6 * a * b, -1.0, 1.0);
}

dvec3 blend(const dvec3& a, const dvec3& b, double t)
{
    return a + (b - a) * t;
}

dvec3 cathedralFloor(const Sight& s)
{
    dvec3 floor = dvec3(0.055, 0.03, 0.034) * (1 + 0.35 * checks(s.x, s.z, 0.8));
    floor = blend(floor, {0.26, 0.024, 0.016}, softBand(-1.1, 1.1, 0.06, s.x));  // the carpet
    // What the windows throw onto it, from the left.
    const double light = softBand(-1.6, 0.6, 0.3, s.z + 4) * softBand(2.2, 3.6, 0.3, s.x);
    return floor + dvec3(2.6, 1.5, 1.9) * light +
           dvec3(0.5, 0.1, 0.06) * softBand(-9, -6, 1.5, s.z);
}

dvec3 cathedralWall(const Sight& s)
{
    const Bay bay = bayOf(s.azimuth, 20);
    const bool apse = std::abs(bay.number) <= 3 && bay.number != 0;
    const double pier = smoothStep(0.66, 0.78, std::abs(bay.across));
    dvec3 wall = blend(dvec3(0.15, 0.038, 0.026), {0.1, 0.03, 0.024}, smoothStep(0, 14, s.height));
    wall = blend(wall, {0.2, 0.075, 0.05}, pier);
    wall *= 1 - 0.75 * arch(bay, s.height, 0.5, -2, 4.6, 2.2);  // the aisles are dark
    wall += dvec3(0.12, 0.04, 0.02) * softBand(5.1, 5.5, 0.12, s.height);

    const double window = arch(bay, s.height, 0.4, 6.4, 13.2, 2.6);
    const double lead = softBand(-0.05, 0.05, 0.03, bay.across);
    const double tint = checks(bay.across * 3, s.height, 1);
    const dvec3 glass = blend({15, 9.5, 11}, {9, 10.5, 16}, 0.5 + 0.5 * tint);
    wall = blend(wall, glass * (apse ? 1.0 : 0.035), window * (1 - 0.85 * lead));

    const double altar = softBand(-7, 7, 0.5, s.azimuth) * softBand(-1.7, 3.2, 0.3, s.height);
    const double niches = 0.5 + 0.5 * checks(s.azimuth / 2, s.height / 1.1 + 0.5, 1);
    return blend(wall, blend({0.5, 0.13, 0.03}, {2.1, 0.95, 0.24}, niches), altar);
}

dvec3 cathedral(double azimuth, double elevation)
{
    const Sight s = sightOf(azimuth, elevation, 13);
    const Bay ribs = bayOf(azimuth, 20);
    const double rib = smoothStep(0.8, 0.95, std::abs(ribs.across));
    const dvec3 vault =
        dvec3(0.075, 0.024, 0.02) * (1 + 1.6 * rib) * (1 - 0.5 * smoothStep(60, 90, elevation));
    dvec3 sum = elevation < 0 && s.height < -EYE
                    ? cathedralFloor(s)
                    : blend(cathedralWall(s), vault, smoothStep(14.5, 15, s.height));
    // Lamps between the arches, and the rose window in the west.
    for (int lamp = -8; lamp <= 9; lamp++) {
        sum += dvec3(26, 11, 2.6) * spot(s, lamp * 20 - 10, 9, 0.9, 0.5);
    }
    const double rose = spot(s, 180, 34, 12, 1.2);
    const double petals =
        0.5 + 0.5 * sinDeg(18 * (elevation - 34)) * sinDeg(18 * (180 - std::abs(azimuth)));
    return sum + blend({3.4, 0.5, 0.4}, {1.4, 1.6, 4.4}, petals) * rose;
}

dvec3 basilicaFloor(const Sight& s)
{
    const double distance = std::sqrt(s.x * s.x + s.z * s.z);
    const dvec3 pale(0.74, 0.41, 0.28), dark(0.36, 0.17, 0.11);
    dvec3 floor = blend(pale, dark, 0.5 + 0.22 * checks(s.x + s.z, s.x - s.z, 1.6));
    // Rings of darker marble around the middle, and the gloss of the far floor under the apse.
    for (double ring : {2.4, 4.4, 8.0}) {
        floor = blend(floor, dark * 0.7, softBand(ring - 0.2, ring + 0.2, 0.06, distance));
    }
    return floor * (0.75 + 0.35 * smoothStep(2, 12, distance)) +
           dvec3(0.5, 0.3, 0.2) * softBand(-16, -7, 3, s.z) * softBand(-3, 3, 1.4, s.x);
}

dvec3 basilicaWall(const Sight& s)
{
    const Bay bay = bayOf(s.azimuth, 15);
    const double pier = smoothStep(0.5, 0.56, std::abs(bay.across));
    const double fluting =
        sinDeg(2880 * bay.across) * softBand(0.58, 0.94, 0.02, std::abs(bay.across));
    dvec3 wall =
        blend(dvec3(0.42, 0.23, 0.15), dvec3(0.62, 0.38, 0.27) * (1 + 0.12 * fluting), pier);
    wall = blend(wall, {0.07, 0.032, 0.022}, arch(bay, s.height, 0.46, -2, 9.5, 2.6));
    const bool beside = std::abs(std::abs(bay.number) - 1) < 0.5;
    const double window = arch(bay, s.height, 0.22, 3.6, 6.6, 0.8);
    wall = blend(wall, beside ? dvec3(7, 7.6, 9.6) : dvec3(0.42, 0.24, 0.16), window);
    wall = blend(wall, {0.95, 0.6, 0.42}, softBand(11.4, 12.4, 0.2, s.height));  // the cornice

    // The canopy over the altar: 4 dark columns, gold behind them, a lamp.
    const double canopy = softBand(-5, 5, 0.3, s.azimuth) * softBand(-2, 6, 0.3, s.height);
    const double columns = smoothStep(0.5, 0.9, -sinDeg(108 * s.azimuth + 90));
    wall = blend(wall, {0.85, 0.4, 0.12}, 0.8 * canopy);
    wall = blend(wall, {0.05, 0.022, 0.013}, canopy * columns);
    return wall + dvec3(6.5, 2.9, 0.7) * spot(s, 0, 12, 1.5, 0.7);
}

dvec3 basilica(double azimuth, double elevation)
{
    const Sight s = sightOf(azimuth, elevation, 18);
    const double coffer = checks(azimuth / 15 + 0.5, elevation / 6, 1);
    dvec3 dome = blend(dvec3(0.5, 0.3, 0.2), {0.34, 0.19, 0.12}, 0.5 + 0.5 * coffer);
    const Bay bay = bayOf(azimuth, 45);
    dome = blend(dome, {3.4, 3.5, 3.9},
                 softBand(-0.42, 0.42, 0.05, bay.across) * softBand(58, 66, 0.8, elevation));
    dome = blend(dome, {5.2, 5, 4.7}, smoothStep(76, 79, elevation));  // the lantern
    if (elevation < 0 && s.height < -EYE) return basilicaFloor(s);
    return blend(basilicaWall(s), dome, smoothStep(12.8, 13.2, s.height));
}

Image makeProbe(uint32_t width, uint32_t height,
                dvec3 (*radiance)(double azimuth, double elevation))
{
    Image image{width, height, {}};
    image.rgb.reserve(size_t{3} * width * height);
    for (uint32_t y = 0; y < height; y++) {
        const double elevation = 90 - 180 * (y + 0.5) / height;
        for (uint32_t x = 0; x < width; x++) {
            const dvec3 value = radiance(360 * (x + 0.5) / width - 180, elevation);
            for (int k = 0; k < 3; k++) image.rgb.push_back(static_cast<float>(value[k]));
        }
    }
    return image;
}

}  // namespace

Image makeCathedralProbe(uint32_t width, uint32_t height)
{
    return makeProbe(width, height, cathedral);
}

Image makeBasilicaProbe(uint32_t width, uint32_t height)
{
    return makeProbe(width, height, basilica);
}

Image makeBuiltinProbe(const std::string& name)
{
    if (name == "cathedral") return makeCathedralProbe(CHURCH_WIDTH, CHURCH_HEIGHT);
    if (name == "basilica") return makeBasilicaProbe(CHURCH_WIDTH, CHURCH_HEIGHT);
    return makeStudioProbe(STUDIO_WIDTH, STUDIO_HEIGHT);
}

}  // namespace sahl
