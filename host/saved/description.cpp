#include "saved/description.h"

#include "bvh/build_names.h"
#include "scene/adaptive.h"
#include "scene/json_fields.h"
#include "scene/phong.h"
#include "scene/probe.h"
#include "scene/sampling.h"
#include "scene/scene_reading.h"

#include <cfloat>
#include <limits>

namespace sahl {

namespace {

using Json = nlohmann::ordered_json;

constexpr uint32_t ANY_UINT = std::numeric_limits<uint32_t>::max();
constexpr Range DISTANCE = {1e-9, 1e18};  // [m]

const KeySet DESCRIPTION = {
    "",
    {"settings", "camera", "probe", "background", "tree", "droppedTriangles"},
    {"settings", "camera", "probe", "tree", "droppedTriangles"}};
const std::vector<std::string> SETTINGS_KEYS = {
    "width",   "height",        "samplesPerPixel", "maxBounces",   "seed",    "integrator",
    "jitter",  "terms",         "shadows",         "normals",      "ambient", "adaptive",
    "sampler", "rouletteDepth", "clampIndirect",   "lightSampling"};
static_assert(sizeof(RenderSettings) == 92, "is the new setting saved, too?");
const KeySet SETTINGS = {"", SETTINGS_KEYS, SETTINGS_KEYS};
constexpr std::initializer_list<const char*> LIGHT_SAMPLING = {"mis", "lights",
                                                               "bsdf"};  // by LIGHTS_*
const KeySet CAMERA = {"",
                       {"eye", "lookAt", "up", "axes", "fovDeg", "fovHorizontal",
                        "orthographicHeight", "lensRadius", "focusDistance", "framed"},
                       {"eye", "lookAt", "up", "fovDeg", "fovHorizontal", "lensRadius"}};
const KeySet AXES = {"", {"right", "up", "leftHanded"}, {"right", "up", "leftHanded"}};
const KeySet FRAMED = {"", {"lo", "hi"}, {"lo", "hi"}};
const KeySet PROBE = {
    "",
    {"width", "height", "mapping", "filter", "firstTexel", "axisX", "axisY", "axisZ"},
    {"width", "height", "mapping", "filter", "firstTexel", "axisX", "axisY", "axisZ"}};
const KeySet TREE = {"", {"build", "rootRef", "sahCost"}, {"build"}};  // the rest not as JSON

template <class Vector>
Json jsonOf(const Vector& v)
{
    return {double(v.x), double(v.y), double(v.z)};
}

Json describe(const RenderSettings& settings)
{
    Json terms = Json::array();
    for (const PhongTerm& term : phongTerms()) {
        if ((settings.shading & term.bit) != 0) terms.push_back(term.name);
    }
    return {{"width", settings.width},
            {"height", settings.height},
            {"samplesPerPixel", settings.spp},
            {"maxBounces", settings.maxBounces},
            {"seed", settings.seed},
            {"integrator", settings.integrator == INTEGRATOR_PHONG ? "phong" : "path"},
            {"sampler", samplerName(settings.samplerKind)},
            {"rouletteDepth", settings.rouletteDepth},
            {"clampIndirect", double{settings.clampIndirect}},
            {"lightSampling", LIGHT_SAMPLING.begin()[settings.lightSampling]},
            {"jitter", settings.jitter},
            {"terms", terms},
            {"shadows", (settings.shading & SHADING_SHADOWS) != 0},
            {"normals", (settings.shading & SHADING_FLAT) != 0 ? "flat" : "interpolated"},
            {"ambient", jsonOf(settings.ambient)},
            {"adaptive",
             {{"rule", adaptiveRuleName(settings.adaptive.rule)},
              {"epsilon", double{settings.adaptive.epsilon}},
              {"targetError", double{settings.adaptive.targetError}},
              {"minSamples", settings.adaptive.minSamples},
              {"maxSamples", settings.adaptive.maxSamples}}}};
}

Json describe(const CameraDescription& camera)
{
    Json json = {{"eye", jsonOf(camera.eye)},
                 {"lookAt", jsonOf(camera.lookAt)},
                 {"up", jsonOf(camera.up)},
                 {"fovDeg", camera.fovDeg},
                 {"fovHorizontal", camera.fovHorizontal},
                 {"lensRadius", camera.lensRadius}};
    if (camera.axes) {
        json["axes"] = {{"right", jsonOf(camera.axes->right)},
                        {"up", jsonOf(camera.axes->up)},
                        {"leftHanded", camera.axes->leftHanded}};
    }
    if (camera.orthographicHeight) json["orthographicHeight"] = *camera.orthographicHeight;
    if (camera.focusDistance) json["focusDistance"] = *camera.focusDistance;
    if (camera.framed) {
        json["framed"] = {{"lo", jsonOf(camera.framed->lo)}, {"hi", jsonOf(camera.framed->hi)}};
    }
    return json;
}

Json describe(const Probe& probe)
{
    return {{"width", probe.width},
            {"height", probe.height},
            {"mapping", probe.mapping == PROBE_ANGULAR ? "angular" : "latlong"},
            {"filter", probe.filterMode == FILTER_NEAREST ? "nearest" : "bilinear"},
            {"firstTexel", probe.firstTexel},
            {"axisX", jsonOf(probe.axisX)},
            {"axisY", jsonOf(probe.axisY)},
            {"axisZ", jsonOf(probe.axisZ)}};
}

RenderSettings readSettings(const JsonObject& object)
{
    RenderSettings settings;
    settings.width = object.uint("width", 0, 1, MAX_PICTURE_SIDE);
    settings.height = object.uint("height", 0, 1, MAX_PICTURE_SIDE);
    settings.spp = object.uint("samplesPerPixel", 0, 1, MAX_SAMPLES);
    settings.samplerKind = samplerNamed(object.choice("sampler", SAMPLERS));
    settings.rouletteDepth = object.uint("rouletteDepth", NO_ROULETTE, 0, ANY_UINT);
    settings.clampIndirect = static_cast<float>(object.number("clampIndirect", 0, {0, FLT_MAX}));
    const std::string lightSampling = object.choice("lightSampling", LIGHT_SAMPLING);
    settings.lightSampling = static_cast<uint32_t>(
        std::find(LIGHT_SAMPLING.begin(), LIGHT_SAMPLING.end(), lightSampling) -
        LIGHT_SAMPLING.begin());
    settings.maxBounces = object.uint("maxBounces", 0, 0, MAX_BOUNCES);
    settings.seed = object.uint("seed", 0, 0, ANY_UINT);
    const bool phong = object.choice("integrator", {"path", "phong"}) == "phong";
    settings.integrator = phong ? INTEGRATOR_PHONG : INTEGRATOR_PATH;
    settings.jitter = object.boolean("jitter", true);
    readShading(object, settings);
    readAdaptive(object.document(), object.at("adaptive"), settings);
    return settings;
}

CameraDescription readCameraDescription(const JsonObject& object)
{
    const JsonDocument& document = object.document();
    CameraDescription camera;
    camera.eye = object.vector("eye", {});
    camera.lookAt = object.vector("lookAt", {});
    camera.up = object.vector("up", {});
    camera.fovDeg = object.number("fovDeg", 0, {});
    camera.fovHorizontal = object.boolean("fovHorizontal", false);
    camera.lensRadius = object.number("lensRadius", 0, {0, DISTANCE.hi});
    if (const JsonNode* node = object.find("axes")) {
        const JsonObject axes(document, *node, "the axes", AXES);
        camera.axes = {axes.vector("right", {}), axes.vector("up", {}),
                       axes.boolean("leftHanded", false)};
    }
    if (object.has("orthographicHeight"))
        camera.orthographicHeight = object.number("orthographicHeight", 1, DISTANCE);
    if (object.has("focusDistance"))
        camera.focusDistance = object.number("focusDistance", 1, DISTANCE);
    if (const JsonNode* node = object.find("framed")) {
        const JsonObject framed(document, *node, "the framed box", FRAMED);
        camera.framed = {framed.vector("lo", {}), framed.vector("hi", {})};
    }
    return camera;
}

Probe readProbe(const JsonDocument& document, const JsonNode& node, const std::string& what)
{
    const JsonObject object(document, node, what, PROBE);
    Probe probe = {};
    probe.width = object.uint("width", 0, 0, ANY_UINT);
    probe.height = object.uint("height", 0, 0, ANY_UINT);
    probe.mapping = probeMapping(object.choice("mapping", {"latlong", "angular"}));
    probe.filterMode = probeFilter(object.choice("filter", {"bilinear", "nearest"}));
    probe.firstTexel = object.uint("firstTexel", 0, 0, ANY_UINT);
    probe.axisX = vec3(object.vector("axisX", {}));
    probe.axisY = vec3(object.vector("axisY", {}));
    probe.axisZ = vec3(object.vector("axisZ", {}));
    return probe;
}

void readTree(const JsonObject& object, Bvh& bvh)
{
    const std::string build = object.choice("build", {"sweep", "binned", "high"});
    for (BvhBuild known : {BvhBuild::sweep, BvhBuild::binned, BvhBuild::high})
        if (build == nameOf(known)) bvh.statistics.build = known;
    bvh.rootRef = object.uint("rootRef", REF_NONE, 0, ANY_UINT);
    bvh.statistics.sahCost = object.number("sahCost", 0, {0, std::numeric_limits<double>::max()});
}

Error needsOriginal(const std::string& file, const std::string& option)
{
    return usageError("{}: is a saved scene; {} needs the scene that it was saved from: give it to "
                      "sahl bvh SCENE {} -o x.sahl",
                      file, option, option);
}

void applySceneOptions(const SceneOptions& options, Scene& scene)
{
    if (options.smoothNormals) throw needsOriginal(scene.name, "--smooth-normals");
    if (options.probeMapping && !options.probe) throw needsOriginal(scene.name, "--probe-mapping");
    applyOptions(scene.settings, options);
    if (options.probeFilter && !options.probe)
        scene.probe.filterMode = probeFilter(*options.probeFilter);
}

}  // namespace

Json describe(const PreparedScene& prepared)
{
    const Scene& scene = prepared.scene;
    if (!scene.cameraDescription) {
        throw badInput("{}: nothing says how its camera was made, so it cannot be saved; place the "
                       "camera by placeCamera()",
                       scene.name);
    }
    Json json = {{"settings", describe(scene.settings)},
                 {"camera", describe(*scene.cameraDescription)},
                 {"probe", describe(scene.probe)}};
    if (scene.background) json["background"] = describe(*scene.background);
    const BvhStatistics& tree = prepared.bvh.statistics;
    json["tree"] = {{"build", nameOf(tree.build)},
                    {"rootRef", prepared.bvh.rootRef},
                    {"sahCost", tree.sahCost}};
    json["droppedTriangles"] = scene.droppedTriangles;
    return json;
}

Camera readDescription(const JsonDocument& document, const std::vector<std::string>& more,
                       const SceneOptions& options, PreparedScene& prepared)
{
    KeySet keys = DESCRIPTION;
    keys.keys.insert(keys.keys.end(), more.begin(), more.end());
    keys.required.insert(keys.required.end(), more.begin(), more.end());
    const JsonObject object(document, document.root, "the description", keys);
    Scene& scene = prepared.scene;
    scene.settings =
        readSettings(JsonObject(document, object.at("settings"), "the settings", SETTINGS));
    scene.probe = readProbe(document, object.at("probe"), "the probe");
    if (const JsonNode* background = object.find("background"))
        scene.background = readProbe(document, *background, "the background");
    readTree(JsonObject(document, object.at("tree"), "the tree", TREE), prepared.bvh);
    scene.droppedTriangles =
        static_cast<uint64_t>(object.number("droppedTriangles", 0, {0, 9007199254740992.0}));
    const RenderSettings saved = scene.settings;
    applySceneOptions(options, scene);
    checkPictureSize(scene.settings, scene.name);
    const JsonObject camera(document, object.at("camera"), "the camera", CAMERA);
    const CameraDescription description = readCameraDescription(camera);
    try {
        placeCamera(scene, description);
        return makeCamera(description, saved.width, saved.height);
    } catch (const Error& error) {
        throw errorAt(document, camera.node(), error.what());
    }
}

void requireReach(const PreparedScene& prepared, const Camera& saved)
{
    const RenderSettings& settings = prepared.scene.settings;
    if (prepared.deviceScene().instances.empty()) return;
    if (reachOf(prepared.scene.camera) <= reachOf(saved)) return;
    throw usageError(
        "{}: a picture of {} x {} pixels moves the camera farther away than the tree of "
        "this saved scene allows; save the original scene with that --width and --height",
        prepared.scene.name, settings.width, settings.height);
}

void replaceProbe(const SceneOptions& options, PreparedScene& prepared)
{
    if (!options.probe) return;
    Scene& scene = prepared.scene;
    const std::span<const vec4> saved = prepared.deviceScene().probeTexels;
    std::optional<Probe> background = scene.background;
    std::vector<vec4> kept;
    if (background) {
        const auto begin = saved.begin() + background->firstTexel;
        kept.assign(begin, begin + size_t{background->width} * background->height);
    }
    applyProbeOption(scene, options);
    if (background) {
        background->firstTexel = static_cast<uint>(scene.probeTexels.size());
        scene.probeTexels.insert(scene.probeTexels.end(), kept.begin(), kept.end());
        scene.background = background;
    }
}

}  // namespace sahl
