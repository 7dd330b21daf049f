// Scene files: what the keys mean, and where mistakes are said to be.
#include "scene/adaptive.h"
#include "scene/json_document.h"
#include "scene/scene_keys.h"
#include "support/scene_files.h"
#include "support/source_folder.h"

#include <algorithm>
#include <clocale>
#include <locale>

namespace sahl {
namespace {

using namespace sahl::testing;

const char* const MINIMAL = R"({ "camera": { "eye": [0, 0, 5], "lookAt": [0, 0, 0] },
  "environment": { "radiance": [1, 1, 1] } })";

TEST(JsonScene, defaultsAreThoseOfTheSchema)
{
    const Scene scene = loadJson(MINIMAL);
    EXPECT_EQ(scene.settings.width, 512u);
    EXPECT_EQ(scene.settings.height, 512u);
    EXPECT_EQ(scene.settings.spp, 64u);
    EXPECT_EQ(scene.settings.maxBounces, 8u);
    EXPECT_EQ(scene.settings.seed, 0u);
    EXPECT_TRUE(scene.primitives.empty());
    EXPECT_FLOAT_EQ(scene.camera.right.x, 0.36397023f);  // tan 20 degrees
}

TEST(JsonScene, readsFilmIntegratorMaterialsAndLights)
{
    const Scene scene = loadJson(R"({
        "film": { "width": 64, "height": 32 },
        "integrator": { "type": "path", "maxBounces": 3, "samplesPerPixel": 5, "seed": 4294967295 },
        "materials": { "a": { "type": "lambert", "baseColor": [0.25, 0.5, 1], "emission": [1, 2, 3] } },
        "shapes": [{ "type": "rectangle", "corner": [0, 0, 0], "edgeU": [1, 0, 0], "edgeV": [0, 1, 0],
                     "material": "a" }],
        "lights": [{ "type": "point", "position": [1, 2, 3], "intensity": [4, 5, 6] }] })");
    EXPECT_EQ(scene.settings.width, 64u);
    EXPECT_EQ(scene.settings.height, 32u);
    EXPECT_EQ(scene.settings.maxBounces, 3u);
    EXPECT_EQ(scene.settings.spp, 5u);
    EXPECT_EQ(scene.settings.seed, 4294967295u);
    ASSERT_EQ(scene.materials.size(), 1u);
    EXPECT_EQ(scene.materialNames.at(0), "a");
    EXPECT_EQ(scene.materials[0].baseColor, vec3(0.25f, 0.5f, 1));
    EXPECT_EQ(scene.materials[0].emission, vec3(1, 2, 3));
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.lights[0].position, vec3(1, 2, 3));
    EXPECT_EQ(scene.lights[0].intensity, vec3(4, 5, 6));
    ASSERT_EQ(scene.primitives.size(), 2u);
    EXPECT_EQ(scene.primitives[1].number, 1u);
    EXPECT_EQ(scene.probe.height, 0u);
}

TEST(JsonScene, choosesThePhongIntegratorAndPixelCentres)
{
    Scene plain = loadJson("{}");
    EXPECT_EQ(plain.settings.integrator, INTEGRATOR_PATH);
    EXPECT_TRUE(plain.settings.jitter);
    Scene phong = loadJson(R"({ "integrator": { "type": "phong" }, "film": { "jitter": false } })");
    EXPECT_EQ(phong.settings.integrator, INTEGRATOR_PHONG);
    EXPECT_FALSE(phong.settings.jitter);
}

TEST(JsonScene, optionsOverrideTheFile)
{
    SceneOptions options;
    options.width = 7;
    options.height = 9;
    options.spp = 11;
    options.maxBounces = 0;
    options.seed = 13;
    options.probeFilter = "nearest";
    const Scene scene = loadJson(MINIMAL, options);
    EXPECT_EQ(scene.settings.width, 7u);
    EXPECT_EQ(scene.settings.height, 9u);
    EXPECT_EQ(scene.settings.spp, 11u);
    EXPECT_EQ(scene.settings.maxBounces, 0u);
    EXPECT_EQ(scene.settings.seed, 13u);
    EXPECT_EQ(scene.probe.filterMode, FILTER_NEAREST);
    EXPECT_FLOAT_EQ(scene.camera.right.x / scene.camera.down.y, -7.0f / 9.0f);
}

TEST(JsonScene, transformsApplyMatrixScaleRotateTranslateInThatOrder)
{
    const Scene scene = loadJson(R"({ "shapes": [{ "type": "triangles",
        "positions": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "indices": [[0, 1, 2]],
        "transform": { "translate": [10, 0, 0], "rotateDeg": { "axis": [0, 0, 2], "angle": 90 },
                       "scale": [2, 3, 1], "matrix": [1,0,0,1, 0,1,0,0, 0,0,1,0, 0,0,0,1] } }] })");
    // (0,0,0) -> (1,0,0) -> (2,0,0) -> (0,2,0) -> (10,2,0)
    const Primitive& t = scene.primitives.at(0);
    EXPECT_EQ(t.p0, vec3(10, 2, 0));
    EXPECT_EQ(t.p1, vec3(10, 4, 0));
    EXPECT_EQ(t.p2, vec3(7, 2, 0));
}

TEST(JsonScene, shapeWithoutMaterialIsGrey)
{
    const Scene scene = loadJson(R"({ "shapes": [{ "type": "sphereMesh", "level": 0 },
                                                 { "type": "sphereMesh", "level": 0 }] })");
    ASSERT_EQ(scene.materials.size(), 1u);
    EXPECT_EQ(scene.materials[0].baseColor, vec3(0.7f));
    EXPECT_EQ(scene.primitives.size(), 40u);
}

TEST(JsonScene, meshMaterialReplacesThoseOfTheFile)
{
    SceneFolder files;
    files.write("a.mtl", "newmtl red\nKd 1 0 0\n");
    files.write("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n");
    files.write("own.json", R"({ "shapes": [{ "type": "mesh", "file": "a.obj" }] })");
    files.write("other.json",
                R"({ "materials": { "blue": { "type": "lambert", "baseColor": [0, 0, 1] } },
        "shapes": [{ "type": "mesh", "file": "a.obj", "material": "blue" }] })");
    const Scene own = files.load("own.json");
    EXPECT_EQ(own.materials.at(own.primitives.at(0).material).baseColor, vec3(1, 0, 0));
    const Scene other = files.load("other.json");
    EXPECT_EQ(other.materials.at(other.primitives.at(0).material).baseColor, vec3(0, 0, 1));
}

TEST(JsonScene, filesOutsideTheFolderNeedPermission)
{
    SceneFolder files;
    files.write("meshes/a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    files.write("scenes/s.json",
                R"({ "shapes": [{ "type": "mesh", "file": "../meshes/a.obj" }] })");
    EXPECT_CONTAINS(errorOfFile(files, "scenes/s.json"),
                    "scenes/s.json:1:40: \"../meshes/a.obj\" lies "
                    "outside the scene's folder; --allow-path");
    SceneOptions options;
    options.allowedPaths = {files.folder.path / "meshes"};
    EXPECT_EQ(files.load("scenes/s.json", options).primitives.size(), 1u);
}

TEST(JsonScene, linksOutOfTheFolderAreFollowedBeforeTheCheck)
{
    SceneFolder files;
    files.write("secret/a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    files.write("scenes/s.json", R"({ "shapes": [{ "type": "mesh", "file": "link.obj" }] })");
    fs::create_symlink(files.folder.path / "secret/a.obj", files.folder.path / "scenes/link.obj");
    EXPECT_CONTAINS(errorOfFile(files, "scenes/s.json"), "outside the scene's folder");
}

TEST(JsonScene, aMeshUsedTwiceIsPlacedTwice)
{
    SceneFolder files;
    files.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    files.write("s.json", R"({ "shapes": [{ "type": "mesh", "file": "a.obj" },
        { "type": "mesh", "file": "a.obj", "transform": { "translate": [0, 0, 1] } }] })");
    const Scene scene = files.load("s.json");
    ASSERT_EQ(scene.primitives.size(), 2u);
    EXPECT_EQ(scene.primitives[1].p0, vec3(0, 0, 1));
}

/// A mistake and what must be said about it.
struct Mistake {
    const char* json;
    const char* message;
};

TEST(JsonScene, mistakesAreNamedWithLineAndColumn)
{
    const Mistake mistakes[] = {
        {"{\n \"materials\": {\n  \"clay\": { \"type\": \"lambert\", \"colour\": [1, 1, 1] } } }",
         "scene.json:3:32: unknown key \"colour\" in material \"clay\"; did you mean "
         "\"baseColor\"?"},
        {"{ \"camra\": {} }",
         "scene.json:1:3: unknown key \"camra\" in the scene; did you mean \"camera\"?"},
        {"{ \"zzzzzzzz\": 1 }", "scene.json:1:3: unknown key \"zzzzzzzz\" in the scene"},
        {"{ \"camera\": { \"eye\": [0, 0, 1] } }",
         "scene.json:1:13: the camera lacks the key \"lookAt\""},
        {"{ \"film\": { \"width\": 0 } }",
         "scene.json:1:22: \"width\" of the film is 0; it must lie in [1, 32768]"},
        {"{ \"film\": { \"width\": 1.5 } }",
         "scene.json:1:22: \"width\" of the film is 1.5; it must be a whole number"},
        {"{ \"film\": { \"width\": \"wide\" } }",
         "scene.json:1:22: \"width\" of the film must be a number, found a text"},
        {"{ \"film\": { \"width\": 32768, \"height\": 32768 } }",
         "a picture of 32768 x 32768 pixels"},
        {"{ \"shapes\": [{ \"type\": \"teapod\" }] }",
         "scene.json:1:24: \"type\" of a shape is \"teapod\"; did you mean \"teapot\"?"},
        {"{ \"shapes\": [{ \"level\": 3 }] }",
         "scene.json:1:14: a shape lacks the key \"type\", one of"},
        {"{ \"materials\": { \"glass\": { \"type\": \"lambert\" } },\n"
         "  \"shapes\": [{ \"type\": \"teapot\", \"material\": \"glas\" }] }",
         "scene.json:2:46: material \"glas\" is not defined; did you mean \"glass\"?"},
        {"{ \"materials\": { \"a\": { \"type\": \"lambert\", \"baseColor\": [0, 1.5, 0] } } }",
         "scene.json:1:61: \"baseColor\" of material \"a\" is 1.5; it must lie in [0, 1]"},
        {"{ \"materials\": { \"a\": { \"type\": \"lambert\", \"baseColor\": [0, 1] } } }",
         "scene.json:1:57: \"baseColor\" of material \"a\" needs 3 numbers, found 2"},
        {"{ \"environment\": { } }", "needs exactly one of \"file\", \"radiance\" and \"builtin\""},
        {"{ \"environment\": { \"builtin\": \"studio\", \"mapping\": \"angular\" } }",
         "scene.json:1:52: \"mapping\" goes with \"file\" only"},
        {"{ \"shapes\": [{ \"type\": \"teapot\", \"transform\": { \"scale\": [1, 0, 1] } }] }",
         "scene.json:1:47: the transform of the shape \"teapot\" cannot be inverted"},
        {"{ \"shapes\": [{ \"type\": \"triangles\", \"positions\": [[0,0,0],[1,0,0],[0,1,0]],\n"
         " \"indices\": [[0, 1, 3]] }] }",
         "scene.json:2:21: an index is 3; it must lie in [0, 2]"},
        {"{ \"camera\": { \"eye\": [0, 0, 0], \"lookAt\": [0, 0, 0] } }",
         "scene.json:1:13: camera: eye and lookAt coincide"},
        {"{ \"film\": {}, \"film\": {} }", "scene.json:1:15: duplicate key \"film\""},
        {"{ \"film\": {} } x", "scene.json:1:16: syntax error"},
        {"{ \"film\": { \"width\": 1e400 } }", "scene.json:1:26: number overflow"},
        {"{ \"film\": { \"width\": NaN } }", "scene.json:1:22: syntax error"},
        {"{ \"film\": { // comment\n } }", "scene.json:1:13: syntax error"},
        {"{ \"description\": \"\xff\" }", "scene.json:1:19: syntax error"},
        {"", "scene.json:1:1: syntax error"},
        {"[1]", "scene.json:1:1: the scene must be an object, found an array"},
        {"{ \"description\": \"\xC3\xA9\xC3\xA9\", \"x\": 1 }",
         "scene.json:1:24: unknown key \"x\""},
    };
    for (const Mistake& mistake : mistakes) {
        EXPECT_CONTAINS(errorOfJson(mistake.json), mistake.message);
    }
}

TEST(JsonDocument, everyValueKnowsWhereItStands)
{
    const JsonDocument document = parseJson(
        "f", "\xEF\xBB\xBF{ \"a\\\"b\" :\n [1, -2.5e3,\t\"x\\\\\", {\"c\" : null}, true, []] }");
    const JsonNode& list = document.root.items.at(0);
    EXPECT_EQ(document.where(document.root.keys.at(0).offset), "f:1:4");
    EXPECT_EQ(document.root.keys.at(0).name, "a\"b");
    const char* const places[] = {"f:2:3", "f:2:6", "f:2:14", "f:2:21", "f:2:35", "f:2:41"};
    ASSERT_EQ(list.items.size(), std::size(places));
    for (size_t i = 0; i < std::size(places); i++) {
        EXPECT_EQ(document.where(list.items[i].offset), places[i]);
    }
    EXPECT_EQ(list.items[1].number, -2500.0);
    EXPECT_EQ(list.items[2].text, "x\\");
    EXPECT_EQ(document.where(list.items[3].items.at(0).offset), "f:2:28");
}

const JsonNode& child(const JsonNode& node, const std::string& key)
{
    for (size_t i = 0; i < node.keys.size(); i++) {
        if (node.keys[i].name == key) return node.items[i];
    }
    ADD_FAILURE() << "the schema lacks " << key;
    return node;
}

bool has(const JsonNode& node, const std::string& key)
{
    return std::any_of(node.keys.begin(), node.keys.end(),
                       [&](const JsonKey& k) { return k.name == key; });
}

TEST(JsonScene, readsAdaptiveSampling)
{
    const AdaptiveRule none = loadJson(MINIMAL).settings.adaptive;
    EXPECT_EQ(none.rule, ADAPTIVE_NONE);
    const AdaptiveRule standard =
        loadJson(R"({ "integrator": { "adaptive": { "rule": "report" } } })").settings.adaptive;
    EXPECT_EQ(standard.rule, ADAPTIVE_REPORT);
    EXPECT_EQ(standard.epsilon, 1e-4f);
    EXPECT_EQ(standard.minSamples, 20u);
    EXPECT_EQ(standard.maxSamples, 1000u);
    const AdaptiveRule given =
        loadJson(
            R"({ "integrator": { "adaptive": { "rule": "report", "epsilon": 0.5, "minSamples": 3,
                     "maxSamples": 4 } } })")
            .settings.adaptive;
    EXPECT_EQ(given.epsilon, 0.5f);
    EXPECT_EQ(given.minSamples, 3u);
    EXPECT_EQ(given.maxSamples, 4u);
    for (const char* name : {"crossed", "joint"}) {
        const AdaptiveRule rule =
            loadJson(fmt::format(R"({{ "integrator": {{ "adaptive": {{ "rule": "{}", "targetError": 0.25 }} }} }})",
                                 name))
                .settings.adaptive;
        EXPECT_STREQ(adaptiveRuleName(rule.rule), name);
        EXPECT_EQ(rule.targetError, 0.25f);
        EXPECT_EQ(rule.minSamples, 64u);
        EXPECT_EQ(rule.maxSamples, 1024u);
    }
}

TEST(JsonScene, refusesBoundsThatAreNoWholeBlocks)
{
    EXPECT_CONTAINS(
        errorOfJson(R"({ "integrator": { "adaptive": { "rule": "crossed", "maxSamples": 1000 } } })"),
        "maxSamples is 1000, and crossed takes samples in blocks of 8, as many in each half; give a multiple of "
        "16, such as 992");
    EXPECT_CONTAINS(errorOfJson(R"({ "integrator": { "adaptive": { "rule": "joint", "minSamples": 7 } } })"),
                    "minSamples is 7, and joint takes samples in blocks of 8; give a multiple of 8, such as 8");
}

TEST(JsonScene, refusesAdaptiveSamplingWhoseMinimumIsAboveItsMaximum)
{
    EXPECT_CONTAINS(
        errorOfJson(R"({ "integrator": { "adaptive": { "rule": "report", "maxSamples": 10 } } })"),
        "scene.json:1:31: minSamples is 20, above maxSamples, which is 10");
    EXPECT_CONTAINS(
        errorOfJson(R"({ "integrator": { "adaptive": { "threshold": 1 } } })"),
        "unknown key \"threshold\" in \"adaptive\" of the integrator; did you mean \"epsilon\"?");
}

JsonDocument readSchema()
{
    const fs::path path = sourceFolder() / "scenes/schema.json";
    return parseJson("schema.json", readTextFile(path));
}

TEST(Schema, hasTheKeysThatTheReaderHas)
{
    const JsonDocument schema = readSchema();
    for (const KeySet& set : sceneKeys()) {
        const JsonNode& object =
            set.object == "scene" ? schema.root : child(child(schema.root, "$defs"), set.object);
        EXPECT_FALSE(child(object, "additionalProperties").truth) << set.object;
        std::vector<std::string> keys, required;
        for (const JsonKey& key : child(object, "properties").keys) keys.push_back(key.name);
        if (has(object, "required")) {
            for (const JsonNode& key : child(object, "required").items)
                required.push_back(key.text);
        }
        EXPECT_EQ(keys, set.keys) << set.object;
        EXPECT_EQ(required, set.required) << set.object;
    }
}

/// The keys that an object of a kind cannot be without, and what stands around it in a scene.
struct Sample {
    const char* object;
    const char* before;
    const char* after;
};

const Sample SAMPLES[] = {
    {"film", R"({ "film": { )", " } }"},
    {"integrator", R"({ "integrator": { )", " } }"},
    {"adaptive", R"({ "integrator": { "adaptive": { )", " } } }"},
    {"camera", R"({ "camera": { "eye": [0,0,5], "lookAt": [0,0,0], )", " } }"},
    {"directionCamera", R"({ "camera": { "position": [0,0,5], "right": [1,0,0], "up": [0,1,0], )",
     " } }"},
    {"orthographicCamera",
     R"({ "camera": { "type": "orthographic", "eye": [0,0,5], "lookAt": [0,0,0], )", " } }"},
    {"dielectricMaterial", R"({ "materials": { "m": { "type": "dielectric", )", " } } }"},
    {"conductorMaterial", R"({ "materials": { "m": { "type": "conductor", )", " } } }"},
    {"reportMaterial", R"({ "materials": { "m": { "type": "report", )", " } } }"},
    {"spotLight",
     R"({ "lights": [{ "type": "spot", "position": [0,0,0], "direction": [0,0,1], "intensity": [1,1,1], )",
     " }] }"},
    {"environment", R"({ "environment": { "builtin": "studio", )", " } }"},
    {"teapot", R"({ "shapes": [{ "type": "teapot", )", " }] }"},
    {"sphere", R"({ "shapes": [{ "type": "sphere", )", " }] }"},
    {"sphereMesh", R"({ "shapes": [{ "type": "sphereMesh", )", " }] }"},
    {"disk", R"({ "shapes": [{ "type": "disk", )", " }] }"},
};

/// A scene in which one object of the kind has one more key.
std::string sceneWith(const Sample& sample, const std::string& key, const std::string& value)
{
    std::string rest;
    if (sample.object == std::string("disk") && key != "radius") rest = R"(, "radius": 1)";
    if (sample.object == std::string("directionCamera") && key != "fovRad")
        rest = R"(, "fovRad": 1)";
    if (sample.object == std::string("adaptive") && key != "rule") rest = R"(, "rule": "report")";
    return sample.before + ("\"" + key + "\": " + value) + rest + sample.after;
}

/// Follows "$ref" into "$defs".
const JsonNode& resolved(const JsonDocument& schema, const JsonNode& node)
{
    if (!has(node, "$ref")) return node;
    const std::string& path = child(node, "$ref").text;
    return child(child(schema.root, "$defs"), path.substr(path.rfind('/') + 1));
}

/// Returns how many bounds and lists of words were tried.
int tryProperty(const JsonNode& property, const Sample& sample, const std::string& key)
{
    int tried = 0;
    for (const auto& [bound, sign] : {std::pair{"minimum", -1.0}, std::pair{"maximum", 1.0}}) {
        if (!has(property, bound)) continue;
        const double limit = child(property, bound).number;
        const double value = limit + sign * std::max(1.0, limit / 1000);
        EXPECT_CONTAINS(errorOfJson(sceneWith(sample, key, fmt::format("{}", value))),
                        "must lie in");
        tried++;
    }
    if (sample.object == std::string("environment") || !has(property, "enum")) return tried;
    for (const JsonNode& word : child(property, "enum").items) {
        EXPECT_EQ(errorOfJson(sceneWith(sample, key, "\"" + word.text + "\"")), "");
    }
    EXPECT_CONTAINS(errorOfJson(sceneWith(sample, key, "\"nonsense\"")), "is \"nonsense\"");
    return tried + 1;
}

TEST(Schema, statesTheRangesThatTheReaderHolds)
{
    const JsonDocument schema = readSchema();
    int tried = 0;
    for (const Sample& sample : SAMPLES) {
        const JsonNode& properties =
            child(child(child(schema.root, "$defs"), sample.object), "properties");
        for (size_t i = 0; i < properties.keys.size(); i++) {
            tried +=
                tryProperty(resolved(schema, properties.items[i]), sample, properties.keys[i].name);
        }
    }
    EXPECT_GE(tried, 50);
}

/// Writes numbers with a comma, as the German locale does.
struct CommaNumbers : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
};

TEST(Locale, numbersAreReadAlikeInACommaLocale)
{
    const std::locale before = std::locale::global(std::locale(std::locale(), new CommaNumbers));
    for (const char* name : {"de_DE.UTF-8", "de_DE", "fr_FR.UTF-8"}) {
        if (std::setlocale(LC_NUMERIC, name) != nullptr) break;
    }
    SceneFolder files;
    files.write("a.mtl", "newmtl m\nKd 0.5 0.25 0.125\n");
    files.write("a.obj", "mtllib a.mtl\nv 0.5 0 0\nv 1.5 0 0\nv 0 1.5 0\nusemtl m\nf 1 2 3\n");
    files.write("s.json", R"({ "camera": { "eye": [0.5, 1.5, 2.5], "lookAt": [0, 0, 0] },
        "shapes": [{ "type": "mesh", "file": "a.obj" }] })");
    const Scene scene = files.load("s.json");
    const std::string error =
        errorOfJson(R"({ "camera": { "eye": [0,0,5], "lookAt": [0,0,0], "fovDeg": 180.5 } })");
    std::setlocale(LC_NUMERIC, "C");
    std::locale::global(before);
    EXPECT_EQ(scene.camera.position, vec3(0.5f, 1.5f, 2.5f));
    EXPECT_EQ(scene.primitives.at(0).p0, vec3(0.5f, 0, 0));
    EXPECT_EQ(scene.materials.at(0).baseColor, vec3(0.5f, 0.25f, 0.125f));
    EXPECT_CONTAINS(error, "180.5");
}

}  // namespace
}  // namespace sahl
