// The shapes of scene files: meshes from files, triangles written out, procedural ones, and
// spheres.
#include "scene/gltf_scene.h"
#include "scene/mesh_file.h"
#include "scene/numbers.h"
#include "scene/primitives.h"
#include "scene/scene_reading.h"

#include <cmath>

namespace sahl {

namespace {

constexpr Range RADIUS = {1e-9, 1e18};  // [m]

bool isZero(const glm::dvec3& v)
{
    return glm::dot(v, v) == 0;
}

Transform readMatrix(const JsonObject& object, const JsonNode& node)
{
    const JsonDocument& document = object.document();
    const auto& items = readArray(document, node, "\"matrix\" of " + object.what());
    if (items.size() != 16) {
        throw errorAt(document, node,
                      fmt::format("\"matrix\" of {} needs 16 numbers, row by row, "
                                  "found {}",
                                  object.what(), items.size()));
    }
    double m[16];
    for (size_t i = 0; i < 16; i++) m[i] = readNumber(document, items[i], "a matrix element", {});
    if (m[12] != 0 || m[13] != 0 || m[14] != 0 || m[15] != 1) {
        throw errorAt(document, node, "the last row of \"matrix\" must be 0, 0, 0, 1");
    }
    Transform transform;
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 3; column++)
            transform.linear[column][row] = m[4 * row + column];
        transform.translation[row] = m[4 * row + 3];
    }
    return transform;
}

Transform readScale(const JsonObject& object, const JsonNode& node)
{
    std::string what = "\"scale\" of " + object.what();
    if (node.kind == JsonNode::Kind::number) {
        return scaling(glm::dvec3(readNumber(object.document(), node, what, {})));
    }
    return scaling(readVec3(object.document(), node, what, {}));
}

/// p' = translate * rotate * scale * matrix * p
Transform readOwnTransform(const JsonObject& shape)
{
    Transform transform;
    const JsonNode* node = shape.find("transform");
    if (!node) return transform;
    JsonObject object(shape.document(), *node, "the transform of " + shape.what(), "transform");
    if (const JsonNode* matrix = object.find("matrix")) transform = readMatrix(object, *matrix);
    if (const JsonNode* scale = object.find("scale")) {
        transform = compose(readScale(object, *scale), transform);
    }
    if (const JsonNode* rotate = object.find("rotateDeg")) {
        transform =
            compose(readRotation(object.document(), *rotate, "\"rotateDeg\" of " + object.what()),
                    transform);
    }
    transform = compose(translation(object.vector("translate", {})), transform);
    double volume = determinant(transform);
    if (volume == 0 || !std::isfinite(volume)) {
        throw errorAt(
            shape.document(), *node,
            fmt::format("{} cannot be inverted: it flattens space or overflows", object.what()));
    }
    return transform;
}

std::vector<vec3> readPoints(const JsonObject& shape, const std::string& key)
{
    std::vector<vec3> points;
    const JsonNode* node = shape.find(key);
    if (!node) return points;
    for (const JsonNode& item :
         readArray(shape.document(), *node, "\"" + key + "\" of " + shape.what())) {
        points.push_back(
            toFloat(readVec3(shape.document(), item, "a point of \"" + key + "\"", {})));
    }
    return points;
}

std::vector<vec2> readUvs(const JsonObject& shape)
{
    constexpr Range UV = {-1e6, 1e6};
    std::vector<vec2> uvs;
    const JsonNode* node = shape.find("uvs");
    if (!node) return uvs;
    const JsonDocument& document = shape.document();
    for (const JsonNode& item : readArray(document, *node, "\"uvs\" of " + shape.what())) {
        const auto& pair = readArray(document, item, "a pair of \"uvs\"");
        if (pair.size() != 2)
            throw errorAt(document, item, fmt::format("a pair of \"uvs\" needs 2 numbers, found {}", pair.size()));
        uvs.emplace_back(toFloat(readNumber(document, pair[0], "u", UV)),
                         toFloat(readNumber(document, pair[1], "v", UV)));
    }
    return uvs;
}

Mesh readTriangles(const JsonObject& shape)
{
    const JsonDocument& document = shape.document();
    Mesh mesh;
    mesh.positions = readPoints(shape, "positions");
    mesh.normals = readPoints(shape, "normals");
    if (!mesh.normals.empty() && mesh.normals.size() != mesh.positions.size()) {
        throw errorAt(
            document, shape.at("normals"),
            fmt::format("{} has {} positions and {} normals; there must be a normal for each "
                        "position",
                        shape.what(), mesh.positions.size(), mesh.normals.size()));
    }
    mesh.uvs = readUvs(shape);
    if (!mesh.uvs.empty() && mesh.uvs.size() != mesh.positions.size()) {
        throw errorAt(document, shape.at("uvs"),
                      fmt::format("{} has {} positions and {} pairs of texture coordinates; there must be a "
                                  "pair for each position",
                                  shape.what(), mesh.positions.size(), mesh.uvs.size()));
    }
    const JsonNode& list = shape.at("indices");
    for (const JsonNode& item : readArray(document, list, "\"indices\" of " + shape.what())) {
        const auto& corners = readArray(document, item, "a triangle of \"indices\"");
        if (corners.size() != 3) {
            throw errorAt(document, item,
                          fmt::format("a triangle needs 3 indices, found {}", corners.size()));
        }
        MeshTriangle triangle;
        for (size_t k = 0; k < 3; k++) {
            if (mesh.positions.empty()) throw errorAt(document, item, "there are no positions");
            auto last = static_cast<uint32_t>(mesh.positions.size() - 1);
            triangle.position[k] = readUint(document, corners[k], "an index", 0, last);
            if (!mesh.normals.empty()) triangle.normal[k] = triangle.position[k];
            if (!mesh.uvs.empty()) triangle.uv[k] = triangle.position[k];
        }
        mesh.triangles.push_back(triangle);
    }
    if (mesh.triangles.empty())
        throw errorAt(document, list, fmt::format("{} has no faces", shape.what()));
    return mesh;
}

Mesh readSphereMesh(const JsonObject& shape)
{
    return makeSphere(shape.vector("center", {}), shape.number("radius", 1, RADIUS),
                      shape.uint("level", 5, 0, MAX_SPHERE_LEVEL), shape.boolean("smooth", true));
}

Mesh readDisk(const JsonObject& shape)
{
    glm::dvec3 normal = shape.vector("normal", {0, 1, 0});
    if (isZero(normal))
        throw errorAt(shape.document(), shape.at("normal"), "the normal of a disk is zero");
    return makeDisk(shape.vector("center", {}), normal, shape.number("radius", 1, RADIUS),
                    shape.uint("segments", 64, 3, MAX_DISK_SEGMENTS));
}

/// Adds the meshes of a glTF file. They have materials of their own, unless the shape names one.
void readGltfShape(SceneReading& reading, const JsonObject& shape, const fs::path& path)
{
    auto& model = reading.gltfFiles[path];
    if (!model) {
        auto read = std::make_shared<GltfModel>();
        readGltf(*read, path, reading.policy);
        if (!read->cameras.empty() || !read->lights.empty())
            warn(fmt::format("{}: its cameras and lights are left out: those of the scene count", path.string()));
        model = read;
    }
    GltfPlacing placing;
    placing.transform = readTransform(reading, shape);
    placing.smoothNormals = shape.boolean("smoothNormals", false) || reading.options.smoothNormals;
    if (shape.has("material")) placing.material = readMaterialName(reading, shape);
    placing.instancesLeft = MAX_INSTANCES - reading.placements;
    reading.placements += appendGltf(reading.scene, *model, placing);
}

void readMeshFile(SceneReading& reading, const JsonObject& shape)
{
    const JsonNode& fileNode = shape.at("file");
    std::string where = reading.document.where(fileNode.offset);
    fs::path path = resolvePath(reading.policy, reading.folder, shape.string("file", ""), where);
    if (isGltfFile(path)) {
        readGltfShape(reading, shape, path);
        return;
    }
    auto& obj = reading.objFiles[path];
    if (!obj) obj = std::make_shared<ObjFile>(readMeshFile(path, reading.policy));
    bool smooth = shape.boolean("smoothNormals", false) || reading.options.smoothNormals;
    Transform transform = readTransform(reading, shape);
    if (!shape.has("material")) {
        appendObj(reading.scene, *obj, transform, smooth, path.string());
        return;
    }
    ObjFile repainted = *obj;
    for (MeshTriangle& triangle : repainted.mesh.triangles) triangle.material = 0;
    if (smooth) makeSmoothNormals(repainted.mesh);
    appendShape(reading.scene, repainted.mesh, transform, readMaterialName(reading, shape),
                path.string());
}

/// Factor of a transform that scales alike in all directions, turns, mirrors and moves; 0 for
/// others.
double uniformScale(const Transform& transform)
{
    const glm::dmat3& m = transform.linear;
    const double square = (glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2])) / 3;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            const double expected = i == k ? square : 0;
            if (!(std::abs(glm::dot(m[i], m[k]) - expected) <= 1e-6 * square)) return 0;
        }
    }
    return std::sqrt(square);
}

void readSphere(SceneReading& reading, const JsonObject& shape, const std::string& name)
{
    const Transform transform = readTransform(reading, shape);
    const double scale = uniformScale(transform);
    if (scale == 0) {
        const JsonNode* own = shape.find("transform");
        throw errorAt(shape.document(), own ? *own : shape.node(),
                      "a sphere stays a sphere only when scaled alike in all directions; use an "
                      "\"instance\" of a group with the sphere, or a \"sphereMesh\"");
    }
    const glm::dvec3 center = mapPoint(transform, shape.vector("center", {}));
    const uint32_t material = readMaterialName(reading, shape);
    if (reading.scene.materials[material].alphaCutoff > 0) {
        throw errorAt(shape.document(), shape.at("material"),
                      "a sphere cannot have holes, as \"alphaCutoff\" of its material asks for; use a mesh");
    }
    appendSphere(reading.scene, center, scale * shape.number("radius", 1, RADIUS), material, name);
}

Mesh readMesh(SceneReading& reading, const JsonObject& shape, const std::string& type)
{
    if (type == "sphereMesh") return readSphereMesh(shape);
    if (type == "disk") return readDisk(shape);
    if (type == "rectangle") {
        return makeRectangle(shape.vector("corner", {}), shape.vector("edgeU", {}),
                             shape.vector("edgeV", {}));
    }
    if (type == "teapot") {
        return makeTeapot(shape.uint("subdivisions", 16, 2, MAX_TEAPOT_SUBDIVISIONS),
                          shape.boolean("smooth", true));
    }
    Mesh mesh = readTriangles(shape);
    if (shape.boolean("smoothNormals", false) || reading.options.smoothNormals)
        makeSmoothNormals(mesh);
    return mesh;
}

/// Remembers where the primitives from `firstPrimitive` and the instances from `firstInstance` on
/// are, for a camera that focuses on them. What is inside a shared group has no one place.
void nameShape(SceneReading& reading, const JsonObject& shape, size_t firstPrimitive,
               size_t firstInstance)
{
    if (!shape.has("name")) return;
    const std::string name = shape.string("name", "");
    if (name.empty())
        throw errorAt(shape.document(), shape.at("name"), "the name of a shape is empty");
    if (!reading.openGroups.empty()) return;
    const Scene& scene = reading.scene;
    Box box;
    for (size_t i = firstPrimitive; i < scene.primitives.size(); i++)
        grow(box, extentOf(scene.primitives[i]));
    for (size_t i = firstInstance; i < scene.instances.size(); i++) {
        const Placement& instance = scene.instances[i];
        grow(box, placedBox(instance, extentOf(scene.objects[instance.object])));
    }
    if (!reading.namedShapes.emplace(name, box).second) {
        throw errorAt(shape.document(), shape.at("name"),
                      fmt::format("two shapes have the name \"{}\"", name));
    }
}

/// Whether an MTL file describes the material by the keys of physically based shading.
bool isMetallicRoughness(const ObjMaterial& m)
{
    return m.roughness || m.metallic || m.maps.roughness || m.maps.metallic;
}

/// Numbers that are not given are 1 where there is a map of them, else those of a rough non-metal.
void makeMetallicRoughness(const ObjMaterial& m, Material& material)
{
    material.type = MATERIAL_METALLIC_ROUGHNESS;
    material.eta = 1.5f;
    material.roughness = m.roughness.value_or(1.0f);
    material.metallic = m.metallic.value_or(m.maps.metallic ? 1.0f : 0.0f);
}

}  // namespace

Transform readTransform(const SceneReading& reading, const JsonObject& shape)
{
    const Transform whole = compose(reading.outer, readOwnTransform(shape));
    const double volume = determinant(whole);
    if (volume == 0 || !std::isfinite(volume)) {
        throw errorAt(shape.document(), shape.node(),
                      fmt::format("{}, with the groups that it is in, cannot be inverted: that "
                                  "flattens space or overflows",
                                  shape.what()));
    }
    return whole;
}

uint32_t readMaterialName(SceneReading& reading, const JsonObject& shape)
{
    if (!shape.has("material")) {
        auto [entry, isNew] = reading.materials.emplace("", 0);
        if (isNew) entry->second = addMaterial(reading.scene, "default", vec3(0.7f));
        return entry->second;
    }
    std::string name = shape.string("material", "");
    auto found = name.empty() ? reading.materials.end() : reading.materials.find(name);
    if (found != reading.materials.end()) return found->second;
    std::vector<std::string> names;
    for (const auto& [known, index] : reading.materials) names.push_back(known);
    std::string near = suggestion(name, names);
    throw errorAt(reading.document, shape.at("material"),
                  fmt::format("material \"{}\" is not defined{}", name,
                              near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near)));
}

Transform readRotation(const JsonDocument& document, const JsonNode& node, const std::string& what)
{
    const JsonObject object(document, node, what, "rotation");
    const glm::dvec3 axis = object.vector("axis", {});
    if (isZero(axis)) throw errorAt(document, node, "the axis of a rotation is zero");
    return rotation(axis, object.number("angle", 0, ANGLE_RANGE));
}

void readShape(SceneReading& reading, const JsonNode& node)
{
    const JsonDocument& document = reading.document;
    const std::string type = readType(document, node, "a shape",
                                      {"mesh", "triangles", "teapot", "sphere", "sphereMesh",
                                       "rectangle", "disk", "group", "instance"});
    const JsonObject shape(document, node, fmt::format("the shape \"{}\"", type), type);
    const std::string name = fmt::format("{}: {}", document.where(node.offset), shape.what());
    const size_t firstPrimitive = reading.scene.primitives.size();
    const size_t firstInstance = reading.scene.instances.size();
    if (type == "mesh") {
        readMeshFile(reading, shape);
    } else if (type == "sphere") {
        readSphere(reading, shape, name);
    } else if (type == "group") {
        readGroupShape(reading, shape);
    } else if (type == "instance") {
        readInstance(reading, shape);
    } else {
        appendShape(reading.scene, readMesh(reading, shape, type), readTransform(reading, shape),
                    readMaterialName(reading, shape), name);
    }
    nameShape(reading, shape, firstPrimitive, firstInstance);
}

void appendObj(Scene& scene, const ObjFile& obj, const Transform& transform, bool smooth,
               const std::string& name)
{
    std::vector<uint32_t> materials;
    for (const ObjMaterial& m : obj.materials) {
        materials.push_back(addMaterial(scene, m.name, m.baseColor, m.emission));
        Material& added = scene.materials.back();
        added.ambientColor = m.ambientColor.value_or(added.ambientColor);
        added.specularColor = m.specularColor;
        added.shininess = m.shininess.value_or(added.shininess);
        if (isMetallicRoughness(m)) makeMetallicRoughness(m, added);
        applyMtlMaps(scene, m.maps, m.opacity, added);
    }
    Mesh smoothMesh;
    if (smooth) {
        smoothMesh = obj.mesh;
        makeSmoothNormals(smoothMesh);
    }
    uint64_t dropped =
        appendMesh(scene, smooth ? smoothMesh : obj.mesh, transform, materials, name);
    if (dropped == obj.mesh.triangles.size()) {
        throw badInput("{}: no faces: all {} triangles have zero area", name, dropped);
    }
    if (dropped > 0) warn(fmt::format("{}: left out {} triangles of zero area", name, dropped));
}

}  // namespace sahl
