// What the phong integrator needs of a scene: its settings, lights and materials.
#pragma once

#include "scene/scene.h"

#include <span>
#include <string_view>

namespace sahl {

/// The terms of the phong integrator by name, in the order in which the report adds them.
struct PhongTerm {
    const char* name;
    uint32_t bit;  ///< one of SHADING_*
};
std::span<const PhongTerm> phongTerms();

constexpr float DEFAULT_SHININESS = 50;
constexpr double MAX_SHININESS = 1e6;

/// Sets the phong values of a material from what it is to the path integrator:
///   ambientColor   baseColor; of a metal its reflectance at right angles
///   specularColor  of lambert none; of a mirror baseColor; of a metal its reflectance at right
///                  angles; of glass white; of the report's material its specular weight
///   shininess      DEFAULT_SHININESS
void setPhongDefaults(Material& material);

/// Sets integrator, terms, shadows and normals where the command line gave them.
void applyShadingOptions(RenderSettings& settings, const SceneOptions& options);

/// Adds a directional light from above the camera's left shoulder, under which a white surface that
/// faces it has radiance 1.
void addHeadLight(Scene& scene);

/// Warns about a scene of which the phong integrator shows little or nothing.
void warnAboutDarkPhong(const Scene& scene);

}  // namespace sahl
