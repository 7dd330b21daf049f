// Scenes for the terms of the phong integrator. In each, its term gives most of the light.
#include "oracle/terms.h"
#include "oracle/terms_parts.h"

namespace sahl::testing {
namespace {

/// A floor and a wall of one material, a ball and a coarse ball of smooth triangles of another.
Scene room(uint32_t shading)
{
    Scene scene = scene32(0);
    scene.settings.integrator = INTEGRATOR_PHONG;
    scene.settings.jitter = false;
    scene.settings.shading = shading;
    scene.probe = blackProbe();
    Material& matt = addMaterialOf(scene, MATERIAL_LAMBERT, {0.7f, 0.6f, 0.5f});
    matt.ambientColor = {0.5f, 0.6f, 0.7f};
    matt.specularColor = {0.3f, 0.2f, 0.25f};
    matt.shininess = 3;
    addRectangle(scene, {-3, 0, -1}, {0, 0, 4}, {6, 0, 0});
    addRectangle(scene, {-3, 0, -1}, {6, 0, 0}, {0, 3, 0});
    Material& shiny = addMaterialOf(scene, MATERIAL_REPORT, {0.2f, 0.5f, 0.9f});
    shiny.diffuseWeight = 0.75f;
    shiny.ambientColor = {0.9f, 0.5f, 0.2f};
    shiny.specularColor = {1, 0.9f, 0.8f};
    shiny.shininess = 40;
    addSphere(scene, {-0.7f, 0.6f, 0.4f}, 0.6f);
    appendShape(scene, makeSphere({0.8, 0.7, 0.6}, 0.7, 1, true), {}, 1, "ball");
    lookFrom(scene, {0.3, 1.7, 4}, {0, 0.8, 0}, 35);
    return scene;
}

Scene withLamp(uint32_t shading)
{
    Scene scene = room(shading);
    addLight(scene, LIGHT_POINT, {9, 10, 11}).position = {1.5f, 2.2f, 3};
    return scene;
}

Scene ambient()
{
    Scene scene = withLamp(SHADING_AMBIENT);
    scene.settings.ambient = {0.4f, 0.3f, 0.2f};
    return scene;
}

Scene diffuse()
{
    return withLamp(SHADING_DIFFUSE);
}

Scene specular()
{
    return withLamp(SHADING_SPECULAR);
}

Scene flatNormals()
{
    return withLamp(SHADING_DIFFUSE | SHADING_SPECULAR | SHADING_FLAT);
}

/// A smooth ball alone, so that every pixel depends on interpolated normals.
Scene interpolatedNormals()
{
    Scene scene = withLamp(SHADING_DIFFUSE | SHADING_SPECULAR);
    scene.primitives.erase(scene.primitives.begin(), scene.primitives.begin() + 5);
    return scene;
}

/// The light comes from the right, past a screen that the camera does not see. The balls throw
/// shadows too.
Scene shadows()
{
    Scene scene = room(SHADING_DIFFUSE | SHADING_SHADOWS);
    addLight(scene, LIGHT_POINT, {9, 10, 11}).position = {2.5f, 1.6f, 1.4f};
    addRectangle(scene, {1.6, 0.9, 0.7}, {0, 0.6, 0}, {0, 0, 0.8});
    return scene;
}

Scene severalLights()
{
    Scene scene = shadows();
    scene.settings.shading |= SHADING_TERMS;
    scene.materials[1].emission = {0.02f, 0.03f, 0.01f};
    addLight(scene, LIGHT_DIRECTIONAL, {2, 1, 1.5f}).direction =
        vec3(glm::normalize(glm::dvec3(0.8, -1, -0.6)));
    Light& spot = addLight(scene, LIGHT_SPOT, {20, 22, 18});
    spot.position = {-1, 2.5f, 3};
    spot.direction = vec3(glm::normalize(glm::dvec3(0.8, -1.6, -2.6)));
    spot.cosOuter = cosineOf(25);
    spot.cosInner = cosineOf(8);
    return scene;
}

void scaleAmbientLight(Scene& scene, float by)
{
    scene.settings.ambient *= 1 + by;
}

void scaleAmbientColors(Scene& scene, float by)
{
    for (Material& material : scene.materials) material.ambientColor *= 1 + by;
}

void scaleSpecularColors(Scene& scene, float by)
{
    for (Material& material : scene.materials) material.specularColor *= 1 + by;
}

void scaleExponents(Scene& scene, float by)
{
    for (Material& material : scene.materials) material.shininess *= 1 + by;
}

void scaleIntensities(Scene& scene, float by)
{
    for (Light& light : scene.lights) light.intensity *= 1 + by;
}

void scaleLastLight(Scene& scene, float by)
{
    scene.lights.back().intensity *= 1 + by;
}

void moveScreen(Scene& scene, float by)
{
    for (size_t i = scene.primitives.size() - 2; i < scene.primitives.size(); i++) {
        Primitive& triangle = scene.primitives[i];
        for (vec3* corner : {&triangle.p0, &triangle.p1, &triangle.p2}) *corner *= 1 + by;
    }
}

void tiltNormals(Scene& scene, float by)
{
    auto tilt = [by](vec3& n) { n = glm::normalize(n + vec3(by, 0, 0)); };
    for (TriangleCorners& normals : scene.triangleCorners) {
        tilt(normals.n0);
        tilt(normals.n1);
        tilt(normals.n2);
    }
}

/// Moves every triangle's normal: the ball becomes flatter.
void flattenBall(Scene& scene, float by)
{
    for (Primitive& primitive : scene.primitives) {
        if (primitive.shape == SHAPE_SPHERE) continue;
        for (vec3* corner : {&primitive.p0, &primitive.p1, &primitive.p2}) corner->y *= 1 - by;
    }
}

}  // namespace

std::vector<Term> phongTerms()
{
    return {
        {"ambientLight", ambient, scaleAmbientLight, "ambient light"},
        {"ambientColor", ambient, scaleAmbientColors, "ambient color"},
        {"diffuse", diffuse, scaleBaseColors, "base color"},
        {"specular", specular, scaleSpecularColors, "specular color"},
        {"exponent", specular, scaleExponents, "exponent"},
        {"intensity", specular, scaleIntensities, "intensity"},
        {"interpolatedNormals", interpolatedNormals, tiltNormals, "normals"},
        {"flatNormals", flatNormals, flattenBall, "shape"},
        {"shadows", shadows, moveScreen, "place of the screen"},
        {"severalLights", severalLights, scaleLastLight, "intensity of the last"},
    };
}

}  // namespace sahl::testing
