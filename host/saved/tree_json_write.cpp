// Trees as nested JSON: a group is an array of its two groups or of the leaf's objects.
#include "saved/saved_scene.h"

#include "saved/description.h"
#include "saved/struct_json.h"

#include <cmath>
#include <iterator>
#include <map>

namespace sahl {

namespace {

/// Text that goes to the file in large pieces.
class TextFile {
public:
    explicit TextFile(const fs::path& path) : file_(path) {}

    template <class... Args>
    void print(fmt::format_string<Args...> text, Args&&... args)
    {
        fmt::format_to(std::back_inserter(text_), text, std::forward<Args>(args)...);
        if (text_.size() > PIECE) flush();
    }

    void commit()
    {
        flush();
        file_.commit();
    }

private:
    static constexpr size_t PIECE = size_t{1} << 20;  // [bytes]

    void flush()
    {
        file_.write({reinterpret_cast<const uint8_t*>(text_.data()), text_.size()});
        text_.clear();
    }

    AtomicFile file_;
    std::string text_;
};

/// The shortest decimal that reads back to the same float; -0 keeps its sign as a JSON number only
/// with a point.
std::string textOf(float x)
{
    return x == 0 && std::signbit(x) ? "-0.0" : fmt::format("{}", x);
}

std::string textOf(const vec3& v)
{
    return fmt::format("[{},{},{}]", textOf(v.x), textOf(v.y), textOf(v.z));
}

/// Normals and texture coordinates, as far as there are any.
void printCorners(TextFile& file, const TriangleCorners& c)
{
    const vec3 us = {c.u0, c.u1, c.u2}, vs = {c.v0, c.v1, c.v2};
    const bool flat = c.n0 == vec3(0) && c.n1 == vec3(0) && c.n2 == vec3(0);
    const bool plain = us == vec3(0) && vs == vec3(0);
    if (!flat || plain) file.print(",\"normals\":[{},{},{}]", textOf(c.n0), textOf(c.n1), textOf(c.n2));
    if (!plain) file.print(",\"u\":{},\"v\":{}", textOf(us), textOf(vs));
}

void printLeaf(TextFile& file, const Primitive& p, std::span<const TriangleCorners> corners)
{
    if (p.shape == SHAPE_SPHERE) {
        file.print(
            "{{\"type\":\"sphere\",\"number\":{},\"material\":{},\"center\":{},\"radius\":{}}}",
            p.number, p.material, textOf(p.p0), textOf(p.p1.x));
        return;
    }
    file.print(
        "{{\"type\":\"triangle\",\"number\":{},\"material\":{},\"p0\":{},\"p1\":{},\"p2\":{}",
        p.number, p.material, textOf(p.p0), textOf(p.p1), textOf(p.p2));
    if (p.shape != SHAPE_FLAT) printCorners(file, corners[p.shape]);
    file.print("}}");
}

void printLeaves(TextFile& file, uint ref, const DeviceScene& scene)
{
    if (ref == REF_NONE) return;
    const uint first = (ref & ~REF_LEAF) >> LEAF_COUNT_BITS;
    const uint count = (ref & (MAX_LEAF_SIZE - 1)) + 1;
    for (uint i = 0; i < count; i++) {
        if (i > 0) file.print(",\n");
        printLeaf(file, scene.primitives[first + i], scene.triangleCorners);
    }
}

std::string textOf(const vec3& row0, const vec3& row1, const vec3& row2)
{
    return fmt::format("[{},{},{}]", textOf(row0), textOf(row1), textOf(row2));
}

/// What follows from the object is left out: its root, and the number of its first primitive.
void printInstance(TextFile& file, uint index, uint object, const ObjectInstance& o)
{
    file.print("{{\"type\":\"instance\",\"number\":{},\"object\":{}", index, object);
    if (o.material != NO_MATERIAL) file.print(",\"material\":{}", o.material);
    file.print(",\"toObject\":{},\"toWorld\":{},\"translation\":{},\"lo\":{},\"hi\":{}}}",
               textOf(o.toObject0, o.toObject1, o.toObject2),
               textOf(o.toWorld0, o.toWorld1, o.toWorld2), textOf(o.translation), textOf(o.lo),
               textOf(o.hi));
}

/// Numbers of objects by the references to their roots, as they lie in the arrays.
using Objects = std::map<uint, uint>;

/// Of the primitives of a tree: its leftmost leaf.
uint firstPrimitive(uint ref, const DeviceScene& scene)
{
    while ((ref & REF_LEAF) == 0) ref = scene.nodes[ref].ref0;
    return (ref & ~REF_LEAF) >> LEAF_COUNT_BITS;
}

Objects objectsOf(const DeviceScene& scene)
{
    std::map<uint, uint> roots;  // by their first primitives
    for (const ObjectInstance& o : scene.instances)
        roots.emplace(firstPrimitive(o.rootRef, scene), o.rootRef);
    Objects objects;
    for (const auto& [first, root] : roots)
        objects.emplace(root, static_cast<uint>(objects.size()));
    return objects;
}

/// Without recursion: what is still to be printed lies on a stack.
void printTree(TextFile& file, uint rootRef, const DeviceScene& scene, const Objects& objects)
{
    struct Piece {
        uint ref;
        const char* text;  ///< instead of a group, unless null
    };
    std::vector<Piece> pieces = {{rootRef, nullptr}};
    while (!pieces.empty()) {
        const Piece piece = pieces.back();
        pieces.pop_back();
        if (piece.text != nullptr) {
            file.print("{}", piece.text);
            continue;
        }
        file.print("[");
        pieces.push_back({0, "]"});
        if ((piece.ref & REF_LEAF) != 0) {
            printLeaves(file, piece.ref, scene);
        } else if ((piece.ref & REF_INSTANCE) != 0) {
            const uint index = piece.ref & ~REF_INSTANCE;
            const ObjectInstance& instance = scene.instances[index];
            printInstance(file, index, objects.at(instance.rootRef), instance);
        } else {
            const BvhNode& node = scene.nodes[piece.ref];
            pieces.push_back({node.ref1, nullptr});
            pieces.push_back({0, ",\n"});
            pieces.push_back({node.ref0, nullptr});
        }
    }
}

/// Each once, however many instances place it.
void printObjects(TextFile& file, const DeviceScene& scene, const Objects& objects)
{
    std::vector<uint> roots(objects.size());
    for (const auto& [root, number] : objects) roots[number] = root;
    file.print("\"objects\":[");
    for (size_t i = 0; i < roots.size(); i++) {
        if (i > 0) file.print(",\n");
        printTree(file, roots[i], scene, {});
    }
    file.print("],\n");
}

nlohmann::ordered_json describeForTree(const PreparedScene& prepared, const DeviceScene& scene)
{
    using Json = nlohmann::ordered_json;
    Json json = describe(prepared);
    json["tree"].erase("rootRef");
    json["tree"].erase("sahCost");
    json["materials"] = Json::array();
    for (size_t i = 0; i < scene.materials.size(); i++) {
        json["materials"].push_back(
            materialJson(scene.materials[i], prepared.scene.materialNames[i]));
    }
    json["textures"] = Json::array();
    for (const Texture& texture : scene.textures) json["textures"].push_back(textureJson(texture));
    json["lights"] = Json::array();
    for (const Light& light : prepared.sceneLights()) json["lights"].push_back(lightJson(light));
    json["objectStarts"] = prepared.scene.objectStarts;
    return json;
}

}  // namespace

void writeTreeJson(const PreparedScene& prepared, const fs::path& path)
{
    const DeviceScene scene = prepared.deviceScene();
    const std::string description =
        describeForTree(prepared, scene)
            .dump(1, ' ', false, nlohmann::json::error_handler_t::replace);
    if (description.size() > MAX_JSON_BYTES / 2) {
        throw badInput(
            "{}: its materials, lights and objects take {} bytes as JSON, too many to be "
            "read back; save it as .sahl",
            prepared.scene.name, description.size());
    }
    TextFile file(path);
    file.print("{{\"sahlTree\":1,\n\"scene\":{},\n\"texels\":[", description);
    for (size_t i = 0; i < scene.probeTexels.size(); i++) {
        file.print("{}{}", i == 0 ? "" : ",\n", textOf(vec3(scene.probeTexels[i])));
    }
    bool first = scene.probeTexels.empty();
    for (const uint32_t texel : scene.textureTexels) {
        file.print("{}{}", first ? "" : ",\n", texel);
        first = false;
    }
    file.print("],\n");
    const Objects objects = objectsOf(scene);
    if (!objects.empty()) printObjects(file, scene, objects);
    file.print("\"root\":");
    printTree(file, prepared.bvh.rootRef, scene, objects);
    file.print("}}\n");
    file.commit();
}

}  // namespace sahl
