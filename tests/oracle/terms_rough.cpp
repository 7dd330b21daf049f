// Scenes for the rough and the layered materials.
#include "oracle/terms.h"
#include "oracle/terms_parts.h"
#include "scene/plastic.h"

namespace sahl::testing {
namespace {

/// Two walls of a poor metal, whose reflectance of about a third moves by as much as its index does.
Scene roughConductor()
{
    Scene scene = corner(MATERIAL_ROUGH_CONDUCTOR, 3);
    scene.materials[0].conductorEta = {3.0f, 3.5f, 2.5f};
    scene.materials[0].conductorK = {1.0f, 0.7f, 1.3f};
    scene.materials[0].roughness = 0.5f;
    addLight(scene, LIGHT_POINT, {3, 3, 3}).position = {1, 2, 2};
    return scene;
}

void scaleConductor(Scene& scene, float by)
{
    scene.materials[0].conductorEta *= 1 + by;
    scene.materials[0].conductorK *= 1 + by;
}

/// So rough that a good part of the light meets more than one facet and is lost.
Scene roughConductorLoses()
{
    Scene scene = roughConductor();
    scene.materials[0].roughness = 0.9f;
    return scene;
}

void scaleRoughness(Scene& scene, float by)
{
    for (Material& material : scene.materials) material.roughness *= 1 + by;
}

/// A frosted ball before a black background, with a lamp behind it.
Scene frostedGlass()
{
    Scene scene = scene32(6);
    Material& glass = addMaterialOf(scene, MATERIAL_ROUGH_DIELECTRIC, {0.95f, 0.9f, 0.8f}, 1.5f);
    glass.roughness = 0.5f;
    addSphere(scene, {0, 0, 0}, 1);
    setSky(scene);
    addLight(scene, LIGHT_POINT, {4, 4, 4}).position = {1, 1, -3};
    lookFrom(scene, {0, 0.5, 4}, {0, 0, 0}, 30);
    return scene;
}

/// Frosted water over shining ground: all light has gone from the denser medium to the other.
Scene lampUnderFrost()
{
    Scene scene = scene32(4);
    addMaterialOf(scene, MATERIAL_ROUGH_DIELECTRIC, vec3(1), 1.33f).roughness = 0.4f;
    addLevel(scene, 0, 50);
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0)).emission = {3, 4, 5};
    addLevel(scene, -1, 50);
    lookFrom(scene, {0, 2, 2}, {0, 0, 0}, 40);
    return scene;
}

/// A pane before a bright sky, seen at a slant.
Scene pane()
{
    Scene scene = scene32(2);
    addMaterialOf(scene, MATERIAL_THIN_DIELECTRIC, {0.9f, 0.8f, 0.7f}, 1.5f);
    addRectangle(scene, {-20, -20, 0}, {40, 0, 0}, {0, 40, 0});
    setSky(scene);
    lookFrom(scene, {3, 1, 2}, {0, 0.5, 0}, 40);
    return scene;
}

/// Only the sky above is bright and only what the pane reflects sees it.
Scene paneReflects()
{
    Scene scene = scene32(2);
    addMaterialOf(scene, MATERIAL_THIN_DIELECTRIC, vec3(1), 1.5f);
    addLevel(scene, 0, 50);
    scene.probe = addHalves(scene, {1, 1.1f, 0.9f}, vec3(0));
    scene.background = blackProbe();
    lookFrom(scene, {0, 1.5, 3}, {0, 0, 0}, 20);
    return scene;
}

Scene plasticOf(float roughness)
{
    Scene scene = corner(MATERIAL_PLASTIC, 3);
    scene.materials[0].eta = 1.5f;
    scene.materials[0].roughness = roughness;
    completePlastic(scene.materials[0]);
    addLight(scene, LIGHT_POINT, {2, 2, 2}).position = {1, 2, 2};
    return scene;
}

Scene smoothPlastic()
{
    return plasticOf(0);
}

Scene roughPlastic()
{
    return plasticOf(0.5f);
}

/// glTF's, half metal.
Scene paint()
{
    Scene scene = corner(MATERIAL_METALLIC_ROUGHNESS, 3);
    scene.materials[0].eta = 1.5f;
    scene.materials[0].roughness = 0.5f;
    scene.materials[0].metallic = 0.4f;
    addLight(scene, LIGHT_POINT, {2, 2, 2}).position = {1, 2, 2};
    return scene;
}

Scene lacquer()
{
    Scene scene = paint();
    scene.materials[0].roughness = 0;
    scene.materials[0].metallic = 0;
    return scene;
}

/// A ball of paper that a lamp and the sky shine through.
Scene thinWall()
{
    Scene scene = frostedGlass();
    Material& wall = scene.materials[0];
    wall.type = MATERIAL_METALLIC_ROUGHNESS;
    wall.roughness = 0.5f;
    wall.metallic = 0.1f;
    wall.transmission = 0.8f;
    return scene;
}


}  // namespace

std::vector<Term> roughTerms()
{
    return {
        {"roughConductor", roughConductor, scaleConductor, "complex index"},
        {"roughConductorLoses", roughConductorLoses, scaleRoughness, "roughness"},
        {"frostedGlass", frostedGlass, scaleBaseColors, "tint"},
        {"lampUnderFrost", lampUnderFrost, scaleEtas, "index"},
        {"pane", pane, scaleBaseColors, "tint"},
        {"paneReflects", paneReflects, scaleEtas, "index"},
        {"smoothPlastic", smoothPlastic, scaleBaseColors, "reflectance of the base"},
        {"roughPlastic", roughPlastic, scaleBaseColors, "reflectance of the base"},
        {"paint", paint, scaleBaseColors, "base colour"},
        {"lacquer", lacquer, scaleBaseColors, "base colour"},
        {"thinWall", thinWall, scaleBaseColors, "base colour"},
    };
}

}  // namespace sahl::testing
