// Geometry is read here rather than by tinyobjloader, because its numbers go through pow() (bits
// would depend on the C library), its indices through atoi() without a range check, and its errors
// know no lines. Materials, where none of this matters, are read by it in mtl_reader.cpp.
#include "scene/obj_reader.h"

#include "scene/numbers.h"
#include "scene/polygon.h"
#include "scene/statements.h"
#include "util/error.h"

#include <charconv>
#include <set>

namespace sahl {

namespace {

constexpr uint64_t MAX_OBJ_BYTES = uint64_t{4} << 30;
constexpr size_t MAX_VERTICES = 0x7fffffff;

/// Something left out, counted, and told in one line at the end.
struct Omission {
    uint64_t count = 0;
    size_t firstLine = 0;
    std::string example;

    void add(const Statement& statement)
    {
        if (count++ > 0) return;
        firstLine = statement.line;
        example = std::string(statement.keyword.substr(0, 20));
    }
};

struct ObjReading {
    std::string file;  ///< for messages
    PathPolicy policy;
    ObjFile result;
    size_t texcoords = 0;
    std::map<std::string, ObjMaterial> library;     ///< of all MTL files so far
    std::map<std::string, uint32_t> usedMaterials;  ///< name -> index in result.materials
    uint32_t material = NO_HIT;                     ///< in force; NO_HIT: none named yet
    // Counts of statements so far, which negative indices are relative to.
    size_t positionsSoFar = 0, normalsSoFar = 0, texcoordsSoFar = 0;
    Omission shortFaces, linesAndPoints, unknown, fans, badNormals, vertexColors;
    std::vector<std::string> missingMaterials;
};

std::string at(const ObjReading& reading, const Statement& statement)
{
    return fmt::format("{}:{}", reading.file, statement.line);
}

/// Reads all numbers of a statement; `count` of them are expected at least, `most` at most.
size_t readNumbers(const ObjReading& reading, const Statement& statement, size_t least, size_t most,
                   std::array<float, 8>& values, bool allowNotFinite)
{
    std::string_view rest = statement.rest;
    size_t n = 0;
    for (std::string_view word = takeWord(rest); !word.empty(); word = takeWord(rest)) {
        if (word[0] == '#') break;
        if (n == most) {
            throw badInput("{}: more than {} numbers behind \"{}\"", at(reading, statement), most,
                           statement.keyword);
        }
        NumberText how = parseNumber(word, values[n]);
        bool fine = how == NumberText::fine || (how == NumberText::notFinite && allowNotFinite);
        if (!fine) {
            throw badInput("{}: \"{}\" is not a {}number", at(reading, statement),
                           word.substr(0, 40), how == NumberText::notFinite ? "finite " : "");
        }
        if (how == NumberText::notFinite) values[n] = 0;
        n++;
    }
    if (n < least) {
        throw badInput("{}: \"{}\" needs {} numbers, found {}", at(reading, statement),
                       statement.keyword, least, n);
    }
    return n;
}

void readVertexStatement(ObjReading& reading, const Statement& s)
{
    std::array<float, 8> x = {};
    Mesh& mesh = reading.result.mesh;
    if (s.keyword == "v") {
        size_t n = readNumbers(reading, s, 3, 7, x, false);
        if (n >= 6) reading.vertexColors.add(s);
        mesh.positions.push_back(toFloat(glm::dvec3(x[0], x[1], x[2])));
    } else if (s.keyword == "vn") {
        readNumbers(reading, s, 3, 3, x, true);
        vec3 normal = toFloat(glm::dvec3(x[0], x[1], x[2]));
        if (normal == vec3(0.0f)) reading.badNormals.add(s);
        mesh.normals.push_back(normal);
    } else if (s.keyword == "vt") {
        readNumbers(reading, s, 1, 3, x, false);
        reading.texcoords++;
    }
    if (mesh.positions.size() > MAX_VERTICES || mesh.normals.size() > MAX_VERTICES) {
        throw badInput("{}: more than {} vertices", at(reading, s), MAX_VERTICES);
    }
}

/// First pass: everything that faces may refer to, also from before it.
void readVertices(ObjReading& reading, std::string_view text)
{
    StatementReader statements(text);
    Statement s;
    while (statements.next(s)) {
        if (s.keyword[0] == 'v') readVertexStatement(reading, s);
    }
}

/// Turns an index of the file (from 1, or negative from the end of what came before) into one
/// from 0.
uint32_t readIndex(const ObjReading& reading, const Statement& s, std::string_view text,
                   size_t count, size_t soFar, const char* what)
{
    if (text.size() > 1 && text[0] == '+') text.remove_prefix(1);
    int64_t value = 0;
    auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    bool isNumber = error != std::errc::invalid_argument && stop == text.data() + text.size();
    if (!isNumber) {
        throw badInput("{}: \"{}\" is not a {} index", at(reading, s), text.substr(0, 40), what);
    }
    bool inRange = error == std::errc() && value != 0 && value <= static_cast<int64_t>(count) &&
                   value >= -static_cast<int64_t>(soFar);
    if (!inRange) {
        throw badInput("{}: {} index {} is out of range; the file has {} (counted from 1{})",
                       at(reading, s), what, text.substr(0, 40), count,
                       text[0] == '-' ? fmt::format(", {} above this line", soFar) : "");
    }
    return static_cast<uint32_t>(value > 0 ? value - 1 : static_cast<int64_t>(soFar) + value);
}

struct FaceCorner {
    uint32_t position = 0;
    uint32_t normal = SHAPE_FLAT;
};

/// "7", "7/3", "7//2" or "7/3/2"
FaceCorner readCorner(const ObjReading& reading, const Statement& s, std::string_view word)
{
    const Mesh& mesh = reading.result.mesh;
    std::array<std::string_view, 3> parts;
    size_t part = 0;
    std::string_view rest = word;
    for (;; part++) {
        if (part == 3) {
            throw badInput("{}: \"{}\" has more than 3 indices", at(reading, s),
                           word.substr(0, 40));
        }
        size_t slash = rest.find('/');
        parts[part] = rest.substr(0, slash);
        if (slash == std::string_view::npos) break;
        rest.remove_prefix(slash + 1);
    }
    FaceCorner corner;
    corner.position =
        readIndex(reading, s, parts[0], mesh.positions.size(), reading.positionsSoFar, "vertex");
    if (!parts[1].empty()) {
        readIndex(reading, s, parts[1], reading.texcoords, reading.texcoordsSoFar,
                  "texture coordinate");
    }
    if (!parts[2].empty()) {
        corner.normal =
            readIndex(reading, s, parts[2], mesh.normals.size(), reading.normalsSoFar, "normal");
    }
    return corner;
}

uint32_t useMaterial(ObjReading& reading, const ObjMaterial& material)
{
    auto next = static_cast<uint32_t>(reading.result.materials.size());
    auto [entry, isNew] = reading.usedMaterials.emplace(material.name, next);
    if (isNew) reading.result.materials.push_back(material);
    return entry->second;
}

void readFace(ObjReading& reading, const Statement& s)
{
    std::vector<FaceCorner> corners;
    std::string_view rest = s.rest;
    for (std::string_view word = takeWord(rest); !word.empty(); word = takeWord(rest)) {
        if (word[0] == '#') break;
        corners.push_back(readCorner(reading, s, word));
    }
    if (corners.size() < 3) {
        reading.shortFaces.add(s);
        return;
    }
    if (reading.material == NO_HIT) {
        ObjMaterial standard;
        standard.name = "default";
        reading.material = useMaterial(reading, standard);
    }
    Mesh& mesh = reading.result.mesh;
    std::vector<vec3> points;
    points.reserve(corners.size());
    for (const FaceCorner& corner : corners) points.push_back(mesh.positions[corner.position]);
    bool isFan = false;
    for (const auto& cut : triangulate(points, isFan)) {
        MeshTriangle triangle;
        triangle.material = reading.material;
        for (size_t k = 0; k < 3; k++) {
            triangle.position[k] = corners[cut[k]].position;
            triangle.normal[k] = corners[cut[k]].normal;
        }
        mesh.triangles.push_back(triangle);
    }
    if (isFan) reading.fans.add(s);
}

void readMaterialLibrary(ObjReading& reading, const Statement& s)
{
    // Names with blanks are common although the format separates several names by blanks.
    std::vector<std::string> names = {std::string(s.rest)};
    fs::path folder = folderOf(reading.file);
    std::error_code error;
    if (!fs::exists(resolvePath(reading.policy, folder, names[0], at(reading, s)), error)) {
        std::string_view rest = s.rest;
        names.clear();
        for (auto word = takeWord(rest); !word.empty(); word = takeWord(rest)) {
            names.emplace_back(word);
        }
    }
    for (const std::string& name : names) {
        fs::path path = resolvePath(reading.policy, folder, name, at(reading, s));
        if (fs::exists(path, error)) {
            readMtl(path, reading.library);
        } else {
            warn(fmt::format("{}: material file \"{}\" is missing; its materials become grey",
                             at(reading, s), name));
        }
    }
}

void readMaterialUse(ObjReading& reading, const Statement& s)
{
    std::string name(s.rest);
    auto found = reading.library.find(name);
    if (found != reading.library.end()) {
        reading.material = useMaterial(reading, found->second);
        return;
    }
    bool isNew = reading.usedMaterials.count(name) == 0;
    if (isNew) reading.missingMaterials.push_back(fmt::format("\"{}\" (line {})", name, s.line));
    ObjMaterial grey;
    grey.name = name.empty() ? "default" : name;
    reading.material = useMaterial(reading, grey);
}

/// Second pass: faces and materials.
void readFaces(ObjReading& reading, std::string_view text)
{
    static const std::set<std::string_view> ignored = {
        "g",   "o",     "s",        "mg",       "vp",         "usemap",   "maplib",
        "lod", "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj"};
    StatementReader statements(text);
    Statement s;
    while (statements.next(s)) {
        if (s.keyword == "v")
            reading.positionsSoFar++;
        else if (s.keyword == "vn")
            reading.normalsSoFar++;
        else if (s.keyword == "vt")
            reading.texcoordsSoFar++;
        else if (s.keyword == "f" || s.keyword == "fo")
            readFace(reading, s);
        else if (s.keyword == "usemtl")
            readMaterialUse(reading, s);
        else if (s.keyword == "mtllib")
            readMaterialLibrary(reading, s);
        else if (s.keyword == "l" || s.keyword == "p")
            reading.linesAndPoints.add(s);
        else if (ignored.count(s.keyword) == 0)
            reading.unknown.add(s);
    }
}

void tellOmissions(const ObjReading& reading)
{
    auto tell = [&](const Omission& omission, const std::string& what) {
        if (omission.count == 0) return;
        warn(fmt::format("{}: {} {} (first in line {})", reading.file, omission.count, what,
                         omission.firstLine));
    };
    tell(reading.shortFaces, "faces with fewer than 3 corners were left out");
    tell(reading.linesAndPoints, "lines or points were left out");
    tell(reading.badNormals, "normals have no direction; the facet's own is used");
    tell(reading.vertexColors, "vertices have a colour, which is not used");
    tell(reading.fans, fmt::format("polygons of more than {} corners are not convex and were cut "
                                   "into fans",
                                   MAX_EARS));
    tell(reading.unknown, fmt::format("statements such as \"{}\" are not known and were left out",
                                      reading.unknown.example));
    if (!reading.missingMaterials.empty()) {
        warn(fmt::format("{}: {} materials are not defined and become grey, first {}", reading.file,
                         reading.missingMaterials.size(), reading.missingMaterials.front()));
    }
}

}  // namespace

ObjFile readObj(const fs::path& file, const PathPolicy& policy)
{
    ObjReading reading;
    reading.file = file.string();
    reading.policy = policy;
    std::string text = normaliseLines(readTextFile(file, MAX_OBJ_BYTES), reading.file);
    readVertices(reading, text);
    readFaces(reading, text);
    tellOmissions(reading);
    if (reading.result.mesh.triangles.empty()) {
        throw badInput("{}: no faces: the file has {} vertices and no face with 3 corners or more",
                       reading.file, reading.result.mesh.positions.size());
    }
    return std::move(reading.result);
}

}  // namespace sahl
