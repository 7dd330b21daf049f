#include "scene/mesh.h"

#include "scene/numbers.h"
#include "scene/phong.h"
#include "scene/texture.h"
#include "util/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

namespace sahl {

namespace {

/// Edges of about a nanometre: below this the squares in a float normal underflow.
constexpr double SMALLEST_DOUBLE_AREA = 1e-18;  // [m^2]

/// Twice the area, relative to the longest edge squared, that double arithmetic leaves of an exact
/// zero: such corners lie on a line.
constexpr double COLLINEAR = 1e-14;

glm::dvec3 doubleAreaVector(const glm::dvec3& p0, const glm::dvec3& p1, const glm::dvec3& p2)
{
    return glm::cross(p1 - p0, p2 - p0);
}

double longestEdgeSquared(const glm::dvec3& p0, const glm::dvec3& p1, const glm::dvec3& p2)
{
    glm::dvec3 a = p1 - p0, b = p2 - p1, c = p0 - p2;
    return std::max({glm::dot(a, a), glm::dot(b, b), glm::dot(c, c)});
}

bool hasZeroArea(const vec3& p0, const vec3& p1, const vec3& p2)
{
    glm::dvec3 n = doubleAreaVector(p0, p1, p2);
    double doubleArea = std::sqrt(glm::dot(n, n));
    return doubleArea <= SMALLEST_DOUBLE_AREA ||
           doubleArea <= COLLINEAR * longestEdgeSquared(p0, p1, p2);
}

/// Unit float vector, or zero when the direction is lost.
vec3 unitOrZero(const glm::dvec3& v)
{
    double length = std::sqrt(glm::dot(v, v));
    if (!(length > SMALLEST_MAGNITUDE) || !std::isfinite(length)) return vec3(0.0f);
    return toFloat(v / length);
}

bool isZero(const vec3& v)
{
    return v.x == 0 && v.y == 0 && v.z == 0;
}

/// For each position the smallest index of an equal one.
std::vector<uint32_t> weld(const std::vector<vec3>& positions)
{
    std::vector<uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    auto key = [&](uint32_t i) {
        return std::make_tuple(positions[i].x, positions[i].y, positions[i].z);
    };
    std::sort(order.begin(), order.end(),
              [&](uint32_t a, uint32_t b) { return key(a) != key(b) ? key(a) < key(b) : a < b; });
    std::vector<uint32_t> first(positions.size());
    for (size_t i = 0; i < order.size(); i++) {
        bool same = i > 0 && key(order[i]) == key(order[i - 1]);
        first[order[i]] = same ? first[order[i - 1]] : order[i];
    }
    return first;
}

std::vector<vec3> mapPositions(const Mesh& mesh, const Transform& transform,
                               const std::string& name)
{
    std::vector<vec3> mapped;
    mapped.reserve(mesh.positions.size());
    for (const vec3& p : mesh.positions) {
        glm::dvec3 q = mapPoint(transform, p);
        double largest = std::max({std::abs(q.x), std::abs(q.y), std::abs(q.z)});
        if (!(largest <= std::numeric_limits<float>::max())) {
            throw badInput("{}: a vertex lies outside the range of numbers after the transform",
                           name);
        }
        mapped.push_back(toFloat(q));
    }
    return mapped;
}

std::vector<vec3> mapNormals(const Mesh& mesh, const Transform& transform)
{
    glm::dmat3 matrix = normalMatrix(transform);
    std::vector<vec3> mapped;
    mapped.reserve(mesh.normals.size());
    for (const vec3& n : mesh.normals) mapped.push_back(unitOrZero(matrix * glm::dvec3(n)));
    return mapped;
}

/// What the corners of a triangle have beside their positions; no normal is zero.
struct Corners {
    std::array<vec3, 3> normals = {vec3(0.0f), vec3(0.0f), vec3(0.0f)};
    std::array<vec2, 3> uvs = {vec2(0.0f), vec2(0.0f), vec2(0.0f)};
};

/// Adds the corners and returns their index, or SHAPE_FLAT when none has a normal or texture coordinates.
uint32_t addCorners(Scene& scene, const Corners& corners, const vec3& geometric)
{
    const auto& n = corners.normals;
    const auto& t = corners.uvs;
    const bool flat = isZero(n[0]) && isZero(n[1]) && isZero(n[2]);
    if (flat && t[0] == vec2(0.0f) && t[1] == vec2(0.0f) && t[2] == vec2(0.0f)) return SHAPE_FLAT;
    auto sound = [&](const vec3& normal) { return isZero(normal) && !flat ? geometric : normal; };
    const auto index = static_cast<uint32_t>(scene.triangleCorners.size());
    scene.triangleCorners.push_back({sound(n[0]), t[0].x, sound(n[1]), t[1].x, sound(n[2]), t[2].x, t[0].y,
                                     t[1].y, t[2].y, 0});
    return index;
}

void requireRoom(const Scene& scene, const std::string& name)
{
    if (scene.primitives.size() >= MAX_PRIMITIVES) {
        throw badInput("{}: the scene has more than {} primitives", name, MAX_PRIMITIVES);
    }
}

}  // namespace

void makeSmoothNormals(Mesh& mesh)
{
    std::vector<uint32_t> first = weld(mesh.positions);
    std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0.0));
    for (const MeshTriangle& t : mesh.triangles) {
        glm::dvec3 n =
            doubleAreaVector(mesh.positions[t.position[0]], mesh.positions[t.position[1]],
                             mesh.positions[t.position[2]]);
        for (uint32_t corner : t.position) sums[first[corner]] += n;
    }
    auto base = static_cast<uint32_t>(mesh.normals.size());
    for (const glm::dvec3& sum : sums) mesh.normals.push_back(unitOrZero(sum));
    for (MeshTriangle& t : mesh.triangles) {
        for (size_t k = 0; k < 3; k++) {
            if (t.normal[k] == SHAPE_FLAT) t.normal[k] = base + first[t.position[k]];
        }
    }
}

uint64_t appendMesh(Scene& scene, const Mesh& mesh, const Transform& transform,
                    std::span<const uint32_t> materials, const std::string& name)
{
    std::vector<vec3> positions = mapPositions(mesh, transform, name);
    std::vector<vec3> normals = mapNormals(mesh, transform);
    bool mirrors = determinant(transform) < 0;
    const bool keepUvs = usesTextures(scene);
    uint64_t dropped = 0;
    scene.objectStarts.push_back(static_cast<uint32_t>(scene.primitives.size()));
    scene.primitives.reserve(scene.primitives.size() + mesh.triangles.size());
    for (const MeshTriangle& t : mesh.triangles) {
        std::array<size_t, 3> order = {0, mirrors ? size_t{2} : size_t{1},
                                       mirrors ? size_t{1} : size_t{2}};
        std::array<vec3, 3> p;
        Corners corners;
        for (size_t k = 0; k < 3; k++) {
            p[k] = positions.at(t.position[order[k]]);
            uint32_t normal = t.normal[order[k]];
            if (normal != SHAPE_FLAT) corners.normals[k] = normals.at(normal);
            const uint32_t uv = t.uv[order[k]];
            if (uv != NO_UV && keepUvs) corners.uvs[k] = mesh.uvs.at(uv);
        }
        if (hasZeroArea(p[0], p[1], p[2])) {
            dropped++;
            continue;
        }
        requireRoom(scene, name);
        vec3 geometric = unitOrZero(doubleAreaVector(p[0], p[1], p[2]));
        auto primitive = static_cast<uint32_t>(scene.primitives.size());
        uint32_t material = materials[t.material];
        uint32_t cornersIndex = addCorners(scene, corners, geometric);
        scene.primitives.push_back({p[0], primitive, p[1], material, p[2], cornersIndex});
    }
    scene.droppedTriangles += dropped;
    return dropped;
}

void appendShape(Scene& scene, const Mesh& mesh, const Transform& transform, uint32_t material,
                 const std::string& name)
{
    uint64_t dropped = appendMesh(scene, mesh, transform, {&material, 1}, name);
    if (dropped > 0) warn(fmt::format("{}: left out {} triangles of zero area", name, dropped));
}

void appendSphere(Scene& scene, const glm::dvec3& center, double radius, uint32_t material,
                  const std::string& name)
{
    const double reach =
        std::max({std::abs(center.x), std::abs(center.y), std::abs(center.z)}) + radius;
    if (!(reach <= 0.999 * std::numeric_limits<float>::max())) {
        throw badInput("{}: the sphere reaches outside the range of numbers", name);
    }
    if (!(radius >= SMALLEST_MAGNITUDE)) {
        throw badInput("{}: the sphere's radius is {}; it must be positive", name, radius);
    }
    requireRoom(scene, name);
    const auto primitive = static_cast<uint32_t>(scene.primitives.size());
    scene.objectStarts.push_back(primitive);
    const vec3 size(toFloat(radius), 0, 0);
    scene.primitives.push_back({toFloat(center), primitive, size, material, vec3(0), SHAPE_SPHERE});
}

uint32_t addMaterial(Scene& scene, const std::string& name, const Material& material)
{
    scene.materials.push_back(material);
    scene.materialNames.push_back(name);
    return static_cast<uint32_t>(scene.materials.size() - 1);
}

uint32_t addMaterial(Scene& scene, const std::string& name, const vec3& baseColor,
                     const vec3& emission)
{
    Material material = {};
    material.baseColor = baseColor;
    material.eta = 1;
    material.emission = emission;
    material.type = MATERIAL_LAMBERT;
    setPhongDefaults(material);
    return addMaterial(scene, name, material);
}

}  // namespace sahl
