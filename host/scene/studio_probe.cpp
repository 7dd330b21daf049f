// The procedural light of scenes that bring none. Everything in it is large and soft, so that
// a picture is quiet after few samples.
#include "scene/angles.h"
#include "scene/probe.h"
#include "scene/soft_edges.h"

#include <cmath>

namespace sahl {

namespace {

using glm::dvec3;

/// A softbox: a rectangle of directions around `center` whose edges fade.
struct Softbox {
    dvec3 center;      ///< unit direction to its middle
    double halfWidth;  ///< tangents of half its angles of view
    double halfHeight;
    double fade;     ///< width of the soft edge, in tangents
    dvec3 radiance;  ///< in the middle [W m^-2 sr^-1]
};

dvec3 directionTo(double azimuthDeg, double elevationDeg)
{
    // Azimuth from -Z (the middle of the picture) towards +X.
    double horizontal = cosDeg(elevationDeg);
    return {horizontal * sinDeg(azimuthDeg), sinDeg(elevationDeg),
            -horizontal * cosDeg(azimuthDeg)};
}

double coverage(const Softbox& box, const dvec3& d)
{
    double depth = glm::dot(d, box.center);
    if (depth <= 0) return 0;
    dvec3 side = glm::cross(box.center, dvec3(0, 1, 0));
    side = side / std::sqrt(glm::dot(side, side));
    dvec3 up = glm::cross(side, box.center);
    double x = std::abs(glm::dot(d, side)) / depth;
    double y = std::abs(glm::dot(d, up)) / depth;
    return (1 - smoothStep(box.halfWidth - box.fade, box.halfWidth + box.fade, x)) *
           (1 - smoothStep(box.halfHeight - box.fade, box.halfHeight + box.fade, y));
}

/// Walls and ceiling: a gradient from the horizon up. Floor: lit from above, darker towards the
/// nadir.
dvec3 room(const dvec3& d)
{
    const dvec3 horizon(0.34, 0.35, 0.365), zenith(0.17, 0.185, 0.215);
    const dvec3 floorFar(0.29, 0.28, 0.265), floorNear(0.17, 0.16, 0.147);
    if (d.y >= 0) return horizon + (zenith - horizon) * smoothStep(0, 0.9, d.y);
    dvec3 floor = floorFar + (floorNear - floorFar) * smoothStep(0, 0.8, -d.y);
    return horizon + (floor - horizon) * smoothStep(0, 0.12, -d.y);
}

dvec3 studioRadiance(const dvec3& d)
{
    // Seen by a camera that looks along -Z: key from the upper left in front, fill from the right,
    // a strip behind the subject, and a large scoop overhead.
    static const std::array<Softbox, 4> boxes = {{
        {directionTo(-114, 46), 0.95, 0.80, 0.28, dvec3(2.35, 2.16, 1.90)},
        {directionTo(112, 22), 0.55, 0.60, 0.25, dvec3(0.35, 0.43, 0.55)},
        {directionTo(28, 38), 0.55, 0.22, 0.12, dvec3(1.1, 1.18, 1.3)},
        {directionTo(180, 80), 0.60, 0.60, 0.30, dvec3(0.35, 0.36, 0.38)},
    }};
    dvec3 sum = room(d);
    for (const Softbox& box : boxes) sum += box.radiance * coverage(box, d);
    return sum;
}

}  // namespace

Image makeStudioProbe(uint32_t width, uint32_t height)
{
    Image image{width, height, {}};
    image.rgb.reserve(size_t{3} * width * height);
    for (uint32_t y = 0; y < height; y++) {
        double elevation = 90 - 180 * (y + 0.5) / height;
        for (uint32_t x = 0; x < width; x++) {
            double azimuth = 360 * (x + 0.5) / width - 180;
            dvec3 radiance = studioRadiance(directionTo(azimuth, elevation));
            for (int k = 0; k < 3; k++) image.rgb.push_back(static_cast<float>(radiance[k]));
        }
    }
    return image;
}

}  // namespace sahl
