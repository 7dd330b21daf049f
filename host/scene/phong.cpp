#include "scene/phong.h"

#include "scene/numbers.h"
#include "util/error.h"
#include "util/messages.h"

#include <algorithm>
#include <numbers>

namespace sahl {

namespace {

bool isDark(const vec3& color)
{
    return !(color.x > 0 || color.y > 0 || color.z > 0);
}

/// Fresnel's equations for light that arrives along the normal, by channel.
vec3 reflectanceAtRightAngles(const Material& metal)
{
    const glm::dvec3 eta(metal.conductorEta), k(metal.conductorK);
    const glm::dvec3 less = eta - 1.0, more = eta + 1.0;
    return toFloat((less * less + k * k) / (more * more + k * k));
}

/// The same for a clear coat.
vec3 coatAtRightAngles(const Material& coat)
{
    const double r = (double{coat.eta} - 1) / (double{coat.eta} + 1);
    return vec3(toFloat(r * r));
}

void setBit(uint32_t& bits, uint32_t bit, bool on)
{
    bits = on ? bits | bit : bits & ~bit;
}

}  // namespace

std::span<const PhongTerm> phongTerms()
{
    static constexpr PhongTerm terms[] = {
        {"ambient", SHADING_AMBIENT}, {"diffuse", SHADING_DIFFUSE}, {"specular", SHADING_SPECULAR}};
    return terms;
}

void setPhongDefaults(Material& material)
{
    material.ambientColor = material.baseColor;
    material.specularColor = vec3(0);
    material.shininess = DEFAULT_SHININESS;
    switch (material.type) {
    case MATERIAL_MIRROR:
        material.specularColor = material.baseColor;
        break;
    case MATERIAL_DIELECTRIC:
    case MATERIAL_ROUGH_DIELECTRIC:
    case MATERIAL_THIN_DIELECTRIC:
        material.specularColor = vec3(1);
        break;
    case MATERIAL_CONDUCTOR:
    case MATERIAL_ROUGH_CONDUCTOR:
        material.ambientColor = material.specularColor = reflectanceAtRightAngles(material);
        break;
    case MATERIAL_REPORT:
        material.specularColor = vec3(material.specularWeight);
        break;
    case MATERIAL_PLASTIC:
        material.specularColor = coatAtRightAngles(material);
        break;
    case MATERIAL_METALLIC_ROUGHNESS:
        material.specularColor =
            glm::mix(coatAtRightAngles(material), material.baseColor, material.metallic);
        break;
    default:
        break;
    }
}

void applyShadingOptions(RenderSettings& settings, const SceneOptions& options)
{
    settings.integrator = options.integrator.value_or(settings.integrator);
    if (options.terms) settings.shading = (settings.shading & ~SHADING_TERMS) | *options.terms;
    if (options.shadows) setBit(settings.shading, SHADING_SHADOWS, *options.shadows);
    if (options.flatNormals) setBit(settings.shading, SHADING_FLAT, *options.flatNormals);
}

void addHeadLight(Scene& scene)
{
    const glm::dvec3 right = glm::normalize(glm::dvec3(scene.camera.right));
    const glm::dvec3 down = glm::normalize(glm::dvec3(scene.camera.down));
    Light light = {};
    light.type = LIGHT_DIRECTIONAL;
    light.direction =
        toFloat(glm::normalize(glm::dvec3(scene.camera.forward) + 0.4 * right + 0.6 * down));
    light.intensity = vec3(std::numbers::pi_v<float>);
    scene.lights.push_back(light);
}

void warnAboutDarkPhong(const Scene& scene)
{
    if (!scene.lights.empty()) return;
    const bool shines = std::any_of(scene.materials.begin(), scene.materials.end(),
                                    [](const Material& m) { return !isDark(m.emission); });
    const bool ambient =
        (scene.settings.shading & SHADING_AMBIENT) != 0 && !isDark(scene.settings.ambient);
    warn(fmt::format("{}: no point, spot or directional light: phong shows {}", scene.name,
                     ambient || shines ? "ambient light and emission alone" : "black shapes"));
}

}  // namespace sahl
