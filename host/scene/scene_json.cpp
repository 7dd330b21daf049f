// Scene files: JSON, described by scenes/schema.json and scenes/README.md.
#include "scene/camera.h"
#include "scene/numbers.h"
#include "scene/probe.h"
#include "scene/scene_reading.h"

namespace sahl {

namespace {

constexpr Range NOT_NEGATIVE = {0, 1e18};  // radiance, intensity

void readFilm(SceneReading& reading, const JsonNode& node)
{
    JsonObject film(reading.document, node, "the film", "film");
    RenderSettings& settings = reading.scene.settings;
    settings.width = film.uint("width", settings.width, 1, MAX_PICTURE_SIDE);
    settings.height = film.uint("height", settings.height, 1, MAX_PICTURE_SIDE);
}

void readIntegrator(SceneReading& reading, const JsonNode& node)
{
    JsonObject integrator(reading.document, node, "the integrator", "integrator");
    integrator.choice("type", {"path"});
    RenderSettings& settings = reading.scene.settings;
    settings.maxBounces = integrator.uint("maxBounces", settings.maxBounces, 0, MAX_BOUNCES);
    settings.spp = integrator.uint("samplesPerPixel", settings.spp, 1, MAX_SAMPLES);
    settings.seed = integrator.uint("seed", settings.seed, 0, 0xffffffffu);
}

CameraDescription readCamera(const JsonDocument& document, const JsonNode& node)
{
    JsonObject object(document, node, "the camera", "camera");
    CameraDescription camera;
    camera.eye = object.vector("eye", camera.eye);
    camera.lookAt = object.vector("lookAt", camera.lookAt);
    camera.up = object.vector("up", camera.up);
    camera.fovDeg = object.number("fovDeg", camera.fovDeg, {});
    camera.fovHorizontal = object.choice("fovAxis", {"vertical", "horizontal"}) == "horizontal";
    return camera;
}

void readMaterials(SceneReading& reading, const JsonNode& node)
{
    const JsonDocument& document = reading.document;
    if (node.kind != JsonNode::Kind::object) {
        throw errorAt(document, node, "\"materials\" must be an object: a name for each material");
    }
    for (size_t i = 0; i < node.keys.size(); i++) {
        const std::string& name = node.keys[i].name;
        if (name.empty())
            throw badInput("{}: a material needs a name", document.where(node.keys[i].offset));
        JsonObject material(document, node.items[i], fmt::format("material \"{}\"", name),
                            "material");
        material.choice("type", {"lambert"});
        glm::dvec3 color = material.vector("baseColor", glm::dvec3(0.7), {0, 1});
        glm::dvec3 emission = material.vector("emission", {}, NOT_NEGATIVE);
        reading.materials[name] =
            addMaterial(reading.scene, name, toFloat(color), toFloat(emission));
    }
}

void readLight(SceneReading& reading, const JsonNode& node)
{
    readType(reading.document, node, "a light", {"point"});
    JsonObject light(reading.document, node, "a point light", "pointLight");
    vec3 position = toFloat(light.vector("position", {}));
    vec3 intensity = toFloat(light.vector("intensity", {}, NOT_NEGATIVE));
    Light point = {};
    point.type = LIGHT_POINT;
    point.position = position;
    point.intensity = intensity;
    reading.scene.lights.push_back(point);
}

uint filterOf(const JsonObject& environment, const SceneOptions& options)
{
    return probeFilter(
        options.probeFilter.value_or(environment.choice("filter", {"bilinear", "nearest"})));
}

void readEnvironmentFile(SceneReading& reading, const JsonObject& environment)
{
    std::string where = reading.document.where(environment.at("file").offset);
    fs::path path =
        resolvePath(reading.policy, reading.folder, environment.string("file", ""), where);
    std::string mapping = environment.choice("mapping", {"latlong", "angular"});
    setProbe(reading.scene, readImage(path),
             probeMapping(reading.options.probeMapping.value_or(mapping)),
             filterOf(environment, reading.options), path.string());
}

void readEnvironment(SceneReading& reading, const JsonNode& node)
{
    JsonObject environment(reading.document, node, "the environment", "environment");
    int sources =
        environment.has("file") + environment.has("radiance") + environment.has("builtin");
    if (sources != 1) {
        throw errorAt(
            reading.document, node,
            "the environment needs exactly one of \"file\", \"radiance\" and \"builtin\"");
    }
    if (environment.has("file")) return readEnvironmentFile(reading, environment);
    if (environment.has("mapping")) {
        throw errorAt(reading.document, environment.at("mapping"),
                      "\"mapping\" goes with \"file\" only");
    }
    uint filter = filterOf(environment, reading.options);
    if (environment.has("builtin")) {
        environment.choice("builtin", {"studio"});
        setProbe(reading.scene, makeStudioProbe(STUDIO_WIDTH, STUDIO_HEIGHT), PROBE_LATLONG, filter,
                 "studio");
        return;
    }
    vec3 radiance = toFloat(environment.vector("radiance", {}, NOT_NEGATIVE));
    setProbe(reading.scene, {1, 1, {radiance.x, radiance.y, radiance.z}}, PROBE_LATLONG, filter,
             "radiance");
}

void checkTopLevelText(const JsonObject& file)
{
    file.string("$schema", "");
    file.string("description", "");
}

}  // namespace

Scene loadJsonScene(const fs::path& path, const SceneOptions& options)
{
    JsonDocument document = parseJson(path.string(), readTextFile(path, MAX_JSON_BYTES));
    Scene scene;
    scene.name = path.string();
    SceneReading reading{
        document, options, {folderOf(path), options.allowedPaths}, folderOf(path), scene, {}, {}};

    JsonObject file(document, document.root, "the scene", "scene");
    checkTopLevelText(file);
    if (const JsonNode* film = file.find("film")) readFilm(reading, *film);
    if (const JsonNode* integrator = file.find("integrator")) readIntegrator(reading, *integrator);
    applyOptions(scene.settings, options);
    checkPictureSize(scene.settings, scene.name);
    if (const JsonNode* materials = file.find("materials")) readMaterials(reading, *materials);
    if (const JsonNode* shapes = file.find("shapes")) {
        for (const JsonNode& shape : readArray(document, *shapes, "\"shapes\""))
            readShape(reading, shape);
    }
    if (const JsonNode* lights = file.find("lights")) {
        for (const JsonNode& light : readArray(document, *lights, "\"lights\""))
            readLight(reading, light);
    }
    const JsonNode* environment = file.find("environment");
    if (options.probe)
        applyProbeOption(scene, options);
    else if (environment)
        readEnvironment(reading, *environment);

    const JsonNode* camera = file.find("camera");
    CameraDescription description = camera ? readCamera(document, *camera) : frameTriangles(scene);
    try {
        scene.camera = makeCamera(description, scene.settings.width, scene.settings.height);
    } catch (const Error& error) {
        throw camera ? errorAt(document, *camera, error.what()) : error;
    }
    return scene;
}

}  // namespace sahl
