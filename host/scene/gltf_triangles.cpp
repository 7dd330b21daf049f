// The triangles of a part of a mesh: indices and vertices.
#include "scene/gltf_parts.h"
#include "scene/numbers.h"

#include <algorithm>
#include <array>

namespace sahl {

namespace {

uint64_t cornersOf(const GltfPart& part)
{
    return part.indices ? part.indices->count : part.positions->count;
}

/// The vertices of the part's corners, in their order; each is one of the positions.
std::vector<uint32_t> readCorners(const GltfFile& file, const GltfPart& part)
{
    std::vector<uint32_t> corners(cornersOf(part));
    const uint32_t size = !part.indices                                        ? 0
                          : part.indices->numbers.componentType == GLTF_UBYTE  ? 0xffu
                          : part.indices->numbers.componentType == GLTF_USHORT ? 0xffffu
                                                                               : 0xffffffffu;
    for (uint32_t i = 0; i < corners.size(); i++) {
        corners[i] = part.indices ? static_cast<uint32_t>(gltfNumber(*part.indices, i, 0)) : i;
        if (corners[i] < part.positions->count && (!part.indices || corners[i] != size)) continue;
        throw errorAt(
            file.document, *part.indices->node,
            fmt::format("index {} of {}, {}, is {}; there are {} vertices{}", i, part.what,
                        part.indices->what, corners[i], part.positions->count,
                        corners[i] == size ? ", and this one would restart a strip" : ""));
    }
    return corners;
}

/// The places in the list of corners that triangle i of a part takes; counter-clockwise.
std::array<uint32_t, 3> triangleOf(uint32_t mode, uint32_t i)
{
    if (mode == GLTF_TRIANGLES) return {3 * i, 3 * i + 1, 3 * i + 2};
    if (mode == GLTF_TRIANGLE_FAN) return {i + 1, i + 2, 0};
    return {i, i + 1 + i % 2, i + 2 - i % 2};
}

vec3 readPosition(const GltfFile& file, const GltfPart& part, uint32_t vertex)
{
    glm::dvec3 p;
    for (uint32_t k = 0; k < 3; k++)
        p[static_cast<int>(k)] = gltfNumber(*part.positions, vertex, k);
    if (isFinite(p)) return toFloat(p);
    throw errorAt(file.document, *part.positions->node,
                  fmt::format("vertex {} of {}, {}, is ({}, {}, {}); it must be finite", vertex,
                              part.what, part.positions->what, p.x, p.y, p.z));
}

vec3 readNormal(const GltfPart& part, uint32_t vertex)
{
    glm::dvec3 n;
    for (uint32_t k = 0; k < 3; k++) n[static_cast<int>(k)] = gltfNumber(*part.normals, vertex, k);
    return isFinite(n) ? toFloat(n) : vec3(0.0f);
}

/// v goes down in the file and up in meshes.
vec2 readUv(const GltfPart& part, uint32_t vertex)
{
    const double u = gltfNumber(*part.texCoords, vertex, 0);
    const double v = 1 - gltfNumber(*part.texCoords, vertex, 1);
    return isFinite({u, v, 0}) ? vec2(toFloat(u), toFloat(v)) : vec2(0.0f);
}

}  // namespace

uint64_t trianglesOf(const GltfPart& part)
{
    if (part.mode < GLTF_TRIANGLES || !part.positions) return 0;
    const uint64_t corners = cornersOf(part);
    if (part.mode == GLTF_TRIANGLES) return corners / 3;
    return corners < 3 ? 0 : corners - 2;
}

void addGltfPart(GltfFile& file, const GltfPart& part, Mesh& mesh)
{
    const std::vector<uint32_t> corners = readCorners(file, part);
    std::vector<uint32_t> used = corners;
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    const auto firstPosition = static_cast<uint32_t>(mesh.positions.size());
    const auto firstNormal = static_cast<uint32_t>(mesh.normals.size());
    const auto firstUv = static_cast<uint32_t>(mesh.uvs.size());
    for (const uint32_t vertex : used) {
        mesh.positions.push_back(readPosition(file, part, vertex));
        if (part.normals) mesh.normals.push_back(readNormal(part, vertex));
        if (part.texCoords) mesh.uvs.push_back(readUv(part, vertex));
    }
    if (part.mode == GLTF_TRIANGLES && corners.size() % 3 != 0)
        leaveOut(file, "corners that make no whole triangle are left out");
    const auto count = static_cast<uint32_t>(trianglesOf(part));
    for (uint32_t i = 0; i < count; i++) {
        MeshTriangle triangle;
        triangle.material = part.material;
        const std::array<uint32_t, 3> places = triangleOf(part.mode, i);
        for (size_t k = 0; k < 3; k++) {
            const auto place =
                std::lower_bound(used.begin(), used.end(), corners[places[k]]) - used.begin();
            triangle.position[k] = firstPosition + static_cast<uint32_t>(place);
            if (part.normals) triangle.normal[k] = firstNormal + static_cast<uint32_t>(place);
            if (part.texCoords) triangle.uv[k] = firstUv + static_cast<uint32_t>(place);
        }
        mesh.triangles.push_back(triangle);
    }
}

}  // namespace sahl
