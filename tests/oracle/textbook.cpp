#include "oracle/textbook_parts.h"
#include "oracle/textbook_rough.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <random>
#include <thread>

namespace textbook {
namespace {

/// Solves origin + t direction = (1 - b - c) A + b B + c C by Cramer's rule.
void intersect(const Ray& ray, const Triangle& triangle, Hit& hit)
{
    Vec ab = triangle.corner[1] - triangle.corner[0];
    Vec ac = triangle.corner[2] - triangle.corner[0];
    Vec toOrigin = ray.origin - triangle.corner[0];
    double determinant = dot(ab, cross(ray.direction, ac));
    if (determinant == 0) return;
    double b = dot(toOrigin, cross(ray.direction, ac)) / determinant;
    double c = dot(ray.direction, cross(toOrigin, ab)) / determinant;
    double t = dot(ac, cross(toOrigin, ab)) / determinant;
    if (b < 0 || c < 0 || b + c > 1 || t < TINY || t > hit.t) return;
    hit.t = t;
    hit.front = normalized(cross(ab, ac));
    hit.shading = hit.front;
    hit.material = triangle.material;
    if (triangle.smooth) {
        const Vec* n = triangle.normal;
        hit.shading = normalized(n[0] * (1 - b - c) + n[1] * b + n[2] * c);
    }
}

/// Solves |origin + t direction - centre|^2 = radius^2, a quadratic equation in t.
void intersect(const Ray& ray, const Sphere& sphere, Hit& hit)
{
    Vec arm = ray.origin - sphere.centre;
    double p = dot(arm, ray.direction);
    double q = dot(arm, arm) - sphere.radius * sphere.radius;
    double discriminant = p * p - q;
    if (discriminant < 0) return;
    for (double t : {-p - std::sqrt(discriminant), -p + std::sqrt(discriminant)}) {
        if (t < TINY || t > hit.t) continue;
        hit.t = t;
        hit.front = normalized(arm + ray.direction * t);
        hit.shading = hit.front;
        hit.material = sphere.material;
    }
}

/// Solves x a + y b + z c = v by Cramer's rule for (a, b, c).
Vec coordinates(Vec x, Vec y, Vec z, Vec v)
{
    double volume = dot(x, cross(y, z));
    return {dot(v, cross(y, z)) / volume, dot(x, cross(v, z)) / volume,
            dot(x, cross(y, v)) / volume};
}

/// The sphere's equation for the ray as it is before the map; the map keeps t. A normal n becomes
/// the m with m . (M q) = n . q for all q, whose components are the coordinates' transposed.
void intersect(const Ray& ray, const PlacedSphere& placed, Hit& hit)
{
    Vec from = coordinates(placed.x, placed.y, placed.z, ray.origin - placed.origin);
    Vec way = coordinates(placed.x, placed.y, placed.z, ray.direction);
    Vec arm = from - placed.sphere.centre;
    double a = dot(way, way);
    double p = dot(arm, way);
    double q = dot(arm, arm) - placed.sphere.radius * placed.sphere.radius;
    double discriminant = p * p - a * q;
    if (discriminant < 0) return;
    for (double t : {(-p - std::sqrt(discriminant)) / a, (-p + std::sqrt(discriminant)) / a}) {
        if (t < TINY || t > hit.t) continue;
        Vec n = arm + way * t;
        Vec m = cross(placed.y, placed.z) * n.x + cross(placed.z, placed.x) * n.y +
                cross(placed.x, placed.y) * n.z;
        bool mirrors = dot(placed.x, cross(placed.y, placed.z)) < 0;
        hit.t = t;
        hit.front = normalized(mirrors ? -m : m);
        hit.shading = hit.front;
        hit.material = placed.sphere.material;
    }
}

}  // namespace

Hit closestHit(const World& world, const Ray& ray)
{
    Hit hit;
    for (const Triangle& triangle : world.triangles) intersect(ray, triangle, hit);
    for (const Sphere& sphere : world.spheres) intersect(ray, sphere, hit);
    for (const PlacedSphere& sphere : world.placedSpheres) intersect(ray, sphere, hit);
    return hit;
}

namespace {

Vec texelAt(const Probe& probe, int x, int y)
{
    // Longitude goes round; everywhere else the picture ends with its last texel.
    x = probe.angular ? std::clamp(x, 0, probe.width - 1) : (x + probe.width) % probe.width;
    y = std::clamp(y, 0, probe.height - 1);
    return probe.texels[static_cast<size_t>(y * probe.width + x)];
}

/// Debevec's mappings; u goes right and v down.
Vec lookUp(const Probe& probe, Vec direction)
{
    if (probe.height == 0) return {};
    Vec d = {dot(probe.axis[0], direction), dot(probe.axis[1], direction),
             dot(probe.axis[2], direction)};
    double u, v;
    if (probe.angular) {
        double r = std::acos(std::clamp(-d.z, -1.0, 1.0)) / pi;  // 0 in the centre, 1 at the rim
        double around = std::atan2(d.y, d.x);
        u = (1 + r * std::cos(around)) / 2;
        v = (1 - r * std::sin(around)) / 2;
    } else {
        u = 0.5 + std::atan2(d.x, -d.z) / (2 * pi);
        v = std::acos(std::clamp(d.y, -1.0, 1.0)) / pi;
    }
    double x = u * probe.width;
    double y = v * probe.height;
    if (!probe.bilinear) {
        return texelAt(probe, static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y)));
    }
    int left = static_cast<int>(std::floor(x - 0.5));
    int top = static_cast<int>(std::floor(y - 0.5));
    double right = x - 0.5 - left;  // share of the right neighbour
    double below = y - 0.5 - top;
    return texelAt(probe, left, top) * ((1 - right) * (1 - below)) +
           texelAt(probe, left + 1, top) * (right * (1 - below)) +
           texelAt(probe, left, top + 1) * ((1 - right) * below) +
           texelAt(probe, left + 1, top + 1) * (right * below);
}

}  // namespace

/// Complex throughout: beyond the critical angle cos(thetaT) is imaginary and both
/// amplitudes have modulus 1; metals have complex n2. Born and Wolf, "Principles of Optics", 1.5.2.
double reflectance(double thetaI, std::complex<double> n1, std::complex<double> n2)
{
    double cosI = std::cos(thetaI);
    std::complex<double> sinT = n1 / n2 * std::sin(thetaI);
    std::complex<double> cosT = std::sqrt(1.0 - sinT * sinT);
    std::complex<double> perpendicular = (n1 * cosI - n2 * cosT) / (n1 * cosI + n2 * cosT);
    std::complex<double> parallel = (n2 * cosI - n1 * cosT) / (n2 * cosI + n1 * cosT);
    return (std::norm(perpendicular) + std::norm(parallel)) / 2;
}

namespace {

/// One surface point with the normals turned to the side that the ray came from.
struct Surface {
    Vec point;
    Vec from;  ///< unit, the way the ray goes that came here
    Vec geometric;
    Vec shading;
    bool fromFront;
    const Material* material;
};

/// Follows the paths of one pixel.
class Tracer {
public:
    Tracer(const World& world, uint64_t seed) : world_(world), generator_(seed) {}

    Vec samplePixel(int x, int y)
    {
        double acrossX = (x + uniform()) / world_.width * 2 - 1;
        double acrossY = (y + uniform()) / world_.height * 2 - 1;
        return radiance(cameraRay(acrossX, acrossY), 0, 1);
    }

private:
    double uniform() { return std::uniform_real_distribution<double>(0, 1)(generator_); }

    Ray cameraRay(double acrossX, double acrossY)
    {
        const Camera& camera = world_.camera;
        Vec across = camera.right * (acrossX * camera.halfWidth) +
                     camera.down * (acrossY * camera.halfHeight);
        if (camera.orthographic) return {camera.eye + across, camera.forward};
        // A thin lens sends all rays of a point of the picture through one point in focus.
        Vec inFocus = camera.eye + (camera.forward + across) * camera.focusDistance;
        double a, b;
        do {
            a = 2 * uniform() - 1;
            b = 2 * uniform() - 1;
        } while (a * a + b * b > 1);
        Vec onLens = camera.eye + (camera.right * a + camera.down * b) * camera.lensRadius;
        return {onLens, normalized(inFocus - onLens)};
    }

    /// Radiance that arrives against the ray.
    ///   scatterings  how often the path was scattered before
    ///   medium       index of refraction in which it goes, by the report's rule
    Vec radiance(const Ray& ray, int scatterings, double medium)
    {
        Hit hit = closestHit(world_, ray);
        if (hit.t == INFINITE) {
            return lookUp(scatterings == 0 ? world_.background : world_.environment, ray.direction);
        }
        const Material& material = world_.materials[hit.material];
        if (scatterings == world_.bounces) return material.emission;

        Surface surface;
        surface.point = ray.origin + ray.direction * hit.t;
        surface.from = ray.direction;
        surface.fromFront = dot(hit.front, ray.direction) <= 0;
        surface.geometric = surface.fromFront ? hit.front : -hit.front;
        bool sameSide = dot(hit.shading, surface.geometric) >= 0;
        surface.shading = sameSide ? hit.shading : -hit.shading;
        surface.material = &material;
        return material.emission + scattered(surface, scatterings + 1, medium);
    }

    /// Radiance that the surface sends back along the path; `scatterings` counts this one.
    Vec scattered(const Surface& surface, int scatterings, double medium)
    {
        const Material& material = *surface.material;
        switch (material.kind) {
        case Material::lambert:
            return directLight(surface, 1) + diffuse(surface, scatterings, medium);
        case Material::mirror:
            return material.baseColor * reflection(surface, scatterings, medium);
        case Material::conductor:
            return metallic(surface, scatterings, medium);
        case Material::dielectric: {
            double here = surface.fromFront ? 1 : material.eta;
            double beyond = surface.fromFront ? material.eta : 1;
            // A narrower cone carries the same power in the denser medium: L / n^2 is constant.
            Vec tint = material.baseColor * (here * here / (beyond * beyond));
            return reflectOrRefract(surface, here, beyond, tint, scatterings, medium);
        }
        case Material::report:
            return reportMaterial(surface, scatterings, medium);
        case Material::thinPane:
            return throughPane(surface, scatterings, medium);
        case Material::roughConductor:
        case Material::roughDielectric:
        case Material::plastic:
        case Material::metallicRoughness:
            return rough(surface, scatterings, medium);
        }
        return {};
    }

    /// The report's material: a diffuse part and a dielectric part, each with a weight. A surface
    /// of the index in which the path is leads out into vacuum; radiance is not scaled.
    Vec reportMaterial(const Surface& surface, int scatterings, double medium)
    {
        const Material& material = *surface.material;
        double weight = material.diffuseWeight + material.specularWeight;
        Vec lit = directLight(surface, material.diffuseWeight);
        if (uniform() * weight < material.diffuseWeight) {
            return lit + diffuse(surface, scatterings, medium) * weight;
        }
        double beyond = material.eta == medium ? 1 : material.eta;
        return lit +
               reflectOrRefract(surface, medium, beyond, {1, 1, 1}, scatterings, medium) * weight;
    }

    /// A pane of glass with light going to and fro between its faces until it leaves.
    Vec throughPane(const Surface& surface, int scatterings, double medium)
    {
        const double r = reflectance(angleOfIncidence(surface), 1, surface.material->eta);
        if (uniform() < r) return reflection(surface, scatterings, medium);
        for (;;) {
            if (uniform() >= r) {
                return surface.material->baseColor *
                       radiance({surface.point, surface.from}, scatterings, medium);
            }
            if (uniform() >= r) return reflection(surface, scatterings, medium);
        }
    }

    Vec rough(const Surface& surface, int scatterings, double medium)
    {
        const Material& material = *surface.material;
        const double here = surface.fromFront ? 1 : material.eta;
        const bool glass = material.kind == Material::roughDielectric;
        const RoughSurface s = {&material, mirrorNormal(surface), -surface.from,
                                glass ? here : 1,
                                glass ? material.eta / here : material.eta};
        Vec sum;
        for (const Light& light : world_.lights) {
            const Arrival arrival = arrivalOf(light, surface.point);
            const double cosine = dot(arrival.toLight, s.normal);
            if (cosine * dot(arrival.toLight, surface.geometric) <= 0) continue;
            if (isShadowed(surface.point, arrival)) continue;
            sum = sum + roughBsdf(s, arrival.toLight) * arrival.irradiance * std::abs(cosine);
        }
        const Scattering go = roughSample(s, [this] { return uniform(); });
        if (go.lost || dot(go.out, s.normal) * dot(go.out, surface.geometric) <= 0) return sum;
        return sum + go.weight * radiance({surface.point, go.out}, scatterings, medium);
    }

    /// Light of a lamp on a surface that faces it.
    struct Arrival {
        Vec toLight;
        double distance;
        Vec irradiance;
    };

    static Arrival arrivalOf(const Light& light, Vec point)
    {
        if (light.kind == Light::directional) return {-light.direction, INFINITE, light.strength};
        const Vec way = light.position - point;
        const double distance = length(way);
        Arrival arrival = {normalized(way), distance, light.strength * (1 / (distance * distance))};
        if (light.kind == Light::spot) {
            double range = light.cosInner - light.cosOuter;
            double beyondOuter = dot(-arrival.toLight, light.direction) - light.cosOuter;
            double s = std::clamp(beyondOuter / range, 0.0, 1.0);
            arrival.irradiance = arrival.irradiance * (s * s * (3 - 2 * s));
        }
        return arrival;
    }

    bool isShadowed(Vec point, const Arrival& arrival) const
    {
        return closestHit(world_, {point, arrival.toLight}).t < arrival.distance - TINY;
    }

    /// Light of all lamps that reaches a diffuse surface and leaves it towards the path.
    Vec directLight(const Surface& surface, double share)
    {
        Vec sum;
        for (const Light& light : world_.lights) {
            const Arrival arrival = arrivalOf(light, surface.point);
            double cosine = dot(arrival.toLight, surface.shading);
            if (cosine <= 0 || dot(arrival.toLight, surface.geometric) <= 0) continue;
            if (isShadowed(surface.point, arrival)) continue;
            Vec irradiance = arrival.irradiance * cosine;
            sum = sum + surface.material->baseColor * irradiance * (share / pi);
        }
        return sum;
    }

    /// Lambert's law: a direction with density cosine / pi, which a unit normal plus a point on the
    /// unit sphere has.
    Vec diffuse(const Surface& surface, int scatterings, double medium)
    {
        double height = 2 * uniform() - 1;
        double angle = 2 * pi * uniform();
        double r = std::sqrt(1 - height * height);
        Vec onSphere = {r * std::cos(angle), r * std::sin(angle), height};
        Vec out = normalized(surface.shading + onSphere);
        if (dot(out, surface.geometric) <= 0) return {};
        return surface.material->baseColor * radiance({surface.point, out}, scatterings, medium);
    }

    /// The normal that mirrors: the interpolated one, unless it is turned away from the ray.
    static Vec mirrorNormal(const Surface& surface)
    {
        return dot(surface.shading, surface.from) < 0 ? surface.shading : surface.geometric;
    }

    static double angleOfIncidence(const Surface& surface)
    {
        return std::acos(std::clamp(-dot(mirrorNormal(surface), surface.from), 0.0, 1.0));
    }

    Vec reflection(const Surface& surface, int scatterings, double medium)
    {
        Vec n = mirrorNormal(surface);
        Vec out = normalized(surface.from - n * (2 * dot(surface.from, n)));
        if (dot(out, surface.geometric) <= 0) return {};
        return radiance({surface.point, out}, scatterings, medium);
    }

    Vec metallic(const Surface& surface, int scatterings, double medium)
    {
        const Material& m = *surface.material;
        double theta = angleOfIncidence(surface);
        Vec r = {reflectance(theta, 1, {m.conductorEta.x, m.conductorK.x}),
                 reflectance(theta, 1, {m.conductorEta.y, m.conductorK.y}),
                 reflectance(theta, 1, {m.conductorEta.z, m.conductorK.z})};
        return r * reflection(surface, scatterings, medium);
    }

    /// One of the two rays that a smooth surface between two indices makes, by Fresnel's equations.
    Vec reflectOrRefract(const Surface& surface, double here, double beyond, Vec tint,
                         int scatterings, double medium)
    {
        double thetaI = angleOfIncidence(surface);
        if (uniform() < reflectance(thetaI, here, beyond)) {
            return reflection(surface, scatterings, medium);
        }
        // Snell's law; the tangent along which the ray runs lies in the plane of incidence.
        double sinT = here / beyond * std::sin(thetaI);
        if (sinT >= 1) return {};
        double thetaT = std::asin(sinT);
        Vec n = mirrorNormal(surface);
        Vec along = surface.from - n * dot(surface.from, n);
        Vec tangent = length(along) > 0 ? normalized(along) : along;
        Vec out = normalized(tangent * std::sin(thetaT) - n * std::cos(thetaT));
        if (dot(out, surface.geometric) >= 0) return {};
        return tint * radiance({surface.point, out}, scatterings, beyond);
    }

    const World& world_;
    std::mt19937_64 generator_;
};

}  // namespace

double luminance(const Vec& colour)
{
    return 0.2126 * colour.x + 0.7152 * colour.y + 0.0722 * colour.z;
}

std::vector<Pixel> render(const World& world, int samples, uint64_t seed, unsigned threads)
{
    std::vector<Pixel> picture(static_cast<size_t>(world.width * world.height));
    auto renderPixel = [&](size_t index) {
        Tracer tracer(world, seed * picture.size() + index);
        int x = static_cast<int>(index) % world.width;
        int y = static_cast<int>(index) / world.width;
        Pixel& pixel = picture[index];
        for (int i = 0; i < samples; i++) {
            Vec sample = tracer.samplePixel(x, y);
            pixel.sum = pixel.sum + sample;
            pixel.sumY2 += luminance(sample) * luminance(sample);
        }
        pixel.samples = samples;
    };
    std::vector<std::thread> workers;
    for (unsigned worker = 0; worker < threads; worker++) {
        workers.emplace_back([&, worker] {
            for (size_t i = worker; i < picture.size(); i += threads) renderPixel(i);
        });
    }
    for (std::thread& worker : workers) worker.join();
    return picture;
}

}  // namespace textbook
