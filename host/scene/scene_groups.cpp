// Groups of scene files: collections with a transform, and shared ones that instances place.
//
// A shape "group" is flattened while it is read: its shapes become the world's. An entry of
// "groups" is read once into an object of its own; what is nested in it are instances of other
// objects, so that placing it places all of them: two levels, however deep the file.
#include "scene/scene_reading.h"

namespace sahl {

namespace {

constexpr size_t MAX_GROUP_DEPTH = 32;

void readShapes(SceneReading& reading, const JsonObject& object)
{
    const std::string what = "\"shapes\" of " + object.what();
    for (const JsonNode& shape : readArray(object.document(), object.at("shapes"), what))
        readShape(reading, shape);
}

/// Counts those inside shared groups too: each of them is stored once more where the group is
/// placed.
void addPlacement(SceneReading& reading, const JsonObject& shape, const Placement& placement)
{
    if (!isPlaceable(placement)) {
        throw errorAt(shape.document(), shape.node(),
                      fmt::format("{} is stretched or shrunk by more than {:g}, or flattened; an "
                                  "instance must be invertible",
                                  shape.what(), LARGEST_STRETCH));
    }
    if (reading.placements >= MAX_INSTANCES) {
        throw errorAt(shape.document(), shape.node(),
                      fmt::format("more than {} instances, those inside groups counted wherever "
                                  "the group is placed",
                                  MAX_INSTANCES));
    }
    reading.placements++;
    reading.scene.instances.push_back(placement);
}

/// "a -> b -> a"
std::string chainOf(const SceneReading& reading, const std::string& name)
{
    std::string chain;
    for (const std::string& open : reading.openGroups) chain += open + " -> ";
    return chain + name;
}

void requireNoCycle(const SceneReading& reading, const std::string& name, const JsonNode& place)
{
    for (const std::string& open : reading.openGroups) {
        if (open == name) {
            throw errorAt(
                reading.document, place,
                fmt::format("group \"{}\" contains itself: {}", name, chainOf(reading, name)));
        }
    }
    if (reading.openGroups.size() >= MAX_GROUP_DEPTH) {
        throw errorAt(reading.document, place,
                      fmt::format("groups are nested more than {} deep: {}", MAX_GROUP_DEPTH,
                                  chainOf(reading, name)));
    }
}

/// Reads the shapes of a shared group as if they were a scene of their own.
SharedGroup readSharedGroup(SceneReading& reading, const std::string& name, const JsonNode& node)
{
    const JsonObject object(reading.document, node, fmt::format("group \"{}\"", name),
                            "sharedGroup");
    object.string("description", "");
    Scene& scene = reading.scene;
    std::vector<Primitive> primitives;
    std::vector<Placement> instances;
    std::vector<uint32_t> objectStarts;
    Transform outer;
    auto exchange = [&] {
        std::swap(scene.primitives, primitives);
        std::swap(scene.instances, instances);
        std::swap(scene.objectStarts, objectStarts);
        std::swap(reading.outer, outer);
    };
    exchange();
    reading.openGroups.push_back(name);
    readShapes(reading, object);
    reading.openGroups.pop_back();
    exchange();
    // `primitives` and `instances` are the group's now.

    SharedGroup group;
    if (!primitives.empty()) {
        Placement own;
        own.object = static_cast<uint>(scene.objects.size());
        scene.objects.push_back(std::move(primitives));
        group.inside.push_back(own);
    }
    group.inside.insert(group.inside.end(), instances.begin(), instances.end());
    return group;
}

/// The group of a name, read when it is first asked for.
///   place  where the name stands, for messages
const SharedGroup& sharedGroup(SceneReading& reading, const std::string& name,
                               const JsonNode& place)
{
    const auto read = reading.groups.find(name);
    if (read != reading.groups.end()) return read->second;
    const auto node = reading.groupNodes.find(name);
    if (node == reading.groupNodes.end()) {
        std::vector<std::string> names;
        for (const auto& [known, value] : reading.groupNodes) names.push_back(known);
        const std::string near = suggestion(name, names);
        throw errorAt(reading.document, place,
                      fmt::format("group \"{}\" is not defined{}", name,
                                  near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near)));
    }
    requireNoCycle(reading, name, place);
    return reading.groups.emplace(name, readSharedGroup(reading, name, *node->second))
        .first->second;
}

}  // namespace

void readGroups(SceneReading& reading, const JsonNode& node)
{
    const JsonDocument& document = reading.document;
    if (node.kind != JsonNode::Kind::object)
        throw errorAt(document, node, "\"groups\" must be an object: a name for each group");
    for (size_t i = 0; i < node.keys.size(); i++) {
        if (node.keys[i].name.empty())
            throw badInput("{}: a group needs a name", document.where(node.keys[i].offset));
        reading.groupNodes.emplace(node.keys[i].name, &node.items[i]);
    }
    for (const auto& [name, value] : reading.groupNodes) sharedGroup(reading, name, *value);
}

void readGroupShape(SceneReading& reading, const JsonObject& shape)
{
    const Transform outer = reading.outer;
    reading.outer = readTransform(reading, shape);
    readShapes(reading, shape);
    reading.outer = outer;
}

void readInstance(SceneReading& reading, const JsonObject& shape)
{
    const SharedGroup& group = sharedGroup(reading, shape.string("of", ""), shape.at("of"));
    const Transform transform = readTransform(reading, shape);
    const uint32_t material =
        shape.has("material") ? readMaterialName(reading, shape) : NO_MATERIAL;
    for (const Placement& inside : group.inside) {
        const Transform whole = compose(transform, {inside.linear, inside.translation});
        Placement placement;
        placement.linear = whole.linear;
        placement.translation = whole.translation;
        placement.object = inside.object;
        placement.material = material != NO_MATERIAL ? material : inside.material;
        addPlacement(reading, shape, placement);
    }
}

}  // namespace sahl
