// Materials and directions for tests of the path tracer's BSDFs.
#pragma once

#include "reference/kernel.h"
#include "scene/plastic.h"
#include "support/soups.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <ostream>
#include <string>
#include <vector>

namespace sahl::testing {

using Kernel = reference::Kernel<>;
using SurfaceInteraction = Kernel::SurfaceInteraction;
using BsdfSample = Kernel::BsdfSample;

/// One material seen from one direction.
struct BsdfCase {
    std::string name;
    Material material = {};
    bool front = true;
    double degrees = 0;  ///< of wo from the shading normal
    double tilt = 0;     ///< of the shading normal from the geometric one [degrees]
};

inline void PrintTo(const BsdfCase& c, std::ostream* out)
{
    *out << c.name;
}

/// A material of type MATERIAL_* with numbers of its own on every channel.
inline Material roughMaterial(uint type, double alpha, vec3 baseColor = {0.8f, 0.5f, 0.3f})
{
    Material m = {};
    m.type = type;
    m.baseColor = baseColor;
    m.eta = 1.5f;
    m.roughness = static_cast<float>(std::sqrt(alpha));
    m.conductorEta = {0.21f, 0.43f, 1.38f};  // gold
    m.conductorK = {3.272f, 2.455f, 1.914f};
    if (type == MATERIAL_PLASTIC) completePlastic(m);
    return m;
}

inline Material thinWall(double alpha, float metallic, float transmission)
{
    Material m = roughMaterial(MATERIAL_METALLIC_ROUGHNESS, alpha);
    m.metallic = metallic;
    m.transmission = transmission;
    return m;
}

struct NamedMaterial {
    std::string name;
    Material material;
    bool front = true;
};

/// Every material that has a lobe of finite density at this alpha.
inline std::vector<NamedMaterial> finiteMaterials(double alpha)
{
    std::vector<NamedMaterial> all = {
        {"plastic", roughMaterial(MATERIAL_PLASTIC, alpha)},
        {"paint", thinWall(alpha, 0.3f, 0)},
        {"thinWall", thinWall(alpha, 0.1f, 0.7f)},
    };
    if (alpha < 1e-4) return all;
    all.push_back({"gold", roughMaterial(MATERIAL_ROUGH_CONDUCTOR, alpha)});
    all.push_back({"glass", roughMaterial(MATERIAL_ROUGH_DIELECTRIC, alpha)});
    all.push_back({"glassFromInside", roughMaterial(MATERIAL_ROUGH_DIELECTRIC, alpha), false});
    return all;
}

/// A surface whose normal is along no axis.
inline SurfaceInteraction surfaceOf(const BsdfCase& c)
{
    SurfaceInteraction isect = {};
    const glm::dvec3 ns = glm::normalize(glm::dvec3(0.3, 0.8, -0.5));
    const glm::dvec3 side = glm::normalize(glm::cross(ns, glm::dvec3(1, 0, 0)));
    const double tilt = c.tilt * std::numbers::pi / 180;
    isect.ns = vec3(ns);
    isect.ng = vec3(glm::normalize(ns * std::cos(tilt) + side * std::sin(tilt)));
    isect.front = c.front;
    isect.nsStored = c.front ? isect.ns : -isect.ns;
    return isect;
}

/// Unit, at `degrees` from n, `turns` around it.
inline vec3 directionAt(const vec3& n, double degrees, double turns)
{
    const glm::dvec3 axis(n);
    const glm::dvec3 t = glm::normalize(glm::cross(axis, glm::dvec3(0.1, 0.2, 0.9)));
    const glm::dvec3 b = glm::cross(axis, t);
    const double theta = degrees * std::numbers::pi / 180, phi = turns * 2 * std::numbers::pi;
    return vec3(axis * std::cos(theta) +
                (t * std::cos(phi) + b * std::sin(phi)) * std::sin(theta));
}

inline vec3 viewerOf(const BsdfCase& c, const SurfaceInteraction& isect)
{
    return directionAt(isect.ns, c.degrees, 0.3);
}

inline vec4 fourNumbers(Random& random)
{
    const float x = random.uniform(), y = random.uniform(), z = random.uniform();
    return {x, y, z, random.uniform()};
}

/// Cases of every material that has a finite lobe, at these alphas and angles.
inline std::vector<BsdfCase> bsdfCases(const std::vector<double>& alphas,
                                       const std::vector<double>& angles)
{
    std::vector<BsdfCase> cases;
    for (double alpha : alphas) {
        for (const NamedMaterial& m : finiteMaterials(alpha)) {
            for (double degrees : angles) {
                cases.push_back({fmt::format("{}, alpha {:g}, {:g} degrees", m.name, alpha, degrees),
                                 m.material, m.front, degrees});
            }
        }
    }
    return cases;
}

}  // namespace sahl::testing
