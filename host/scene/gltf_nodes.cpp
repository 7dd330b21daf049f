// The tree of nodes of a glTF file.
#include "scene/gltf_model.h"
#include "scene/numbers.h"

#include <algorithm>
#include <cmath>

namespace sahl {

namespace {

struct Node {
    Transform local;
    std::vector<uint32_t> children;
    std::optional<uint32_t> parent;
    GltfPlacedNode content;  ///< its toWorld is not used
};

/// A file of 16 numbers, column by column.
Transform readNodeMatrix(const JsonObject& node)
{
    const std::vector<double> m = numbersOf(node, "matrix", std::vector<double>(16));
    if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1) {
        throw errorAt(
            node.document(), node.at("matrix"),
            fmt::format("the last row of \"matrix\" of {} must be 0, 0, 0, 1", node.what()));
    }
    return {glm::dmat3({m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}),
            {m[12], m[13], m[14]}};
}

/// The rotation of a quaternion x, y, z, w.
Transform readNodeRotation(const JsonObject& node)
{
    std::vector<double> q = numbersOf(node, "rotation", {0, 0, 0, 1}, {-1, 1});
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(std::abs(length - 1) <= 0.01)) {
        throw errorAt(
            node.document(), node.at("rotation"),
            fmt::format("\"rotation\" of {} must be a unit quaternion; its length is {:.6g}",
                        node.what(), length));
    }
    const double x = q[0] / length, y = q[1] / length, z = q[2] / length, w = q[3] / length;
    return {glm::dmat3({1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
                       {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
                       {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}),
            glm::dvec3(0.0)};
}

Transform readLocal(const JsonObject& node)
{
    const bool hasParts = node.has("translation") || node.has("rotation") || node.has("scale");
    if (node.has("matrix")) {
        if (hasParts) {
            throw errorAt(node.document(), node.at("matrix"),
                          fmt::format("{} has both \"matrix\" and translation, rotation or scale",
                                      node.what()));
        }
        return readNodeMatrix(node);
    }
    const Transform turned =
        compose(readNodeRotation(node), scaling(node.vector("scale", glm::dvec3(1.0))));
    return compose(translation(node.vector("translation", glm::dvec3(0.0))), turned);
}

Node readNode(GltfFile& file, const JsonNode& json, size_t index)
{
    const JsonObject object(file.document, json, fmt::format("node {}", index));
    object.string("name", "");
    Node node;
    node.local = readLocal(object);
    node.content.mesh = indexOf(object, "mesh", countOf(file, "meshes"), "meshes");
    node.content.camera = indexOf(object, "camera", countOf(file, "cameras"), "cameras");
    if (const auto light = extensionOf(object, "KHR_lights_punctual"))
        node.content.light = requiredIndex(*light, "light", lightCountOf(file), "lights");
    if (indexOf(object, "skin", countOf(file, "skins"), "skins")) {
        if (!node.content.mesh)
            throw errorAt(file.document, json,
                          fmt::format("{} has a skin and no mesh", object.what()));
        leaveOut(file, "skins are left out: their meshes keep the pose in which they are stored");
    }
    const size_t count = countOf(file, "nodes");
    for (const JsonNode& child : itemsOf(object, "children")) {
        node.children.push_back(
            readIndex(file.document, child, "a child of " + object.what(), count, "nodes"));
    }
    return node;
}

/// Gives nodes their parents; throws when one has two.
void linkParents(const GltfFile& file, std::vector<Node>& nodes)
{
    const auto& items = itemsOf(file.root(), "nodes");
    for (uint32_t i = 0; i < nodes.size(); i++) {
        for (const uint32_t child : nodes[i].children) {
            if (nodes[child].parent) {
                throw errorAt(file.document, items[i],
                              fmt::format("node {} is a child of node {} and of node {}", child,
                                          *nodes[child].parent, i));
            }
            nodes[child].parent = i;
        }
    }
}

/// Throws when nodes are below themselves. Each has one parent at most, so such nodes are those
/// that no way down from a node without parent leads to.
void requireTrees(const GltfFile& file, const std::vector<Node>& nodes)
{
    std::vector<bool> reached(nodes.size(), false);
    std::vector<uint32_t> open;
    for (uint32_t i = 0; i < nodes.size(); i++) {
        if (!nodes[i].parent) open.push_back(i);
    }
    while (!open.empty()) {
        const uint32_t node = open.back();
        open.pop_back();
        reached[node] = true;
        open.insert(open.end(), nodes[node].children.begin(), nodes[node].children.end());
    }
    const auto lost = std::find(reached.begin(), reached.end(), false);
    if (lost == reached.end()) return;
    const auto index = static_cast<size_t>(lost - reached.begin());
    throw errorAt(file.document, itemsOf(file.root(), "nodes")[index],
                  fmt::format("node {} is below itself", index));
}

/// Roots of the scene that is shown; checks those of all scenes.
std::vector<uint32_t> readRoots(const GltfFile& file, const std::vector<Node>& nodes)
{
    const auto& scenes = itemsOf(file.root(), "scenes");
    const std::optional<uint32_t> shown = indexOf(file.root(), "scene", scenes.size(), "scenes");
    std::vector<uint32_t> roots;
    for (uint32_t i = 0; i < scenes.size(); i++) {
        const JsonObject scene(file.document, scenes[i], fmt::format("scene {}", i));
        scene.string("name", "");
        for (const JsonNode& item : itemsOf(scene, "nodes")) {
            const uint32_t root =
                readIndex(file.document, item, "a node of " + scene.what(), nodes.size(), "nodes");
            if (nodes[root].parent) {
                throw errorAt(file.document, item,
                              fmt::format("node {} of {} is below node {}; it must be a root", root,
                                          scene.what(), *nodes[root].parent));
            }
            if (i != shown.value_or(0)) continue;
            if (std::find(roots.begin(), roots.end(), root) != roots.end())
                throw errorAt(file.document, item,
                              fmt::format("{} has node {} twice", scene.what(), root));
            roots.push_back(root);
        }
    }
    if (!scenes.empty()) return roots;
    for (uint32_t i = 0; i < nodes.size(); i++) {
        if (!nodes[i].parent) roots.push_back(i);
    }
    return roots;
}

bool isFinite(const Transform& t)
{
    return sahl::isFinite(t.linear[0]) && sahl::isFinite(t.linear[1]) &&
           sahl::isFinite(t.linear[2]) && sahl::isFinite(t.translation);
}

}  // namespace

std::vector<GltfPlacedNode> readGltfNodes(GltfFile& file)
{
    const auto& items = itemsOf(file.root(), "nodes");
    std::vector<Node> nodes;
    for (size_t i = 0; i < items.size(); i++) nodes.push_back(readNode(file, items[i], i));
    linkParents(file, nodes);
    requireTrees(file, nodes);

    struct Open {
        uint32_t node;
        Transform above;
    };
    std::vector<Open> open;
    const std::vector<uint32_t> roots = readRoots(file, nodes);
    for (auto root = roots.rbegin(); root != roots.rend(); ++root) open.push_back({*root, {}});
    std::vector<GltfPlacedNode> placed;
    while (!open.empty()) {
        const auto [index, above] = open.back();
        open.pop_back();
        const Node& node = nodes[index];
        GltfPlacedNode content = node.content;
        content.toWorld = compose(above, node.local);
        if (!isFinite(content.toWorld)) {
            throw errorAt(file.document, items[index],
                          fmt::format("the transform of node {} overflows", index));
        }
        if (content.mesh || content.camera || content.light) placed.push_back(content);
        for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
            open.push_back({*child, content.toWorld});
    }
    return placed;
}

size_t countOf(const GltfFile& file, const std::string& key)
{
    return itemsOf(file.root(), key).size();
}

size_t lightCountOf(const GltfFile& file)
{
    const auto extension = extensionOf(file.root(), "KHR_lights_punctual");
    return extension ? itemsOf(*extension, "lights").size() : 0;
}

}  // namespace sahl
