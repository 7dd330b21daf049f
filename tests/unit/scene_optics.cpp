// What scene files say about materials, spheres, lights and the environment, with known answers.
#include "support/scene_files.h"

#include <cmath>

namespace sahl {
namespace {

using namespace sahl::testing;

Material materialOf(const std::string& text)
{
    return loadJson(R"({ "materials": { "m": )" + text + " } }").materials.at(0);
}

TEST(JsonMaterials, everyTypeHasSensibleDefaults)
{
    const Material mirror = materialOf(R"({ "type": "mirror" })");
    EXPECT_EQ(mirror.type, MATERIAL_MIRROR);
    EXPECT_EQ(mirror.baseColor, vec3(1));
    const Material glass = materialOf(R"({ "type": "dielectric" })");
    EXPECT_EQ(glass.type, MATERIAL_DIELECTRIC);
    EXPECT_EQ(glass.eta, 1.5f);
    EXPECT_EQ(glass.baseColor, vec3(1));
    const Material metal = materialOf(R"({ "type": "conductor" })");
    EXPECT_EQ(metal.type, MATERIAL_CONDUCTOR);
    EXPECT_EQ(metal.conductorEta, vec3(1.3660f, 1.0728f, 0.6079f));
    const Material report = materialOf(R"({ "type": "report" })");
    EXPECT_EQ(report.type, MATERIAL_REPORT);
    EXPECT_EQ(report.baseColor, vec3(0.7f));
    EXPECT_EQ(report.diffuseWeight, 0.5f);
    EXPECT_EQ(report.specularWeight, 0.5f);
    EXPECT_EQ(report.eta, 1.5f);
}

TEST(JsonMaterials, roughnessMakesMetalAndGlassRough)
{
    const Material metal = materialOf(R"({ "type": "conductor", "metal": "gold", "roughness": 0.5 })");
    EXPECT_EQ(metal.type, MATERIAL_ROUGH_CONDUCTOR);
    EXPECT_EQ(metal.roughness, 0.5f);
    EXPECT_EQ(metal.conductorEta.x, 0.21f);
    const Material glass = materialOf(R"({ "type": "dielectric", "roughness": 0.25, "eta": 1.33 })");
    EXPECT_EQ(glass.type, MATERIAL_ROUGH_DIELECTRIC);
    EXPECT_EQ(glass.roughness, 0.25f);
    EXPECT_EQ(glass.eta, 1.33f);
    EXPECT_EQ(materialOf(R"({ "type": "conductor", "roughness": 0 })").type, MATERIAL_CONDUCTOR);
    EXPECT_EQ(materialOf(R"({ "type": "dielectric", "roughness": 0 })").type, MATERIAL_DIELECTRIC);
}

TEST(JsonMaterials, layeredTypesArriveInTheirFields)
{
    const Material pane = materialOf(R"({ "type": "thinDielectric", "eta": 1.6 })");
    EXPECT_EQ(pane.type, MATERIAL_THIN_DIELECTRIC);
    EXPECT_EQ(pane.eta, 1.6f);
    EXPECT_EQ(pane.baseColor, vec3(1));
    const Material plastic = materialOf(R"({ "type": "plastic" })");
    EXPECT_EQ(plastic.type, MATERIAL_PLASTIC);
    EXPECT_EQ(plastic.baseColor, vec3(0.7f));
    EXPECT_EQ(plastic.roughness, 0.0f);
    // 1 less the reflectance of eta 1.5 averaged over the hemisphere, 0.0918: Egan and Hilgeman 1973
    EXPECT_NEAR(plastic.transmission, 1 - 0.0918, 5e-5);
    const Material gltf = materialOf(R"({ "type": "metallicRoughness" })");
    EXPECT_EQ(gltf.type, MATERIAL_METALLIC_ROUGHNESS);
    EXPECT_EQ(gltf.metallic, 1.0f);
    EXPECT_EQ(gltf.roughness, 1.0f);
    EXPECT_EQ(gltf.transmission, 0.0f);
    EXPECT_EQ(gltf.eta, 1.5f);
    const Material wall = materialOf(R"({ "type": "metallicRoughness", "metallic": 0.25,
        "roughness": 0.5, "transmission": 0.75, "eta": 1.25, "baseColor": [0.5, 0.25, 1] })");
    EXPECT_EQ(wall.metallic, 0.25f);
    EXPECT_EQ(wall.roughness, 0.5f);
    EXPECT_EQ(wall.transmission, 0.75f);
    EXPECT_EQ(wall.eta, 1.25f);
    EXPECT_EQ(wall.baseColor, vec3(0.5f, 0.25f, 1));
}

TEST(JsonMaterials, numbersOutOfRangeAreRefused)
{
    for (const char* text :
         {R"({ "type": "conductor", "roughness": 1.5 })", R"({ "type": "dielectric", "roughness": -0.1 })",
          R"({ "type": "plastic", "eta": 0.9 })", R"({ "type": "metallicRoughness", "metallic": 2 })",
          R"({ "type": "metallicRoughness", "transmission": -1 })"}) {
        EXPECT_THROW(materialOf(text), Error) << text;
    }
}

TEST(JsonMaterials, valuesArriveInTheirFields)
{
    const Material water = materialOf(
        R"({ "type": "dielectric", "eta": 1.33, "baseColor": [0.25, 0.5, 1], "emission": [1, 2, 3] })");
    EXPECT_EQ(water.eta, 1.33f);
    EXPECT_EQ(water.baseColor, vec3(0.25f, 0.5f, 1));
    EXPECT_EQ(water.emission, vec3(1, 2, 3));
    const Material report = materialOf(R"({ "type": "report", "diffuseWeight": 0.25,
        "specularWeight": 0.75, "eta": 1e-10 })");
    EXPECT_EQ(report.diffuseWeight, 0.25f);
    EXPECT_EQ(report.specularWeight, 0.75f);
    EXPECT_EQ(report.eta, 1e-10f);
    const Material metal = materialOf(
        R"({ "type": "conductor", "conductorEta": [1, 2, 3], "conductorK": [4, 5, 6] })");
    EXPECT_EQ(metal.conductorEta, vec3(1, 2, 3));
    EXPECT_EQ(metal.conductorK, vec3(4, 5, 6));
}

/// Reflectance at normal incidence, ((eta - 1)^2 + k^2) / ((eta + 1)^2 + k^2).
double normalReflectance(float eta, float k)
{
    const double n = double{eta}, k2 = double{k} * double{k};
    return ((n - 1) * (n - 1) + k2) / ((n + 1) * (n + 1) + k2);
}

TEST(JsonMaterials, metalsHaveTheColoursTheyAreKnownFor)
{
    auto colour = [](const std::string& metal) {
        const Material m = materialOf(R"({ "type": "conductor", "metal": ")" + metal + "\" }");
        return glm::dvec3(normalReflectance(m.conductorEta.x, m.conductorK.x),
                          normalReflectance(m.conductorEta.y, m.conductorK.y),
                          normalReflectance(m.conductorEta.z, m.conductorK.z));
    };
    const glm::dvec3 gold = colour("gold"), copper = colour("copper");
    EXPECT_NEAR(gold.x, 0.931, 0.001);
    EXPECT_NEAR(gold.y, 0.787, 0.001);
    EXPECT_NEAR(gold.z, 0.408, 0.001);
    EXPECT_NEAR(copper.x, 0.900, 0.001);
    EXPECT_NEAR(copper.y, 0.620, 0.001);
    EXPECT_NEAR(copper.z, 0.539, 0.001);
    for (int k = 0; k < 3; k++) {
        EXPECT_GT(colour("silver")[k], 0.97);
        EXPECT_NEAR(colour("aluminium")[k], 0.915, 0.01);
    }
}

TEST(JsonMaterials, weightsAboveOneAreWarnedAbout)
{
    const std::string warning = warningsOf([] {
        materialOf(R"({ "type": "report", "diffuseWeight": 0.75, "specularWeight": 0.5 })");
    });
    EXPECT_CONTAINS(warning, "scene.json:1:23: the weights of material \"m\" add up to 1.25");
    EXPECT_EQ(warningsOf([] {
                  materialOf(
                      R"({ "type": "report", "diffuseWeight": 0.5, "specularWeight": 0.5 })");
              }).find("weights"),
              std::string::npos);
}

TEST(JsonShapes, sphereIsOnePrimitive)
{
    const Scene scene =
        loadJson(R"({ "shapes": [{ "type": "sphere", "center": [1, 2, 3], "radius": 4 },
                                                 { "type": "sphere" }] })");
    ASSERT_EQ(scene.primitives.size(), 2u);
    const Primitive& sphere = scene.primitives[0];
    EXPECT_EQ(sphere.shape, SHAPE_SPHERE);
    EXPECT_EQ(sphere.p0, vec3(1, 2, 3));
    EXPECT_EQ(sphere.p1.x, 4);
    EXPECT_EQ(scene.primitives[1].number, 1u);
    EXPECT_EQ(scene.primitives[1].p1.x, 1);
}

TEST(JsonShapes, spheresFollowTransformsThatKeepThemSpheres)
{
    const Scene scene =
        loadJson(R"({ "shapes": [{ "type": "sphere", "center": [1, 0, 0], "radius": 2,
        "transform": { "scale": 3, "rotateDeg": { "axis": [0, 0, 1], "angle": 90 },
                       "translate": [0, 0, 5] } },
        { "type": "sphere", "center": [1, 0, 0], "transform": { "scale": [-2, 2, 2] } }] })");
    EXPECT_EQ(scene.primitives.at(0).p0, vec3(0, 3, 5));
    EXPECT_EQ(scene.primitives.at(0).p1.x, 6);
    EXPECT_EQ(scene.primitives.at(1).p0, vec3(-2, 0, 0));
    EXPECT_EQ(scene.primitives.at(1).p1.x, 2);
}

/// A scene without a camera is framed; the sphere's own size counts, not its record's fields.
TEST(JsonShapes, spheresAreFramedByTheirBoxes)
{
    const Scene small = loadJson(R"({ "shapes": [{ "type": "sphere", "center": [0, 0, 0] }] })");
    const Scene large =
        loadJson(R"({ "shapes": [{ "type": "sphere", "center": [0, 0, 0], "radius": 10 }] })");
    EXPECT_NEAR(large.camera.position.z / small.camera.position.z, 10, 1e-4);
}

TEST(JsonLights, spotAndDirectionalLightsAreRead)
{
    const Scene scene = loadJson(R"({ "lights": [
        { "type": "spot", "position": [1, 2, 3], "lookAt": [1, 0, 3], "intensity": [4, 5, 6],
          "innerDeg": 30, "outerDeg": 60 },
        { "type": "spot", "position": [0, 0, 0], "direction": [0, 0, -9], "intensity": [1, 1, 1] },
        { "type": "directional", "direction": [3, 0, 4], "irradiance": [7, 8, 9] }] })");
    ASSERT_EQ(scene.lights.size(), 3u);
    const Light& spot = scene.lights[0];
    EXPECT_EQ(spot.type, LIGHT_SPOT);
    EXPECT_EQ(spot.position, vec3(1, 2, 3));
    EXPECT_EQ(spot.direction, vec3(0, -1, 0));
    EXPECT_EQ(spot.intensity, vec3(4, 5, 6));
    EXPECT_FLOAT_EQ(spot.cosInner, std::sqrt(0.75f));
    EXPECT_FLOAT_EQ(spot.cosOuter, 0.5f);
    EXPECT_EQ(scene.lights[1].direction, vec3(0, 0, -1));
    EXPECT_FLOAT_EQ(scene.lights[1].cosOuter, std::sqrt(0.75f));
    EXPECT_FLOAT_EQ(scene.lights[1].cosInner, 0.92387953f);  // 22.5 degrees
    const Light& sun = scene.lights[2];
    EXPECT_EQ(sun.type, LIGHT_DIRECTIONAL);
    EXPECT_EQ(sun.direction, vec3(0.6f, 0, 0.8f));
    EXPECT_EQ(sun.intensity, vec3(7, 8, 9));
}

/// Where in the probe's own picture a direction of the world is looked up.
vec3 lookedUp(const Probe& probe, vec3 d)
{
    return {glm::dot(probe.axisX, d), glm::dot(probe.axisY, d), glm::dot(probe.axisZ, d)};
}

TEST(JsonEnvironment, isScaledAndTurnedAboutY)
{
    const Scene scene =
        loadJson(R"({ "environment": { "radiance": [1, 2, 3], "scale": 2.5, "rotateDeg": 90 } })");
    EXPECT_EQ(scene.probeTexels.at(0), vec4(2.5f, 5, 7.5f, 0));
    // Seen from above, the light moved a quarter counter-clockwise: what was at -Z is now at -X.
    EXPECT_EQ(lookedUp(scene.probe, vec3(-1, 0, 0)), vec3(0, 0, -1));
    EXPECT_EQ(lookedUp(scene.probe, vec3(0, 1, 0)), vec3(0, 1, 0));
}

TEST(JsonEnvironment, turnsAboutAnyAxis)
{
    const Scene scene = loadJson(R"({ "environment": { "builtin": "studio",
        "rotateDeg": { "axis": [1, 0, 0], "angle": 90 } } })");
    EXPECT_EQ(lookedUp(scene.probe, vec3(0, 0, 1)), vec3(0, 1, 0));
    EXPECT_EQ(lookedUp(scene.probe, vec3(0, 1, 0)), vec3(0, 0, -1));
}

TEST(JsonEnvironment, backgroundFollowsTheEnvironmentInTheBuffer)
{
    const Scene scene = loadJson(R"({ "background": { "radiance": [9, 8, 7], "scale": 0.5 },
                                      "environment": { "builtin": "studio" } })");
    ASSERT_TRUE(scene.background.has_value());
    const uint texels = scene.probe.width * scene.probe.height;
    EXPECT_EQ(scene.probe.firstTexel, 0u);
    EXPECT_EQ(scene.background->firstTexel, texels);
    ASSERT_EQ(scene.probeTexels.size(), texels + 1);
    EXPECT_EQ(scene.probeTexels.back(), vec4(4.5f, 4, 3.5f, 0));
    EXPECT_FALSE(loadJson(R"({ "environment": { "builtin": "studio" } })").background.has_value());
}

TEST(JsonEnvironment, backgroundAloneLightsNothing)
{
    const Scene scene = loadJson(R"({ "background": { "radiance": [1, 1, 1] },
                                      "lights": [{ "type": "point", "position": [0, 9, 0], "intensity": [1, 1, 1] }] })");
    EXPECT_EQ(scene.probe.height, 0u);
    EXPECT_EQ(scene.background.value().height, 1u);
}

struct Mistake {
    const char* json;
    const char* message;
};

TEST(JsonOptics, mistakesAreNamedWithLineAndColumn)
{
    const Mistake mistakes[] = {
        {R"({ "materials": { "a": { "type": "glass" } } })",
         "1:33: \"type\" of material \"a\" is \"glass\"; known: \"lambert\""},
        {R"({ "materials": { "a": { "type": "dielectric", "ior": 1.5 } } })",
         "1:47: unknown key \"ior\" in material \"a\"; did you mean \"eta\"?"},
        {R"({ "materials": { "a": { "type": "dielectric", "eta": 0 } } })",
         "1:54: \"eta\" of material \"a\" is 0; it must lie in [1e-30, 1000000]"},
        {R"({ "materials": { "a": { "type": "mirror", "eta": 2 } } })", "unknown key \"eta\""},
        {R"({ "materials": { "a": { "type": "conductor", "metal": "gould" } } })",
         "did you mean \"gold\"?"},
        {R"({ "materials": { "a": { "type": "conductor", "conductorEta": [1, 1, 1] } } })",
         "material \"a\" lacks the key \"conductorK\""},
        {R"({ "materials": { "a": { "type": "conductor", "metal": "gold", "conductorK": [1, 1, 1] } } })",
         "1:55: material \"a\" has both \"metal\""},
        {R"({ "materials": { "a": { "type": "report", "diffuseWeight": 1.5 } } })",
         "\"diffuseWeight\" of material \"a\" is 1.5; it must lie in [0, 1]"},
        {R"({ "shapes": [{ "type": "sphere", "radius": 0 }] })",
         "\"radius\" of the shape \"sphere\" is 0"},
        {R"({ "shapes": [{ "type": "sphere", "transform": { "scale": [1, 2, 1] } }] })",
         "1:47: a sphere stays a sphere only when scaled alike"},
        {R"({ "shapes": [{ "type": "sphere", "radius": 1e18, "transform": { "scale": 1e30 } }] })",
         "the sphere reaches outside the range of numbers"},
        {R"({ "shapes": [{ "type": "sphere", "radius": 1e-9, "transform": { "scale": 1e-30 } }] })",
         "the sphere's radius is"},
        {R"({ "shapes": [{ "type": "sphere", "name": "a" }, { "type": "sphere", "name": "a" }] })",
         "1:77: two shapes have the name \"a\""},
        {R"({ "shapes": [{ "type": "sphere", "name": "" }] })",
         "1:42: the name of a shape is empty"},
        {R"({ "lights": [{ "type": "spot", "position": [0, 0, 0], "intensity": [1, 1, 1] }] })",
         "1:14: a spot light needs either \"direction\" or \"lookAt\""},
        {R"({ "lights": [{ "type": "spot", "position": [0, 0, 0], "intensity": [1, 1, 1],
  "direction": [0, 0, 0] }] })",
         "2:16: \"direction\" of a spot light is zero"},
        {R"({ "lights": [{ "type": "spot", "position": [1, 0, 0], "intensity": [1, 1, 1],
  "lookAt": [1, 0, 0] }] })",
         "2:13: \"lookAt\" of a spot light is where the light itself is"},
        {R"({ "lights": [{ "type": "spot", "position": [1, 0, 0], "intensity": [1, 1, 1],
  "direction": [1, 0, 0], "outerDeg": 20, "innerDeg": 25 }] })",
         "2:55: \"innerDeg\" of a spot light is 25, more than its \"outerDeg\" 20"},
        {R"({ "lights": [{ "type": "directional", "direction": [0, 0, 0], "irradiance": [1, 1, 1] }] })",
         "\"direction\" of a directional light is zero"},
        {R"({ "environment": { "builtin": "studio", "scale": -1 } })",
         "\"scale\" of the environment is -1"},
        {R"({ "environment": { "builtin": "studio", "rotateDeg": { "axis": [0, 0, 0], "angle": 1 } } })",
         "1:54: the axis of a rotation is zero"},
        {R"({ "environment": { "radiance": [1e18, 0, 0], "scale": 1e18 }, "background": {} })",
         "the background needs exactly one of"},
    };
    for (const Mistake& mistake : mistakes) {
        EXPECT_CONTAINS(errorOfJson(mistake.json), mistake.message);
    }
}

TEST(JsonEnvironment, refusesAScaleThatOverflows)
{
    SceneFolder files;
    files.write("sky.pfm", std::string("PF\n1 1\n-1.0\n") + std::string("\xff\xff\x7f\x7f", 4) +
                               std::string(8, '\0'));
    files.write("s.json", R"({ "environment": { "file": "sky.pfm", "scale": 2 } })");
    EXPECT_CONTAINS(errorOfFile(files, "s.json"), "sky.pfm: scaled by 2, the value");
}

}  // namespace
}  // namespace sahl
