// tinyobjloader reads the geometry, but it takes 0 for whatever is not a number, hands indices on
// unchecked and knows no lines. So it is given one statement at a time, after a strict check that
// names the line, and every index that comes back is checked once more.
#include "scene/obj_reader.h"

#include "scene/numbers.h"
#include "scene/polygon.h"
#include "scene/statements.h"
#include "util/error.h"
#include "util/gzip.h"

#include <tiny_obj_loader.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <istream>
#include <set>
#include <span>
#include <streambuf>
#include <utility>

namespace sahl {

namespace {

/// Holds fewer than 2^29 vertices, so that every index in range is an int of tinyobjloader's.
constexpr uint64_t MAX_OBJ_BYTES = uint64_t{4} << 30;

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

/// What faces number: the file has `count` of them, `soFar` of them above the current statement.
struct Elements {
    const char* name;
    size_t count = 0, soFar = 0;
};

struct ObjCorner {
    uint32_t position, normal, uv;  ///< as in MeshTriangle
};

struct ObjReading {
    std::string file;  ///< for messages
    PathPolicy policy;
    ObjFile result;
    Elements positions = {"vertex"}, normals = {"normal"}, texcoords = {"texture coordinate"};
    std::map<std::string, ObjMaterial> library;     ///< of all MTL files so far
    std::map<std::string, uint32_t> usedMaterials;  ///< name -> index in result.materials
    uint32_t material = NO_HIT;                     ///< in force; NO_HIT: none named yet
    Statement statement;                            ///< the current one
    size_t corners = 0;                             ///< of the current face
    std::vector<ObjCorner> face;                    ///< these, from one face to the next so that its memory stays
    std::vector<vec3> facePoints;                   ///< where they are
    Omission shortFaces, linesAndPoints, unknown, fans, badNormals, vertexColors;
    std::vector<std::string> missingMaterials;
};

Error misread(const ObjReading& reading, const char* what)
{
    return badInput("{}: tinyobjloader misreads {}; please write it more simply",
                    at(reading.statement), what);
}

/// First pass: everything that faces may refer to, also from before it.
void checkVertex(ObjReading& reading, std::string& line)
{
    const Statement& s = reading.statement;
    if (s.keyword == "v") {
        if (checkNumbers(s, 3, 7) >= 6) reading.vertexColors.add(s);
    } else if (s.keyword == "vn") {
        checkNumbers(s, 3, 3, true);
    } else if (s.keyword == "vt") {
        checkNumbers(s, 1, 3);
    }
    if (s.keyword == "v" || s.keyword == "vn" || s.keyword == "vt")
        line.append(s.keyword).append(" ").append(s.rest);
}

void addPosition(void* user, float x, float y, float z, float)
{
    auto& reading = *static_cast<ObjReading*>(user);
    // 0e999, for one: tinyobjloader computes 0 times infinity.
    if (!isFinite({x, y, z})) throw misread(reading, "a number");
    reading.result.mesh.positions.push_back(toFloat(glm::dvec3(x, y, z)));
    reading.positions.count++;
}

void addNormal(void* user, float x, float y, float z)
{
    auto& reading = *static_cast<ObjReading*>(user);
    vec3 normal = isFinite({x, y, z}) ? toFloat(glm::dvec3(x, y, z)) : vec3(0.0f);
    if (normal == vec3(0.0f)) reading.badNormals.add(reading.statement);
    reading.result.mesh.normals.push_back(normal);
    reading.normals.count++;
}

void addTexcoord(void* user, float u, float v, float)
{
    auto& reading = *static_cast<ObjReading*>(user);
    if (!isFinite({u, v, 0})) throw misread(reading, "a number");
    reading.result.mesh.uvs.emplace_back(toFloat(u), toFloat(v));
    reading.texcoords.count++;
}

/// Turns an index of the file (from 1, or negative from the end of what came before) into one
/// from 0; NO_HIT when it is out of range.
uint32_t findElement(const Elements& elements, int64_t value)
{
    int64_t index = value > 0 ? value - 1 : static_cast<int64_t>(elements.soFar) + value;
    bool inRange = value != 0 && index >= 0 && index < static_cast<int64_t>(elements.count);
    return inRange ? static_cast<uint32_t>(index) : NO_HIT;
}

void checkIndex(const ObjReading& reading, std::string_view text, const Elements& elements)
{
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    int64_t value = 0;
    auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc::invalid_argument || stop != text.data() + text.size()) {
        throw badInput("{}: \"{}\" is not a {} index", at(reading.statement), text.substr(0, 40),
                       elements.name);
    }
    if (error != std::errc() || findElement(elements, value) == NO_HIT) {
        throw badInput("{}: {} index {} is out of range; the file has {} (counted from 1{})",
                       at(reading.statement), elements.name, text.substr(0, 40), elements.count,
                       text[0] == '-' ? fmt::format(", {} above this line", elements.soFar) : "");
    }
}

/// "7", "7/3", "7//2" or "7/3/2"
void checkCorner(const ObjReading& reading, std::string_view word)
{
    if (std::count(word.begin(), word.end(), '/') > 2) {
        throw badInput("{}: \"{}\" has more than 3 indices", at(reading.statement),
                       word.substr(0, 40));
    }
    for (const Elements* kind : {&reading.positions, &reading.texcoords, &reading.normals}) {
        size_t slash = std::min(word.find('/'), word.size());
        if (slash > 0 || kind == &reading.positions) {
            checkIndex(reading, word.substr(0, slash), *kind);
        }
        word.remove_prefix(std::min(slash + 1, word.size()));
    }
}

void checkFace(ObjReading& reading, std::string& line)
{
    std::string_view rest = reading.statement.rest;
    line += 'f';
    reading.corners = 0;
    for (auto word = takeWord(rest); !word.empty() && word[0] != '#'; word = takeWord(rest)) {
        checkCorner(reading, word);
        // Behind a slash at the end, tinyobjloader would take the next corner's index.
        line.append(" ").append(word.substr(0, word.find_last_not_of('/') + 1));
        reading.corners++;
    }
    if (reading.corners >= 3) return;
    reading.shortFaces.add(reading.statement);
    line.clear();
}

uint32_t useMaterial(ObjReading& reading, const ObjMaterial& material)
{
    auto next = static_cast<uint32_t>(reading.result.materials.size());
    auto [entry, isNew] = reading.usedMaterials.emplace(material.name, next);
    if (isNew) reading.result.materials.push_back(material);
    return entry->second;
}

void addTriangle(ObjReading& reading, const std::array<uint32_t, 3>& cornersOfFace)
{
    MeshTriangle triangle;
    triangle.material = reading.material;
    for (size_t k = 0; k < 3; k++) {
        const ObjCorner& corner = reading.face[cornersOfFace[k]];
        triangle.position[k] = corner.position;
        triangle.normal[k] = corner.normal;
        triangle.uv[k] = corner.uv;
    }
    reading.result.mesh.triangles.push_back(triangle);
}

void addFace(void* user, tinyobj::index_t* corners, int count)
{
    auto& reading = *static_cast<ObjReading*>(user);
    auto find = [&](const Elements& elements, int value) {
        uint32_t index = findElement(elements, value);
        return index != NO_HIT ? index : throw misread(reading, "an index");
    };
    if (static_cast<size_t>(count) != reading.corners) throw misread(reading, "the face");
    if (reading.material == NO_HIT) reading.material = useMaterial(reading, {"default"});
    reading.face.clear();
    for (const tinyobj::index_t& corner : std::span(corners, reading.corners)) {
        const bool hasNormal = corner.normal_index != 0, hasUv = corner.texcoord_index != 0;
        reading.face.push_back({find(reading.positions, corner.vertex_index),
                                hasNormal ? find(reading.normals, corner.normal_index) : SHAPE_FLAT,
                                hasUv ? find(reading.texcoords, corner.texcoord_index) : NO_UV});
    }
    if (reading.corners == 3) return addTriangle(reading, {0, 1, 2});

    reading.facePoints.clear();
    for (const ObjCorner& corner : reading.face)
        reading.facePoints.push_back(reading.result.mesh.positions[corner.position]);
    bool isFan = false;
    for (const auto& cut : triangulate(reading.facePoints, isFan)) addTriangle(reading, cut);
    if (isFan) reading.fans.add(reading.statement);
}

void readMaterialLibrary(ObjReading& reading)
{
    const Statement& s = reading.statement;
    fs::path folder = folderOf(reading.file);
    std::error_code error;
    std::string_view rest = s.rest;
    // Names with blanks are common although the format separates several names by blanks.
    bool isOneName =
        fs::exists(resolvePath(reading.policy, folder, std::string(rest), at(s)), error);
    while (!rest.empty()) {
        std::string name(isOneName ? std::exchange(rest, {}) : takeWord(rest));
        fs::path path = resolvePath(reading.policy, folder, name, at(s));
        if (fs::exists(path, error)) {
            readMtl(path, reading.policy, reading.library);
        } else {
            warn(fmt::format("{}: material file \"{}\" is missing; its materials become grey",
                             at(s), name));
        }
    }
}

void setMaterial(void* user, const char* name, int)
{
    auto& reading = *static_cast<ObjReading*>(user);
    auto found = reading.library.find(name);
    bool isKnown = found != reading.library.end();
    if (!isKnown && reading.usedMaterials.count(name) == 0) {
        reading.missingMaterials.push_back(
            fmt::format("\"{}\" (line {})", name, reading.statement.line));
    }
    ObjMaterial grey{*name == '\0' ? "default" : name};
    reading.material = useMaterial(reading, isKnown ? found->second : grey);
}

/// Second pass: faces and materials.
void checkOther(ObjReading& reading, std::string& line)
{
    static const std::set<std::string_view> ignored = {
        "g",   "o",     "s",        "mg",       "vp",         "usemap",   "maplib",
        "lod", "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj"};
    const Statement& s = reading.statement;
    if (s.keyword == "f" || s.keyword == "fo")
        checkFace(reading, line);
    else if (s.keyword == "v")
        reading.positions.soFar++;
    else if (s.keyword == "vn")
        reading.normals.soFar++;
    else if (s.keyword == "vt")
        reading.texcoords.soFar++;
    else if (s.keyword == "usemtl")
        line.append("usemtl ").append(s.rest);
    else if (s.keyword == "mtllib")
        readMaterialLibrary(reading);
    else if (s.keyword == "l" || s.keyword == "p")
        reading.linesAndPoints.add(s);
    else if (ignored.count(s.keyword) == 0)
        reading.unknown.add(s);
}

/// Checks the current statement; leaves `line` empty to keep it from tinyobjloader.
using Check = void(ObjReading& reading, std::string& line);

/// Gives out one checked statement at a time, so that callbacks know the line they are called for.
class CheckedStatements : public std::streambuf {
public:
    CheckedStatements(ObjReading& reading, std::string_view text, Check& check)
        : reading_(reading), statements_(text, reading.file), check_(check)
    {
    }

private:
    int_type underflow() override
    {
        line_.clear();
        while (line_.empty()) {
            if (!statements_.next(reading_.statement)) return traits_type::eof();
            check_(reading_, line_);
        }
        line_ += '\n';
        setg(line_.data(), line_.data(), line_.data() + line_.size());
        return traits_type::to_int_type(line_[0]);
    }

    ObjReading& reading_;
    StatementReader statements_;
    Check& check_;
    std::string line_;
};

void readStatements(ObjReading& reading, std::string_view text, Check& check)
{
    CheckedStatements statements(reading, text, check);
    std::istream stream(&statements);
    stream.exceptions(std::ios::badbit);  // lets errors of the checks through
    tinyobj::callback_t callbacks;
    callbacks.vertex_cb = addPosition;
    callbacks.normal_cb = addNormal;
    callbacks.texcoord_cb = addTexcoord;
    callbacks.index_cb = addFace;
    callbacks.usemtl_cb = setMaterial;
    tinyobj::LoadObjWithCallback(stream, callbacks, &reading);
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
    std::string text = normaliseLines(readUnpackedText(file, MAX_OBJ_BYTES), reading.file);
    readStatements(reading, text, checkVertex);
    readStatements(reading, text, checkOther);
    tellOmissions(reading);
    if (reading.result.mesh.triangles.empty()) {
        throw badInput("{}: no faces: the file has {} vertices and no face with 3 corners or more",
                       reading.file, reading.result.mesh.positions.size());
    }
    return std::move(reading.result);
}

}  // namespace sahl
