// The environment of scene files, and the background that the camera sees in its place.
#include "scene/numbers.h"
#include "scene/probe.h"
#include "scene/scene_reading.h"

namespace sahl {

namespace {

/// A picture of the light from all around, before it becomes texels.
struct ProbeSource {
    Image picture;
    ProbeLook look;
    std::string name;  ///< for messages
};

void requireOneSource(const JsonObject& object)
{
    if (object.has("file") + object.has("radiance") + object.has("builtin") != 1) {
        throw errorAt(object.document(), object.node(),
                      fmt::format("{} needs exactly one of \"file\", \"radiance\" and \"builtin\"",
                                  object.what()));
    }
    if (object.has("mapping") && !object.has("file")) {
        throw errorAt(object.document(), object.at("mapping"),
                      "\"mapping\" goes with \"file\" only");
    }
}

glm::dmat3 readProbeRotation(const JsonObject& object)
{
    const JsonNode* node = object.find("rotateDeg");
    if (!node) return glm::dmat3(1.0);
    const std::string what = "\"rotateDeg\" of " + object.what();
    if (node->kind == JsonNode::Kind::number) {
        return rotation({0, 1, 0}, readNumber(object.document(), *node, what, ANGLE_RANGE)).linear;
    }
    return readRotation(object.document(), *node, what).linear;
}

ProbeSource readSource(const SceneReading& reading, const JsonObject& object)
{
    requireOneSource(object);
    ProbeSource source;
    source.look.mapping = probeMapping(object.choice("mapping", {"latlong", "angular"}));
    source.look.filter = probeFilter(object.choice("filter", {"bilinear", "nearest"}));
    source.look.scale = object.number("scale", 1, LIGHT_RANGE);
    source.look.rotation = readProbeRotation(object);
    if (object.has("file")) {
        const std::string where = object.document().where(object.at("file").offset);
        const fs::path path =
            resolvePath(reading.policy, reading.folder, object.string("file", ""), where);
        source.picture = readImage(path);
        source.name = path.string();
    } else if (object.has("builtin")) {
        source.name = object.choice("builtin", BUILTIN_PROBES);
        source.picture = makeBuiltinProbe(source.name);
    } else {
        const vec3 radiance = toFloat(object.vector("radiance", {}, LIGHT_RANGE));
        source.name = "radiance";
        source.picture = {1, 1, {radiance.x, radiance.y, radiance.z}};
    }
    return source;
}

}  // namespace

void readEnvironment(SceneReading& reading, const JsonNode& node)
{
    const JsonObject object(reading.document, node, "the environment", "environment");
    ProbeSource source = readSource(reading, object);
    const SceneOptions& options = reading.options;
    if (options.probeMapping && object.has("file"))
        source.look.mapping = probeMapping(*options.probeMapping);
    if (options.probeFilter) source.look.filter = probeFilter(*options.probeFilter);
    reading.scene.probe =
        appendProbe(reading.scene.probeTexels, source.picture, source.look, source.name);
}

void readBackground(SceneReading& reading, const JsonNode& node)
{
    const JsonObject object(reading.document, node, "the background", "environment");
    const ProbeSource source = readSource(reading, object);
    reading.scene.background =
        appendProbe(reading.scene.probeTexels, source.picture, source.look, source.name);
}

}  // namespace sahl
