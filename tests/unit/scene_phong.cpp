// The phong integrator in scene files and options: terms, shadows, normals, materials.
#include "scene/phong.h"
#include "support/scene_files.h"

namespace sahl {
namespace {

using namespace sahl::testing;

RenderSettings settingsOf(const std::string& integrator, const SceneOptions& options = {})
{
    return loadJson("{ \"integrator\": { " + integrator + " } }", options).settings;
}

TEST(PhongKeys, defaultsAreAllTermsWithoutShadows)
{
    const RenderSettings settings = loadJson("{}").settings;
    EXPECT_EQ(settings.integrator, INTEGRATOR_PATH);
    EXPECT_EQ(settings.shading, SHADING_AMBIENT | SHADING_DIFFUSE | SHADING_SPECULAR);
    EXPECT_EQ(settings.ambient, vec3(0.1f));
}

TEST(PhongKeys, chooseTermsShadowsNormalsAndAmbientLight)
{
    const RenderSettings settings = settingsOf(R"("type": "phong", "terms": ["specular", "ambient"],
        "shadows": true, "normals": "flat", "ambient": [0.25, 0.5, 2])");
    EXPECT_EQ(settings.integrator, INTEGRATOR_PHONG);
    EXPECT_EQ(settings.shading,
              SHADING_AMBIENT | SHADING_SPECULAR | SHADING_SHADOWS | SHADING_FLAT);
    EXPECT_EQ(settings.ambient, vec3(0.25f, 0.5f, 2));
    EXPECT_EQ(
        settingsOf(R"("terms": ["diffuse"], "shadows": false, "normals": "interpolated")").shading,
        SHADING_DIFFUSE);
}

TEST(PhongKeys, mistakesInTermsAreNamedWithTheirPlace)
{
    auto errorOf = [](const std::string& terms) {
        return errorOfJson("{ \"integrator\": { \"terms\": " + terms + " } }");
    };
    EXPECT_EQ(
        errorOf("[\"ambient\", \"difuse\"]"),
        "scene.json:1:40: an entry of \"terms\" of the integrator is \"difuse\"; did you mean "
        "\"diffuse\"?");
    EXPECT_EQ(errorOf("[\"ambient\", \"ambient\"]"),
              "scene.json:1:40: \"terms\" of the integrator has \"ambient\" twice");
    EXPECT_EQ(errorOf("[]"),
              "scene.json:1:28: \"terms\" of the integrator is empty; known: \"ambient\", "
              "\"diffuse\", \"specular\"");
    EXPECT_CONTAINS(errorOf("\"ambient\""), "\"terms\" of the integrator must be an array");
    EXPECT_CONTAINS(errorOf("[1]"), "must be a text, found a number");
}

TEST(PhongOptions, overrideTheScene)
{
    const std::string scene = R"("type": "phong", "terms": ["diffuse"], "shadows": true,
        "normals": "flat")";
    SceneOptions options;
    options.integrator = INTEGRATOR_PATH;
    options.terms = SHADING_AMBIENT;
    options.shadows = false;
    EXPECT_EQ(settingsOf(scene, options).integrator, INTEGRATOR_PATH);
    EXPECT_EQ(settingsOf(scene, options).shading, SHADING_AMBIENT | SHADING_FLAT);
    options.flatNormals = false;
    options.shadows = true;
    options.terms.reset();
    EXPECT_EQ(settingsOf(scene, options).shading, SHADING_DIFFUSE | SHADING_SHADOWS);
}

Material materialOf(const std::string& keys)
{
    return loadJson("{ \"materials\": { \"m\": { " + keys + " } } }").materials.at(0);
}

TEST(PhongMaterials, haveTheirOwnColorsAndExponent)
{
    for (const char* type : {"lambert", "mirror", "dielectric", "conductor", "report"}) {
        const Material material =
            materialOf(fmt::format(R"("type": "{}", "specularColor": [0.25, 0.5, 1],
                                      "shininess": 7.5, "ambientColor": [1, 0, 0.5])",
                                   type));
        EXPECT_EQ(material.specularColor, vec3(0.25f, 0.5f, 1)) << type;
        EXPECT_EQ(material.shininess, 7.5f) << type;
        EXPECT_EQ(material.ambientColor, vec3(1, 0, 0.5f)) << type;
    }
}

TEST(PhongMaterials, withoutOwnValuesShowWhatTheyAre)
{
    const Material lambert = materialOf(R"("type": "lambert", "baseColor": [0.5, 0.25, 1])");
    EXPECT_EQ(lambert.ambientColor, vec3(0.5f, 0.25f, 1));
    EXPECT_EQ(lambert.specularColor, vec3(0));
    EXPECT_EQ(lambert.shininess, 50.0f);
    const Material mirror = materialOf(R"("type": "mirror", "baseColor": [0.5, 0.25, 1])");
    EXPECT_EQ(mirror.specularColor, vec3(0.5f, 0.25f, 1));
    const Material glass = materialOf(R"("type": "dielectric", "baseColor": [0.5, 0.25, 1])");
    EXPECT_EQ(glass.ambientColor, vec3(0.5f, 0.25f, 1));
    EXPECT_EQ(glass.specularColor, vec3(1));
    const Material report = materialOf(R"("type": "report", "specularWeight": 0.25)");
    EXPECT_EQ(report.specularColor, vec3(0.25f));
}

TEST(PhongMaterials, ofMetalsReflectAsAtRightAngles)
{
    // |1 - eta - i k|^2 / |1 + eta + i k|^2
    const Material metal =
        materialOf(R"("type": "conductor", "conductorEta": [1, 2, 0.5], "conductorK": [2, 0, 1])");
    EXPECT_FLOAT_EQ(metal.specularColor.x, 4.0f / 8);
    EXPECT_FLOAT_EQ(metal.specularColor.y, 1.0f / 9);
    EXPECT_FLOAT_EQ(metal.specularColor.z, 1.25f / 3.25f);
    EXPECT_EQ(metal.ambientColor, metal.specularColor);
}

TEST(PhongScenes, withoutLightsAreWarnedAbout)
{
    auto warningOf = [](const std::string& rest) {
        return warningsOf(
            [&] { loadJson("{ \"integrator\": { \"type\": \"phong\"" + rest + " } }"); });
    };
    const std::string start = "no point, spot or directional light: phong shows ";
    EXPECT_CONTAINS(warningOf(""), start + "ambient light and emission alone");
    EXPECT_CONTAINS(warningOf(", \"ambient\": [0, 0, 0]"), start + "black shapes");
    EXPECT_CONTAINS(warningOf(", \"terms\": [\"diffuse\"]"), start + "black shapes");
    EXPECT_EQ(warningsOf([] {
                  loadJson(R"({ "integrator": { "type": "phong" }, "lights": [
                      { "type": "point", "position": [0, 0, 0], "intensity": [1, 1, 1] }] })");
              }),
              "");
}

TEST(PhongScenes, ofAnObjFileGetAHeadLight)
{
    const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    EXPECT_TRUE(loadObj(triangle).lights.empty());
    SceneOptions options;
    options.integrator = INTEGRATOR_PHONG;
    const Scene scene = loadObj(triangle, options);
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.lights[0].type, LIGHT_DIRECTIONAL);
    EXPECT_GT(glm::dot(scene.lights[0].direction, scene.camera.forward), 0.7f);
    EXPECT_LT(scene.lights[0].direction.y, 0.0f);
}

}  // namespace
}  // namespace sahl
