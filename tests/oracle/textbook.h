// A path tracer out of the textbooks: double precision, every primitive tried for every ray, one
// recursive function for radiance. It is a witness for the real one, so it shares no line with it:
// nothing of shaders/ or host/ is included here. Obviously right comes before fast.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace textbook {

struct Vec {
    double x = 0, y = 0, z = 0;
};

/// Colours are linear Rec. 709; lengths in metres, angles in radians.
struct Material {
    enum Kind {
        lambert,
        mirror,
        dielectric,
        conductor,
        report,
        roughConductor,
        roughDielectric,
        thinPane,
        plastic,
        metallicRoughness
    };
    Kind kind = lambert;
    Vec baseColor;     ///< reflectance; of a dielectric the tint of what it transmits
    Vec emission;      ///< radiance on both sides
    double eta = 1.5;  ///< index of refraction behind the surface
    Vec conductorEta;  ///< complex index conductorEta + i conductorK
    Vec conductorK;
    double diffuseWeight = 0;  ///< of the report's material
    double specularWeight = 0;
    double alpha = 0;  ///< width of GGX
    double metallic = 0;
    double transmission = 0;  ///< of metallicRoughness: share of its base that is a thin wall
    double entering = 1;      ///< share of even light that enters the coat: finishMaterial sets it
};

/// Seen counter-clockwise from the front.
struct Triangle {
    Vec corner[3];
    bool smooth = false;
    Vec normal[3];  ///< unit, at the corners, if smooth
    size_t material = 0;
};

/// Its front is the outside.
struct Sphere {
    Vec centre;
    double radius = 1;
    size_t material = 0;
};

/// A sphere after an affine map p = x q.x + y q.y + z q.z + origin of its points q: an ellipsoid.
struct PlacedSphere {
    Sphere sphere;
    Vec x, y, z;
    Vec origin;
};

struct Light {
    enum Kind { point, spot, directional };
    Kind kind = point;
    Vec position;
    Vec direction;        ///< unit, the way the light goes
    Vec strength;         ///< radiant intensity; directional: irradiance when facing it
    double cosOuter = 0;  ///< spot: a smooth step from nothing at the outer angle
    double cosInner = 1;  ///< to full intensity at the inner one
};

/// Light from infinitely far away. A direction d is looked up at (axis[0].d, axis[1].d, axis[2].d)
/// with +Y up and -Z in the centre of the picture.
struct Probe {
    int width = 0, height = 0;  ///< 0: black
    bool angular = false;       ///< Debevec's angular map rather than latitude and longitude
    bool bilinear = false;      ///< between the texels' centres, else the texel that is met
    Vec axis[3];
    std::vector<Vec> texels;  ///< top row first
};

struct Camera {
    bool orthographic = false;
    Vec eye, forward, right, down;  ///< all but eye unit
    double halfWidth = 1;           ///< of the picture: tangents; orthographic: metres
    double halfHeight = 1;
    double lensRadius = 0;
    double focusDistance = 1;  ///< along forward
};

struct World {
    std::vector<Triangle> triangles;
    std::vector<Sphere> spheres;
    std::vector<PlacedSphere> placedSpheres;
    std::vector<Material> materials;
    std::vector<Light> lights;
    Probe environment;  ///< lights the scene
    Probe background;   ///< seen by camera rays that meet nothing
    Camera camera;
    int width = 0, height = 0;  ///< [pixels]
    int bounces = 0;            ///< most scatterings of a path; light is still seen after the last
};

/// Sums over the samples of one pixel.
struct Pixel {
    Vec sum;           ///< of radiance
    double sumY2 = 0;  ///< of squared luminance
    int samples = 0;
};

double luminance(const Vec& colour);

/// The picture, top row first: `samples` independent paths through random points of every pixel.
std::vector<Pixel> render(const World& world, int samples, uint64_t seed, unsigned threads);

}  // namespace textbook
