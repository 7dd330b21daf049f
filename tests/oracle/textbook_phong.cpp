#include "oracle/textbook_phong.h"

#include "oracle/textbook_parts.h"

#include <algorithm>

namespace textbook {
namespace {

Ray rayThroughCentre(const World& world, int x, int y)
{
    const Camera& camera = world.camera;
    double a = (x + 0.5) / world.width * 2 - 1;
    double b = (y + 0.5) / world.height * 2 - 1;
    Vec across = camera.right * (a * camera.halfWidth) + camera.down * (b * camera.halfHeight);
    if (camera.orthographic) return {camera.eye + across, camera.forward};
    return {camera.eye, normalized(camera.forward + across)};
}

/// Where a light is, and how strongly it lights what faces it.
struct Incoming {
    Vec toLight;      ///< unit
    double distance;  ///< [m]
    Vec irradiance;   ///< of a surface that faces the light
};

Incoming incomingFrom(const Light& light, Vec point)
{
    if (light.kind == Light::directional) return {-light.direction, INFINITE, light.strength};
    Vec way = light.position - point;
    double distance = length(way);
    Vec toLight = normalized(way);
    Vec irradiance = light.strength * (1 / (distance * distance));
    if (light.kind == Light::spot) {
        double cosine = dot(-toLight, light.direction);
        double s = (cosine - light.cosOuter) / (light.cosInner - light.cosOuter);
        s = std::clamp(s, 0.0, 1.0);
        irradiance = irradiance * (3 * s * s - 2 * s * s * s);
    }
    return {toLight, distance, irradiance};
}

/// Whether the point, on a surface with these normals, lies in the shadow of that surface or
/// another.
bool inShadow(const PhongWorld& phong, Vec point, Vec front, Vec normal, const Incoming& light)
{
    Vec outside = dot(front, normal) < 0 ? -front : front;
    if (dot(outside, light.toLight) <= 0) return true;
    return closestHit(phong.world, {point, light.toLight}).t < light.distance - TINY;
}

/// I = ka La + sum over the lights of (kd (n.l) + ks (r.v)^s) E / pi. Phong 1975.
Vec shade(const PhongWorld& phong, const Ray& ray, const Hit& hit)
{
    const PhongMaterial& material = phong.materials[hit.material];
    Vec point = ray.origin + ray.direction * hit.t;
    Vec n = phong.flat ? hit.front : hit.shading;
    Vec v = -ray.direction;
    Vec sum = material.emission;
    if (phong.ambientTerm) sum = sum + material.ambient * phong.ambient;
    for (const Light& source : phong.world.lights) {
        Incoming light = incomingFrom(source, point);
        double cosine = dot(n, light.toLight);
        if (cosine <= 0) continue;
        if (phong.shadows && inShadow(phong, point, hit.front, n, light)) continue;
        Vec radianceOfWhite = light.irradiance * (1 / pi);
        if (phong.diffuseTerm) sum = sum + material.diffuse * radianceOfWhite * cosine;
        if (phong.specularTerm) {
            Vec r = n * (2 * cosine) - light.toLight;
            double lobe = std::pow(std::max(0.0, dot(r, v)), material.exponent);
            sum = sum + material.specular * radianceOfWhite * lobe;
        }
    }
    return sum;
}

}  // namespace

std::vector<Vec> renderPhong(const PhongWorld& phong)
{
    std::vector<Vec> picture;
    for (int y = 0; y < phong.world.height; y++) {
        for (int x = 0; x < phong.world.width; x++) {
            Ray ray = rayThroughCentre(phong.world, x, y);
            Hit hit = closestHit(phong.world, ray);
            picture.push_back(hit.t == INFINITE ? Vec{} : shade(phong, ray, hit));
        }
    }
    return picture;
}

}  // namespace textbook
