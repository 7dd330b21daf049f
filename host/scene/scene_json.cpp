// Scene files: JSON, described by scenes/schema.json and scenes/README.md.
#include "scene/adaptive.h"
#include "scene/camera.h"
#include "scene/sampling.h"
#include "scene/scene_reading.h"
#include "util/gzip.h"

namespace sahl {

namespace {

void readFilm(SceneReading& reading, const JsonNode& node)
{
    JsonObject film(reading.document, node, "the film", "film");
    RenderSettings& settings = reading.scene.settings;
    settings.width = film.uint("width", settings.width, 1, MAX_PICTURE_SIDE);
    settings.height = film.uint("height", settings.height, 1, MAX_PICTURE_SIDE);
    settings.jitter = film.boolean("jitter", settings.jitter);
}

void readIntegrator(SceneReading& reading, const JsonNode& node)
{
    JsonObject integrator(reading.document, node, "the integrator", "integrator");
    RenderSettings& settings = reading.scene.settings;
    bool phong = integrator.choice("type", {"path", "phong"}) == "phong";
    settings.integrator = phong ? INTEGRATOR_PHONG : INTEGRATOR_PATH;
    settings.maxBounces = integrator.uint("maxBounces", settings.maxBounces, 0, MAX_BOUNCES);
    settings.spp = integrator.uint("samplesPerPixel", settings.spp, 1, MAX_SAMPLES);
    settings.seed = integrator.uint("seed", settings.seed, 0, 0xffffffffu);
    readShading(integrator, settings);
    readSampling(integrator, settings);
    if (const JsonNode* adaptive = integrator.find("adaptive")) readAdaptive(reading.document, *adaptive, settings);
}

void checkTopLevelText(const JsonObject& file)
{
    file.string("$schema", "");
    file.string("description", "");
}

}  // namespace

Scene loadJsonScene(const fs::path& path, const SceneOptions& options)
{
    JsonDocument document = parseJson(path.string(), readUnpackedText(path, MAX_JSON_BYTES));
    Scene scene;
    scene.name = path.string();
    SceneReading reading{
        document, options, {folderOf(path), options.allowedPaths}, folderOf(path), scene, {},
        {},       {}};

    JsonObject file(document, document.root, "the scene", "scene");
    checkTopLevelText(file);
    if (const JsonNode* film = file.find("film")) readFilm(reading, *film);
    if (const JsonNode* integrator = file.find("integrator")) readIntegrator(reading, *integrator);
    applyOptions(scene.settings, options);
    checkPictureSize(scene.settings, scene.name);
    const JsonNode* environment = file.find("environment");
    if (options.probe)
        applyProbeOption(scene, options);
    else if (environment)
        readEnvironment(reading, *environment);
    if (const JsonNode* background = file.find("background")) readBackground(reading, *background);
    sayThreadsMayStart(options);

    if (const JsonNode* materials = file.find("materials")) readMaterials(reading, *materials);
    if (const JsonNode* groups = file.find("groups")) readGroups(reading, *groups);
    if (const JsonNode* shapes = file.find("shapes")) {
        for (const JsonNode& shape : readArray(document, *shapes, "\"shapes\""))
            readShape(reading, shape);
    }
    if (const JsonNode* lights = file.find("lights")) {
        for (const JsonNode& light : readArray(document, *lights, "\"lights\""))
            readLight(reading, light);
    }
    if (const JsonNode* camera = file.find("camera"))
        readCamera(reading, *camera);
    else
        placeCamera(scene, framePrimitives(scene));
    return scene;
}

}  // namespace sahl
