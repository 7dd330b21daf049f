// PLY files: what is read, what is left out, and what is said about it.
#include "scene/ply_reader.h"
#include "support/assets.h"
#include "support/gzip_files.h"
#include "support/ply_files.h"
#include "support/scene_files.h"

namespace sahl {
namespace {

using namespace sahl::testing;

const std::vector<PlyItem> SQUARE = {floats({0, 0, 0}), floats({1, 0, 0}), floats({1, 1, 0}),
                                     floats({0, 1, 0})};

std::vector<PlyItem> squareAnd(std::vector<PlyItem> more)
{
    std::vector<PlyItem> items = SQUARE;
    items.insert(items.end(), more.begin(), more.end());
    return items;
}

Scene loadPly(const std::string& bytes, const SceneOptions& options = {})
{
    return loadText("mesh.ply", bytes, options);
}

std::string errorOfPly(const std::string& bytes)
{
    return errorOfText("mesh.ply", bytes);
}

Mesh meshOf(const std::string& bytes)
{
    SceneFolder files;
    return readPly(files.write("mesh.ply", bytes));
}

/// Corners of the triangles, by position.
std::vector<std::array<uint32_t, 3>> cornersOf(const Mesh& mesh)
{
    std::vector<std::array<uint32_t, 3>> corners;
    for (const MeshTriangle& triangle : mesh.triangles) corners.push_back(triangle.position);
    return corners;
}

using Corners = std::vector<std::array<uint32_t, 3>>;

TEST(Ply, everyFormatGivesTheSameSceneWithGreyMaterialStudioAndCamera)
{
    for (PlyFormat format : PLY_FORMATS) {
        const Scene scene =
            loadPly(ply(format, plyElements(4, 1), squareAnd({face({0, 1, 2, 3})})));
        ASSERT_EQ(scene.primitives.size(), 2u);
        EXPECT_EQ(scene.primitives[0].p1, vec3(1, 0, 0));
        EXPECT_EQ(scene.primitives[1].p2, vec3(0, 1, 0));
        EXPECT_EQ(scene.primitives[0].shape, SHAPE_FLAT);
        EXPECT_EQ(scene.materials.at(0).baseColor, vec3(0.7f));
        EXPECT_EQ(scene.probe.width, 256u);
        EXPECT_GT(scene.camera.position.z, 0);
    }
}

TEST(Ply, readsNumbersOfEveryType)
{
    const std::pair<const char*, PlyType> types[] = {
        {"char", PlyType::int8},      {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
        {"uint8", PlyType::uint8},    {"short", PlyType::int16},     {"int16", PlyType::int16},
        {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},   {"int", PlyType::int32},
        {"int32", PlyType::int32},    {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
        {"float", PlyType::float32},  {"float32", PlyType::float32}, {"double", PlyType::float64},
        {"float64", PlyType::float64}};
    for (const auto& [name, type] : types) {
        const bool isSigned = name[0] != 'u';
        const double least = isSigned ? -100 : 100;
        const std::string elements =
            fmt::format("element vertex 3\nproperty {0} x\nproperty {0} y\nproperty {0} z\n"
                        "element face 1\nproperty list {0} {0} vertex_index\n",
                        name);
        for (PlyFormat format : PLY_FORMATS) {
            const Mesh mesh = meshOf(ply(format, elements,
                                         {{{type, least}, {type, 0}, {type, 3}},
                                          {{type, 1}, {type, 0}, {type, 0}},
                                          {{type, 0}, {type, 1}, {type, 0}},
                                          {{type, 3}, {type, 2}, {type, 0}, {type, 1}}}));
            EXPECT_EQ(mesh.positions.at(0), vec3(least, 0, 3)) << name;
            EXPECT_EQ(cornersOf(mesh), (Corners{{2, 0, 1}})) << name;
        }
    }
}

TEST(Ply, polygonsAreCutAlsoWhereTheyAreConcave)
{
    const std::vector<PlyItem> arrow = {floats({0, 0, 0}), floats({4, -2, 0}), floats({1, 0, 0}),
                                        floats({4, 2, 0}), face({1, 2, 3, 0})};
    for (PlyFormat format : PLY_FORMATS) {
        const Mesh mesh = meshOf(ply(format, plyElements(4, 1), arrow));
        ASSERT_EQ(mesh.triangles.size(), 2u);
        for (const auto& [a, b, c] : cornersOf(mesh)) {
            const vec3* p = mesh.positions.data();
            EXPECT_GT(glm::cross(p[b] - p[a], p[c] - p[a]).z, 0);
        }
    }
}

TEST(Ply, stripsBecomeTrianglesOfOneWinding)
{
    const std::string elements =
        "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
        "element tristrips 2\nproperty list uchar int vertex_indices\n";
    for (PlyFormat format : PLY_FORMATS) {
        // -1 ends a strip; the repeated corner in the second one turns the winding.
        const Mesh mesh = meshOf(ply(
            format, elements, squareAnd({face({0, 1, 3, 2, -1, 1, 2, 3}), face({0, 0, 1, 2})})));
        EXPECT_EQ(cornersOf(mesh), (Corners{{0, 1, 3}, {3, 1, 2}, {1, 2, 3}, {1, 0, 2}}));
    }
}

TEST(Ply, normalsOfTheFileAreUsedAndBadOnesBecomeTheFacets)
{
    const std::string elements =
        "element vertex 3\nproperty float nx\nproperty float ny\nproperty float nz\n"
        "property double z\nproperty double y\nproperty double x\n"
        "element face 1\nproperty list uchar int vertex_indices\n";
    auto vertex = [](double ny, double nz, double x, double y) {
        PlyItem item = floats({0, ny, nz});
        for (double value : {0.0, y, x}) item.emplace_back(PlyType::float64, value);
        return item;
    };
    for (PlyFormat format : PLY_FORMATS) {
        Scene scene;
        const std::string warning = warningsOf([&] {
            scene = loadPly(ply(
                format, elements,
                {vertex(3, 4, 0, 0), vertex(NAN, 0, 1, 0), vertex(0, 0, 0, 1), face({0, 1, 2})}));
        });
        EXPECT_EQ(scene.triangleCorners.at(0).n0, vec3(0, 0.6f, 0.8f));
        EXPECT_EQ(scene.triangleCorners.at(0).n1, vec3(0, 0, 1));
        EXPECT_EQ(scene.triangleCorners.at(0).n2, vec3(0, 0, 1));
        EXPECT_CONTAINS(warning, "2 normals have no direction");
    }
}

TEST(Ply, otherElementsAndPropertiesAreSkippedAndNamed)
{
    const std::string elements =
        "comment made by hand\nobj_info nothing\n"
        "element camera 1\nproperty double a\nproperty list ushort double more\n"
        "element nothing 1000000000000000000\n"
        "element vertex 3\nproperty uchar red\nproperty float x\nproperty float y\n"
        "property list uchar short odd\nproperty float z\nproperty float u\n"
        "element face 1\nproperty uchar flags\nproperty list uchar int vertex_index\n"
        "property list int float extra\nelement edge 1\nproperty int from\nproperty int to\n";
    const PlyType byte = PlyType::uint8, real = PlyType::float32, whole = PlyType::int32;
    auto vertex = [&](double x, double y) {
        return PlyItem{{byte, 7},
                       {real, x},
                       {real, y},
                       {byte, 2},
                       {PlyType::int16, -1},
                       {PlyType::int16, 300},
                       {real, 0},
                       {real, 0.5}};
    };
    for (PlyFormat format : PLY_FORMATS) {
        Mesh mesh;
        const std::string warning = warningsOf([&] {
            mesh = meshOf(ply(
                format, elements,
                {{{PlyType::float64, 1},
                  {PlyType::uint16, 2},
                  {PlyType::float64, 2},
                  {PlyType::float64, 3}},
                 vertex(0, 0),
                 vertex(1, 0),
                 vertex(0, 1),
                 {{byte, 1}, {byte, 3}, {whole, 0}, {whole, 1}, {whole, 2}, {whole, 1}, {real, 9}},
                 {{whole, 0}, {whole, 1}}}));
        });
        EXPECT_EQ(mesh.positions, (std::vector<vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
        EXPECT_EQ(cornersOf(mesh), (Corners{{0, 1, 2}}));
        EXPECT_CONTAINS(warning, "not used: camera, nothing, vertex red, vertex odd, face flags, "
                                 "face extra, edge\n");
    }
}

TEST(Ply, headersMayHaveLineEndsOfEverySystem)
{
    for (const char* lineEnd : {"\n", "\r\n", "\r"}) {
        for (PlyFormat format : PLY_FORMATS) {
            const std::string file =
                ply(format, plyElements(4, 1), squareAnd({face({0, 1, 2, 3})}), lineEnd);
            EXPECT_EQ(meshOf(file).triangles.size(), 2u);
        }
    }
}

TEST(Ply, dataMayBeginWithTheByteOfALineEnd)
{
    // 0x0a begins this float, behind the header's own line end.
    const float odd = std::bit_cast<float>(0x40be0a0au);
    const std::string file = ply(PlyFormat::littleEndian, plyElements(3, 1),
                                 {floats({odd, 0, 0}), SQUARE[1], SQUARE[3], face({0, 1, 2})});
    EXPECT_EQ(meshOf(file).positions.at(0).x, odd);
}

TEST(Ply, textMistakesAreNamedWithTheirLine)
{
    const std::string head = "ply\nformat ascii 1.0\n" + plyElements(3, 1) + "end_header\n";
    const std::string three = "0 0 0\n1 0 0\n\n0 1 0\n";  // the face is line 14
    const std::pair<std::string, const char*> mistakes[] = {
        {head + three + "3 0 1 3\n",
         "mesh.ply:14: \"vertex_indices\" has the index 3, out of range; "
         "the file has 3 vertices, counted from 0"},
        {head + three + "3 0 1 -1\n", "mesh.ply:14: \"vertex_indices\" has the index -1, out of"},
        {head + three + "3 0 1 0.5\n", "mesh.ply:14: \"vertex_indices\" has the index 0.5, out of"},
        {head + three + "3 0 1\n", "mesh.ply:14: the list \"vertex_indices\" of 3 values does not"},
        {head + three + "3 0   2\n", "mesh.ply:14: face 0 has no value for property \"vertex_ind"},
        {head + three + "3 0 1 2 2\n", "mesh.ply:14: face 0 has more values than properties, from"},
        {head + three + "4294967295 0 1 2\n",
         "mesh.ply:14: the list \"vertex_indices\" of 42949672"},
        {head + three + "-1 0 1 2\n", "mesh.ply:14: -1 is no length of the list"},
        {head + three + "2.5 0 1 2\n", "mesh.ply:14: 2.5 is no length of the list"},
        {head + three + "inf 0 1 2\n", "mesh.ply:14: nan is no length of the list"},
        {head + three + "three\n", "mesh.ply:14: \"three\" is not a number"},
        {head + three + "                \n",
         "mesh.ply:14: the file ends, and face 0 of 1 is miss"},
        {head + "0 0 x\n" + three, "mesh.ply:10: \"x\" is not a number"},
        {head + "0 0 nan\n" + three, "mesh.ply:10: \"z\" of vertex 0 is not a finite number"},
        {head + "0 1e39 0\n" + three, "mesh.ply:10: \"y\" of vertex 0 is not a finite number"},
        {head + "0 0\n" + three, "mesh.ply:10: vertex 0 has no value for property \"z\""},
        {head + three + "2 0 1\n",
         "mesh.ply: no faces: the file has 3 vertices and no face with 3"},
        {head + three + "3 0 0 1\n", "no faces: all 1 triangles have zero area"}};
    for (const auto& [file, message] : mistakes) EXPECT_CONTAINS(errorOfPly(file), message);
}

TEST(Ply, binaryMistakesAreNamedWithTheirByte)
{
    for (PlyFormat format : {PlyFormat::littleEndian, PlyFormat::bigEndian}) {
        auto error = [&](const PlyItem& last) {
            return errorOfPly(ply(format, plyElements(4, 1), squareAnd({last})));
        };
        const size_t faceAt = ply(format, plyElements(4, 1), SQUARE).size();
        EXPECT_CONTAINS(
            error(face({0, 1, 4})),
            fmt::format("mesh.ply: byte {} (face 0): \"vertex_indices\" has the index 4",
                        faceAt + 9));
        EXPECT_CONTAINS(error({{PlyType::uint8, 3}, {PlyType::int32, 0}}),
                        fmt::format("mesh.ply: byte {} (face 0): the list \"vertex_indices\" of 3 "
                                    "values does not fit into the 4 bytes that are left",
                                    faceAt));
        EXPECT_CONTAINS(error({}), "mesh.ply: is truncated, or its header is wrong: 1 elements");
        std::vector<PlyItem> items = squareAnd({face({0, 1, 2})});
        items[2] = floats({0, INFINITY, 0});
        EXPECT_CONTAINS(errorOfPly(ply(format, plyElements(4, 1), items)),
                        fmt::format("byte {} (vertex 2): \"y\" of vertex 2 is not a finite number",
                                    faceAt - 20));
    }
}

TEST(Ply, headersThatAreWrongAreNamedWithTheirLine)
{
    const std::string ascii = "ply\nformat ascii 1.0\n";
    const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
    const std::pair<std::string, const char*> mistakes[] = {
        {"", "mesh.ply: is no PLY file: it begins with \"\", not with a line \"ply\""},
        {"solid thing\n", "mesh.ply: is no PLY file: it begins with \"solid thing\""},
        {"ply\n", "mesh.ply:2: the file ends within the header; \"end_header\" is missing"},
        {"ply\nend_header\n", "mesh.ply: the header names no format"},
        {"ply\nformat ascii 2.0\n",
         "mesh.ply:2: format \"ascii\" \"2.0\" is not known; ascii, binary"},
        {"ply\nformat binary 1.0\n", "mesh.ply:2: format \"binary\" \"1.0\" is not known"},
        {"ply\nformat ascii\n", "mesh.ply:2: the version of the format is missing"},
        {ascii + "format ascii 1.0\n", "mesh.ply:3: the format is there twice"},
        {ascii + "elment vertex 3\n", "mesh.ply:3: \"elment\" is no statement of a PLY header"},
        {ascii + "element vertex\n", "mesh.ply:3: the number of elements is missing"},
        {ascii + "element vertex -3\n", "mesh.ply:3: \"-3\" is no number of elements"},
        {ascii + "element vertex 99999999999999999999\n", "is no number of elements"},
        {ascii + "element vertex 3 4\n", "mesh.ply:3: \"4\" behind the end of the statement"},
        {ascii + "element a\x01 3\n", "mesh.ply:3: the name of the element is \"a?\"; names have"},
        {ascii + "element a 1\nelement a 1\n", "mesh.ply:4: element \"a\" is there twice"},
        {ascii + "property float x\n", "mesh.ply:3: a property before the first element"},
        {ascii + "element a 1\nproperty real x\n", "mesh.ply:4: type \"real\" is not known; there"},
        {ascii + "element a 1\nproperty list uchar int\n",
         "mesh.ply:4: the name of the property is"},
        {ascii + "element a 1\n" + xyz + xyz,
         "mesh.ply:7: property \"x\" of element \"a\" is there tw"},
        {ascii + std::string(5000, 'x') + "\n",
         "mesh.ply:3: a line of the header has more than 4096"},
        {ascii + "element vertex 0\nproperty float x\nproperty float y\nend_header\n",
         "mesh.ply: the element \"vertex\" needs the property \"z\", a number"},
        {ascii + "element vertex 0\n" + xyz + "end_header\n", "mesh.ply: no faces: the file has 0"},
        {ascii + "element vertex 0\n" + xyz + "element face 1\nproperty int a\nend_header\n0\n",
         "mesh.ply: element \"face\" needs a list \"vertex_indices\""},
        {ascii + "element face 1\nproperty list int int vertex_index\nend_header\n0\n",
         "mesh.ply: element \"face\" stands before \"vertex\"; write the vertices first"}};
    for (const auto& [file, message] : mistakes) EXPECT_CONTAINS(errorOfPly(file), message);
}

TEST(Ply, numbersOfElementsAreNotBelieved)
{
    for (PlyFormat format : PLY_FORMATS) {
        for (const char* count : {"1000000000000", "18446744073709551615", "5"}) {
            const std::string faces = fmt::format(
                "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                "element face {}\nproperty list uchar int vertex_indices\n",
                count);
            EXPECT_CONTAINS(
                errorOfPly(ply(format, faces, squareAnd({{{PlyType::uint8, 0}}}))),
                fmt::format("header is wrong: {} elements \"face\" of at least", count));
        }
        std::string elements =
            "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
            "element face 1\nproperty list uint int vertex_indices\n";
        EXPECT_CONTAINS(
            errorOfPly(ply(format, elements, squareAnd({{{PlyType::uint32, 4294967295.0}}}))),
            "the list \"vertex_indices\" of 4294967295 values does not fit into the ");
    }
}

TEST(Ply, whatIsLeftOutIsTold)
{
    const std::string head = "ply\nformat ascii 1.0\n" + plyElements(3, 3) + "end_header\n";
    const std::string warning =
        warningsOf([&] { loadPly(head + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n2 0 1\n0\nmore\n"); });
    EXPECT_CONTAINS(warning, "mesh.ply:14: 2 faces with fewer than 3 corners were left out");
    EXPECT_CONTAINS(warning, "mesh.ply: 5 bytes after the last element are ignored");
}

TEST(Ply, isAShapeOfScenesWithMaterialAndSmoothNormals)
{
    SceneFolder files;
    const std::string mesh =
        ply(PlyFormat::bigEndian, plyElements(4, 1), squareAnd({face({0, 1, 2, 3})}));
    files.write("plain.ply", mesh);
    files.write("packed.PLY.gz", packed(mesh));
    files.write("s.json",
                R"({ "materials": { "red": { "type": "lambert", "baseColor": [1, 0, 0] } },
        "shapes": [{ "type": "mesh", "file": "plain.ply", "material": "red", "smoothNormals": true },
                   { "type": "mesh", "file": "packed.PLY.gz", "transform": { "scale": 2 } }] })");
    Scene scene;
    warningsOf([&] { scene = files.load("s.json"); });
    ASSERT_EQ(scene.primitives.size(), 4u);
    EXPECT_EQ(scene.triangleCorners.size(), 2u);
    EXPECT_EQ(scene.materials.at(scene.primitives[0].material).baseColor, vec3(1, 0, 0));
    EXPECT_EQ(scene.primitives[2].p1, vec3(2, 0, 0));
    EXPECT_EQ(scene.materials.at(scene.primitives[2].material).baseColor, vec3(0.7f));
    files.write("mesh.stl", "solid");
    files.write("t.json", R"({ "shapes": [{ "type": "mesh", "file": "mesh.stl" }] })");
    EXPECT_CONTAINS(errorOfFile(files, "t.json"),
                    "mesh.stl: \".stl\" is no kind of mesh that is read; use .obj, .ply, .gltf or .glb");
}

TEST(Ply, packedObjFilesFindTheirMaterialsBesideThem)
{
    SceneFolder files;
    files.write("m.mtl", "newmtl a\nKd 0 1 0\n");
    files.write("a.obj.gz", packed("mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n"));
    EXPECT_EQ(files.load("a.obj.gz").materials.at(0).baseColor, vec3(0, 1, 0));
}

TEST(Ply, filesOfOtherProgramsHaveTheirNumbersOfTriangles)
{
    const std::pair<const char*, size_t> meshes[] = {
        {"bad/ply-assimp/cube.ply", 12},
        {"bad/ply-assimp/cube_binary.ply", 12},
        {"bad/ply-assimp/cube_binary_starts_with_nl.ply", 12},
        {"bad/ply-assimp/cube_uv.ply", 12},
        {"meshes/bunny_mitsuba.ply", 69451},
        {"meshes/teapot_mitsuba.ply", 2256},
        {"meshes/dragon_vrip_res4.ply.gz", 11102},
        {"meshes/dragon_vrip_res3.ply.gz", 47794},
        {"meshes/igea.ply.gz", 268686},
        {"meshes/nefertiti.obj.gz", 99938},
        {"references/mitsuba/tests/ply/rectangle_normals_uv.ply", 2},
        {"references/mitsuba/tests/scenes/mesh_attributes/meshes/sphere_attribute.ply", 528},
        {"references/bitterli/coffee/models/Mesh000.ply", 10848}};
    for (const auto& [name, count] : meshes) {
        SAHL_REQUIRE_ASSET(name);
        Scene scene;
        warningsOf([&, file = name] { scene = loadScene(assetFolder() / file, {}); });
        EXPECT_EQ(scene.primitives.size() + scene.droppedTriangles, count) << name;
    }
}

TEST(Ply, brokenFilesOfOtherProgramsAreRefused)
{
    const std::pair<const char*, const char*> files[] = {
        {"bad/ply-assimp/issue623.ply",
         "issue623.ply:14: vertex 0 has no value for property \"vertex_indices\""},
        {"bad/invalid-assimp/crash-30d6d0f7c529b3b66b4131700b7a4580cd7082df.ply",
         "7082df.ply:7: the file ends within the header"}};
    for (const auto& [name, message] : files) {
        SAHL_REQUIRE_ASSET(name);
        EXPECT_CONTAINS(badInputOf([file = name] { loadScene(assetFolder() / file, {}); }),
                        message);
    }
}

}  // namespace
}  // namespace sahl
