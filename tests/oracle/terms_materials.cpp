// Scenes for the materials.
#include "oracle/terms.h"
#include "oracle/terms_parts.h"

namespace sahl::testing {
namespace {

Scene lambert()
{
    return corner(MATERIAL_LAMBERT, 4);
}

Scene mirror()
{
    return corner(MATERIAL_MIRROR, 4);
}

Scene conductor()
{
    // A poor metal, whose reflectance of about a third moves by as much as its index does.
    Scene scene = corner(MATERIAL_CONDUCTOR, 4);
    scene.materials[0].conductorEta = {3.0f, 3.5f, 2.5f};
    scene.materials[0].conductorK = {1.0f, 0.7f, 1.3f};
    return scene;
}

void scaleConductor(Scene& scene, float by)
{
    scene.materials[0].conductorEta *= 1 + by;
    scene.materials[0].conductorK *= 1 + by;
}

/// A glass ball that fills most of the view before a black background. Reflection carries about a
/// tenth of the light, the rest goes through the glass.
Scene glassTransmits()
{
    Scene scene = scene32(12);
    addMaterialOf(scene, MATERIAL_DIELECTRIC, {0.95f, 0.9f, 0.8f}, 1.5f);
    addSphere(scene, {0, 0, 0}, 1);
    setSky(scene);
    lookFrom(scene, {0, 0.5, 4}, {0, 0, 0}, 30);
    return scene;
}

/// The same of triangles with interpolated normals, which refract.
Scene glassOfSmoothTriangles()
{
    Scene scene = glassTransmits();
    scene.primitives.clear();
    appendShape(scene, makeSphere({0, 0, 0}, 1, 1, true), {}, 0, "ball");
    return scene;
}

/// Only the upper half of the sky is bright and only the reflection in the water sees it.
Scene glassReflects()
{
    Scene scene = scene32(4);
    addMaterialOf(scene, MATERIAL_DIELECTRIC, vec3(1), 1.33f);
    addLevel(scene, 0, 50);
    scene.probe = addHalves(scene, {1, 1.1f, 0.9f}, vec3(0));
    scene.background = blackProbe();
    lookFrom(scene, {0, 0.7, 3}, {0, 0, 0}, 20);
    return scene;
}

/// A lamp under water, looked at from above: what is seen is its radiance times the transmittance
/// over eta squared. All light has gone from the denser medium to the other.
Scene lampUnderWater()
{
    Scene scene = scene32(4);
    addMaterialOf(scene, MATERIAL_DIELECTRIC, vec3(1), 1.33f);
    addLevel(scene, 0, 50);
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0)).emission = {3, 4, 5};
    addLevel(scene, -1, 50);
    lookFrom(scene, {0, 2, 2}, {0, 0, 0}, 40);
    return scene;
}

/// The camera is under water and looks up at its surface, across the critical angle. Only the
/// ground shines, and the mirror beyond the critical angle shows most of it.
Scene totalReflection()
{
    Scene scene = scene32(4);
    addMaterialOf(scene, MATERIAL_DIELECTRIC, vec3(1), 1.5f);
    addLevel(scene, 1, 50);
    addMaterialOf(scene, MATERIAL_LAMBERT, vec3(0)).emission = {3, 4, 5};
    addLevel(scene, -1, 50);
    lookFrom(scene, {0, 0, 0}, {0, 1, 1}, 30, {0, 1, 0});
    return scene;
}

/// The two walls of the report's material: four fifths of its weight are diffuse.
Scene reportDiffuse()
{
    Scene scene = corner(MATERIAL_REPORT, 4);
    scene.materials[0].diffuseWeight = 0.8f;
    scene.materials[0].specularWeight = 0.2f;
    scene.materials[0].eta = 1.5f;
    addLight(scene, LIGHT_POINT, {2, 2, 2}).position = {1, 2, 2};
    return scene;
}

void scaleDiffuseWeight(Scene& scene, float by)
{
    for (Material& material : scene.materials) material.diffuseWeight *= 1 + by;
}

/// A ball of the report's material that is nearly all specular; paths enter and leave by its rule.
Scene reportSpecular()
{
    Scene scene = glassTransmits();
    Material& material = scene.materials[0];
    material.type = MATERIAL_REPORT;
    material.diffuseWeight = 0.1f;
    material.specularWeight = 0.85f;
    return scene;
}

void scaleSpecular(Scene& scene, float by)
{
    for (Material& material : scene.materials) material.specularWeight *= 1 + by;
}

/// Three sheets of the report's material, of indices 1.5, 1.5 and 1.3: paths enter at the first,
/// leave at the second and refract for good at the third. The sky is bright in a wedge that only
/// refracted paths reach.
Scene reportRefracts()
{
    Scene scene = scene32(8);
    Material& thick = addMaterialOf(scene, MATERIAL_REPORT, vec3(1), 1.5f);
    thick.specularWeight = 1;
    addLevel(scene, 2, 50);
    addLevel(scene, 1, 50);
    Material& thin = addMaterialOf(scene, MATERIAL_REPORT, vec3(1), 1.3f);
    thin.specularWeight = 1;
    addLevel(scene, 0, 50);
    scene.probe = addProbe(scene, 1, 16, PROBE_LATLONG, FILTER_BILINEAR);
    for (uint32_t row = 8; row < 16; row++) {
        scene.probeTexels[row] = vec4(vec3(static_cast<float>(16 - row)), 0);
    }
    scene.background = blackProbe();
    lookFrom(scene, {0, 4, 5}, {0, 1, 0}, 20);
    return scene;
}

/// A pane of the report's material behind a pane of glass with two faces: out of the glass the path
/// is in vacuum again, so the sheet of the same index refracts it.
Scene reportBehindGlass()
{
    Scene scene = reportRefracts();
    scene.primitives.clear();
    scene.materials.clear();
    addMaterialOf(scene, MATERIAL_DIELECTRIC, vec3(1), 1.5f);
    addLevel(scene, 2, 50, true);
    addLevel(scene, 1.5, 50, false);
    addMaterialOf(scene, MATERIAL_REPORT, vec3(1), 1.5f).specularWeight = 1;
    addLevel(scene, 1, 50);
    return scene;
}

}  // namespace

std::vector<Term> materialTerms()
{
    return {
        {"lambert", lambert, scaleBaseColors, "reflectance"},
        {"mirror", mirror, scaleBaseColors, "reflectance"},
        {"conductor", conductor, scaleConductor, "complex index"},
        {"glassTransmits", glassTransmits, scaleBaseColors, "tint"},
        {"glassOfSmoothTriangles", glassOfSmoothTriangles, scaleBaseColors, "tint"},
        {"glassReflects", glassReflects, scaleEtas, "index"},
        {"lampUnderWater", lampUnderWater, scaleEtas, "index"},
        {"totalReflection", totalReflection, scaleEtas, "index"},
        {"reportDiffuse", reportDiffuse, scaleDiffuseWeight, "diffuse weight"},
        {"reportSpecular", reportSpecular, scaleSpecular, "specular weight"},
        {"reportRefracts", reportRefracts, scaleEtas, "indices"},
        {"reportBehindGlass", reportBehindGlass, scaleSpecular, "specular weight"},
    };
}

}  // namespace sahl::testing
