// Written here since no library that Debian packages is strict about lengths and indices.
#include "scene/ply_reader.h"

#include "scene/numbers.h"
#include "scene/ply_body.h"
#include "scene/polygon.h"
#include "util/error.h"
#include "util/gzip.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace sahl {

namespace {

/// Holds fewer than 2^32 vertices.
constexpr uint64_t MAX_PLY_BYTES = uint64_t{4} << 30;

/// Ends a strip of triangles.
constexpr double STRIP_END = -1;

/// Something left out, counted, and told in one line at the end.
struct Omission {
    uint64_t count = 0;
    std::string first;  ///< where

    void add(const PlyBody& body)
    {
        if (count++ == 0) first = body.where();
    }
};

struct PlyReading {
    std::string file;  ///< for messages
    Mesh mesh;
    bool hasVertices = false;
    std::vector<std::string> unused;  ///< elements and properties
    Omission shortFaces, fans, badNormals;
};

const PlyProperty* findProperty(const PlyElement& element, std::string_view name)
{
    auto found = std::find_if(element.properties.begin(), element.properties.end(),
                              [&](const PlyProperty& p) { return p.name == name; });
    return found == element.properties.end() ? nullptr : &*found;
}

/// Remembers the properties of `element` that are not in `used`. Texture coordinates go without
/// saying: not every material has a use for them.
void noteUnused(PlyReading& reading, const PlyElement& element,
                const std::vector<std::string_view>& used)
{
    static const std::vector<std::string_view> texture = {"s", "t",         "u",
                                                          "v", "texture_u", "texture_v"};
    for (const PlyProperty& property : element.properties) {
        bool known = std::find(used.begin(), used.end(), property.name) != used.end() ||
                     std::find(texture.begin(), texture.end(), property.name) != texture.end();
        if (!known) reading.unused.push_back(element.name + " " + property.name);
    }
}

/// Which of x, y, z, nx, ny, nz, u, v each property of a vertex is.
struct VertexLayout {
    static constexpr size_t NONE = 8;
    std::vector<size_t> slots;
    bool hasNormals = false, hasUvs = false;
};

VertexLayout layoutOf(PlyReading& reading, const PlyElement& element)
{
    static const std::vector<std::string_view> names = {"x", "y", "z", "nx", "ny", "nz"};
    auto isScalar = [&](std::string_view name) {
        const PlyProperty* property = findProperty(element, name);
        return property && !property->isList;
    };
    for (size_t i = 0; i < 3; i++) {
        if (!isScalar(names[i])) {
            throw badInput("{}: the element \"vertex\" needs the property \"{}\", a number",
                           reading.file, names[i]);
        }
    }
    VertexLayout layout;
    layout.hasNormals = isScalar("nx") && isScalar("ny") && isScalar("nz");
    std::vector<std::string_view> used = names;
    if (!layout.hasNormals) std::fill(used.begin() + 3, used.end(), "");
    for (const auto& [u, v] : {std::pair("u", "v"), std::pair("s", "t"), std::pair("texture_u", "texture_v")}) {
        if (layout.hasUvs || !isScalar(u) || !isScalar(v)) continue;
        used.insert(used.end(), {u, v});
        layout.hasUvs = true;
    }
    for (const PlyProperty& property : element.properties) {
        auto at = std::find(used.begin(), used.end(), property.name);
        layout.slots.push_back(at == used.end() ? VertexLayout::NONE
                                                : static_cast<size_t>(at - used.begin()));
    }
    noteUnused(reading, element, used);
    return layout;
}

/// What is not finite becomes 0.
void addUv(Mesh& mesh, double u, double v)
{
    mesh.uvs.emplace_back(std::isfinite(u) ? toFloat(u) : 0, std::isfinite(v) ? toFloat(v) : 0);
}

void readVertices(PlyReading& reading, const PlyElement& element, PlyBody& body)
{
    const VertexLayout layout = layoutOf(reading, element);
    Mesh& mesh = reading.mesh;
    mesh.positions.reserve(element.count);  // the file is long enough for that many
    if (layout.hasNormals) mesh.normals.reserve(element.count);
    if (layout.hasUvs) mesh.uvs.reserve(element.count);
    for (uint64_t i = 0; i < element.count; i++) {
        body.beginItem(i);
        std::array<double, VertexLayout::NONE> values = {};
        for (size_t k = 0; k < element.properties.size(); k++) {
            const PlyProperty& property = element.properties[k];
            const size_t slot = layout.slots[k];
            if (slot == VertexLayout::NONE) {
                body.skip(property);
                continue;
            }
            values[slot] = body.value(property);
            if (slot < 3 && !std::isfinite(values[slot])) {
                throw badInput("{}: \"{}\" of vertex {} is not a finite number", body.where(),
                               property.name, i);
            }
        }
        body.endItem();
        mesh.positions.push_back(toFloat(glm::dvec3(values[0], values[1], values[2])));
        if (layout.hasUvs) addUv(mesh, values[6], values[7]);
        if (!layout.hasNormals) continue;
        glm::dvec3 normal(values[3], values[4], values[5]);
        mesh.normals.push_back(isFinite(normal) ? toFloat(normal) : vec3(0.0f));
        if (mesh.normals.back() == vec3(0.0f)) reading.badNormals.add(body);
    }
    reading.hasVertices = true;
}

/// The list of corners. Throws badInput when there is none, or when vertices are still to come.
const PlyProperty& cornersOf(const PlyReading& reading, const PlyElement& element)
{
    if (!reading.hasVertices) {
        throw badInput("{}: element \"{}\" stands before \"vertex\"; write the vertices first",
                       reading.file, element.name);
    }
    for (const char* name : {"vertex_indices", "vertex_index"}) {
        const PlyProperty* property = findProperty(element, name);
        if (property && property->isList) return *property;
    }
    throw badInput("{}: element \"{}\" needs a list \"vertex_indices\"", reading.file,
                   element.name);
}

uint32_t readIndex(const PlyReading& reading, const PlyProperty& list, PlyBody& body, double value)
{
    const size_t count = reading.mesh.positions.size();
    if (!(value >= 0 && value < double(count) && value == std::floor(value))) {
        throw badInput("{}: \"{}\" has the index {}, out of range; the file has {} vertices, "
                       "counted from 0",
                       body.where(), list.name, value, count);
    }
    return static_cast<uint32_t>(value);
}

void addTriangle(PlyReading& reading, const std::array<uint32_t, 3>& corners)
{
    Mesh& mesh = reading.mesh;
    if (mesh.triangles.size() >= MAX_PRIMITIVES) {
        throw badInput("{}: has more than {} triangles", reading.file, MAX_PRIMITIVES);
    }
    MeshTriangle triangle = {corners};
    if (!mesh.normals.empty()) triangle.normal = corners;
    if (!mesh.uvs.empty()) triangle.uv = corners;
    mesh.triangles.push_back(triangle);
}

void readPolygon(PlyReading& reading, const PlyProperty& list, PlyBody& body)
{
    std::vector<uint32_t> corners(body.listLength(list));
    std::vector<vec3> points;
    points.reserve(corners.size());
    for (uint32_t& corner : corners) {
        corner = readIndex(reading, list, body, body.value(list));
        points.push_back(reading.mesh.positions[corner]);
    }
    if (corners.size() < 3) {
        reading.shortFaces.add(body);
        return;
    }
    bool isFan = false;
    for (const auto& cut : triangulate(points, isFan)) {
        addTriangle(reading, {corners[cut[0]], corners[cut[1]], corners[cut[2]]});
    }
    if (isFan) reading.fans.add(body);
}

/// Every corner from the third on makes a triangle with the two before it, every second one turned
/// over. Strips are stitched together by repeated corners, whose triangles are none.
void readStrip(PlyReading& reading, const PlyProperty& list, PlyBody& body)
{
    std::array<uint32_t, 2> before = {};
    uint64_t corners = 0;  // of the strip so far
    for (uint64_t left = body.listLength(list); left > 0; left--) {
        const double value = body.value(list);
        if (value == STRIP_END) {
            corners = 0;
            continue;
        }
        const uint32_t corner = readIndex(reading, list, body, value);
        const auto [a, b] = before;
        if (corners >= 2 && a != b && b != corner && corner != a) {
            const bool even = corners % 2 == 0;
            addTriangle(reading, {even ? a : b, even ? b : a, corner});
        }
        before = {b, corner};
        corners++;
    }
}

void readFaces(PlyReading& reading, const PlyElement& element, PlyBody& body)
{
    const PlyProperty& list = cornersOf(reading, element);
    noteUnused(reading, element, {list.name});
    const bool strips = element.name == "tristrips";
    constexpr uint64_t LEAST_BYTES = 4;  // of a triangle
    reading.mesh.triangles.reserve(std::min<uint64_t>(element.count, body.bytesLeft() / LEAST_BYTES));
    for (uint64_t i = 0; i < element.count; i++) {
        body.beginItem(i);
        for (const PlyProperty& property : element.properties) {
            if (&property != &list)
                body.skip(property);
            else if (strips)
                readStrip(reading, list, body);
            else
                readPolygon(reading, list, body);
        }
        body.endItem();
    }
}

void skipElement(PlyReading& reading, const PlyElement& element, PlyBody& body)
{
    if (element.count > 0) reading.unused.push_back(element.name);
    if (element.properties.empty()) return;  // however many there are, they take no byte
    for (uint64_t i = 0; i < element.count; i++) {
        body.beginItem(i);
        for (const PlyProperty& property : element.properties) body.skip(property);
        body.endItem();
    }
}

void tellOmissions(const PlyReading& reading)
{
    auto tell = [&](const Omission& omission, const std::string& what) {
        if (omission.count == 0) return;
        warn(fmt::format("{}: {} {}", omission.first, omission.count, what));
    };
    tell(reading.shortFaces, "faces with fewer than 3 corners were left out, the first one here");
    tell(reading.badNormals,
         "normals have no direction; the facet's own is used; the first one is here");
    tell(reading.fans, fmt::format("polygons of more than {} corners are not convex and were cut "
                                   "into fans, the first one here",
                                   MAX_EARS));
    if (reading.unused.empty()) return;
    std::string list;
    for (const std::string& name : reading.unused) list += (list.empty() ? "" : ", ") + name;
    warn(fmt::format("{}: elements and properties that are not used: {}", reading.file,
                     list.substr(0, 200)));
}

}  // namespace

Mesh readPly(const fs::path& file)
{
    PlyReading reading;
    reading.file = file.string();
    const std::string bytes = readUnpackedText(file, MAX_PLY_BYTES);
    const PlyHeader header = readPlyHeader(bytes, reading.file);
    PlyBody body(bytes, header, reading.file);
    for (const PlyElement& element : header.elements) {
        body.beginElement(element);
        if (element.name == "vertex")
            readVertices(reading, element, body);
        else if (element.name == "face" || element.name == "tristrips")
            readFaces(reading, element, body);
        else
            skipElement(reading, element, body);
    }
    if (size_t left = body.bytesLeft(); left > 0) {
        warn(fmt::format("{}: {} bytes after the last element are ignored", reading.file, left));
    }
    tellOmissions(reading);
    if (reading.mesh.triangles.empty()) {
        throw badInput("{}: no faces: the file has {} vertices and no face with 3 corners or more",
                       reading.file, reading.mesh.positions.size());
    }
    return std::move(reading.mesh);
}

}  // namespace sahl
