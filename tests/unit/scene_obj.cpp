// OBJ and MTL files: what is read, what is left out, and what is said about it.
#include "support/assets.h"
#include "support/scene_files.h"

#include <cmath>

namespace sahl {
namespace {

using namespace sahl::testing;

const std::string TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
const std::string SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(Obj, readsATriangleWithGreyMaterialStudioAndCamera)
{
    const Scene scene = loadObj(TRIANGLE + "f 1 2 3\n");
    ASSERT_EQ(scene.primitives.size(), 1u);
    EXPECT_EQ(scene.primitives[0].p1, vec3(1, 0, 0));
    EXPECT_EQ(scene.primitives[0].shape, SHAPE_FLAT);
    EXPECT_EQ(scene.materials.at(0).baseColor, vec3(0.7f));
    EXPECT_EQ(scene.probe.width, 256u);
    EXPECT_EQ(scene.probeTexels.size(), 256u * 128u);
    EXPECT_GT(scene.camera.position.z, 0);
}

TEST(Obj, readsEveryWayToWriteAFace)
{
    const std::string head = TRIANGLE + "vt 0 0\nvn 0 0 2\n";
    for (const char* face :
         {"f 1 2 3", "f 1/1 2/1 3/1", "f 1//1 2//1 3//1", "f 1/1/1 2/1/1 3/1/1", "f -3 -2 -1",
          "f\t1  2\t3 \r", "f 1 \\\n2 3", "f 1/ 2/ 3/", "fo 1 2 3", "f 1// 2// 3//",
          "f 1/1/ 2/1/ 3/1/", "f\v1\f2 3", "f +1 +2 +3", "  f 1 2 3 # comment 4"}) {
        const Scene scene = loadObj(head + face);
        ASSERT_EQ(scene.primitives.size(), 1u) << face;
        EXPECT_EQ(scene.primitives[0].p1, vec3(1, 0, 0)) << face;
    }
    const Scene normals = loadObj(head + "f 1//1 2//1 3//-1");
    EXPECT_EQ(normals.triangleCorners.at(0).n0, vec3(0, 0, 1));
}

TEST(Obj, facesMayStandBeforeTheirVertices)
{
    EXPECT_EQ(loadObj("f 1 2 3\n" + TRIANGLE).primitives.size(), 1u);
}

TEST(Obj, readsLineEndsOfEverySystemAndAByteOrderMark)
{
    EXPECT_EQ(loadObj("\xEF\xBB\xBFv 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3").primitives.size(), 1u);
    EXPECT_EQ(loadObj("v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3").primitives.size(), 1u);
}

TEST(Obj, numbersAreReadToTheNearestFloatOrItsNeighbour)
{
    // 1 + 2^-24 lies half way between two floats. tinyobjloader adds the digits up as doubles, one
    // rounding each, so next to half way it may take either: one unit in the last place, 2^-23.
    const Scene scene = loadObj("v 1.000000059604644775390625 0 0\n"
                                "v 1.0000000596046447753906251 +1e-3 .5\nv 5. -1E1 1e-40\nf 1 2 3");
    EXPECT_NEAR(scene.primitives.at(0).p0.x, 1, 0x1p-23);
    EXPECT_NEAR(scene.primitives.at(0).p1.x, 0x1.000002p0, 0x1p-23);
    EXPECT_EQ(scene.primitives.at(0).p1.y, 1e-3f);
    EXPECT_EQ(scene.primitives.at(0).p1.z, 0.5f);
    EXPECT_EQ(scene.primitives.at(0).p2, vec3(5, -10, 0));  // 1e-40 is below 1e-30
}

TEST(Obj, polygonsBecomeTrianglesOfTheSameArea)
{
    EXPECT_EQ(loadObj(SQUARE + "f 1 2 3 4").primitives.size(), 2u);
    std::string circle, face = "f";
    for (int i = 0; i < 300; i++) {
        circle += fmt::format("v {} {} 0\n", std::cos(i * 0.02), std::sin(i * 0.02));
        face += fmt::format(" {}", i + 1);
    }
    EXPECT_EQ(loadObj(circle + face).primitives.size(), 298u);
    // A concave arrow head: a fan around corner 1 would cover the notch.
    const Scene arrow = loadObj("v 0 0 0\nv 4 -2 0\nv 1 0 0\nv 4 2 0\nf 2 3 4 1");
    double area = 0;
    for (const Primitive& t : arrow.primitives) {
        const vec3 n = glm::cross(t.p1 - t.p0, t.p2 - t.p0);
        EXPECT_GT(n.z, 0);
        area += n.z / 2;
    }
    EXPECT_EQ(arrow.primitives.size(), 2u);
    EXPECT_DOUBLE_EQ(area, 2);
}

TEST(Obj, meshesOfTheBenchmarkHaveTheirNumbersOfTriangles)
{
    const std::pair<const char*, size_t> meshes[] = {{"meshes/miro/teapot.obj", 576},
                                                     {"meshes/miro/bunny.obj", 69451},
                                                     {"meshes/miro/sponza.obj", 66454}};
    for (const auto& [name, count] : meshes) {
        SAHL_REQUIRE_ASSET(name);
        Scene scene;
        warningsOf([&, file = name] { scene = loadScene(assetFolder() / file, {}); });
        EXPECT_EQ(scene.primitives.size() + scene.droppedTriangles, count) << name;
    }
}

TEST(Obj, zeroAreaTrianglesAreLeftOutAndCounted)
{
    Scene scene;
    const std::string warning = warningsOf([&] {
        scene = loadObj("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.1 0.1 0.3\nv 0.2 0.2 0.6\nv 0.4 0.4 1.2\n"
                        "f 1 2 3\nf 1 1 2\nf 4 5 6\n");
    });
    EXPECT_EQ(scene.primitives.size(), 1u);
    EXPECT_EQ(scene.droppedTriangles, 2u);
    EXPECT_CONTAINS(warning, "left out 2 triangles of zero area");
}

TEST(Obj, whatIsLeftOutIsToldOncePerKind)
{
    const std::string warning = warningsOf([&] {
        loadObj(TRIANGLE +
                "f 1 2 3\nf 1 2\nf 1\nf\nl 1 2\np 1\nxyz 1\nvn 0 0 0\nusemtl nobody\nf 1 2 3\n");
    });
    EXPECT_CONTAINS(warning,
                    "mesh.obj: 3 faces with fewer than 3 corners were left out (first in line 5)");
    EXPECT_CONTAINS(warning, "mesh.obj: 2 lines or points were left out (first in line 8)");
    EXPECT_CONTAINS(warning, "mesh.obj: 1 statements such as \"xyz\" are not known");
    EXPECT_CONTAINS(warning, "mesh.obj: 1 normals have no direction");
    EXPECT_CONTAINS(warning,
                    "1 materials are not defined and become grey, first \"nobody\" (line 12)");
}

TEST(Obj, mistakesAreNamedWithTheirLine)
{
    const std::pair<const char*, const char*> mistakes[] = {
        {"f 0 1 2", "mesh.obj:4: vertex index 0 is out of range; the file has 3"},
        {"f 1 2 4", "mesh.obj:4: vertex index 4 is out of range; the file has 3"},
        {"f -4 2 3",
         "mesh.obj:4: vertex index -4 is out of range; the file has 3 (counted from 1, 3 above"},
        {"f 1 2 2147483649", "mesh.obj:4: vertex index 2147483649 is out of range"},
        {"f 1 2 18446744073709551617",
         "mesh.obj:4: vertex index 18446744073709551617 is out of range"},
        {"f 1/1 2/1 3/1", "mesh.obj:4: texture coordinate index 1 is out of range; the file has 0"},
        {"f 1//1 2//1 3//1", "mesh.obj:4: normal index 1 is out of range; the file has 0"},
        {"f 1 2 x", "mesh.obj:4: \"x\" is not a vertex index"},
        {"f 1 2 3.5", "mesh.obj:4: \"3.5\" is not a vertex index"},
        {"vt 0 0\nf 1/0 2 3", "mesh.obj:5: texture coordinate index 0 is out of range"},
        {"f 1 2 +-1", "mesh.obj:4: \"+-1\" is not a vertex index"},
        {"f 1/1/1/1 2 3", "mesh.obj:4: \"1/1/1/1\" has more than 3 indices"},
        {"v 1 2", "mesh.obj:4: \"v\" needs 3 numbers, found 2"},
        {"v 1 2 nan", "mesh.obj:4: \"nan\" is not a finite number"},
        {"v 1 2 -inf", "mesh.obj:4: \"-inf\" is not a finite number"},
        {"v 1 2 1e999", "mesh.obj:4: \"1e999\" is not a finite number"},
        {"v 1 2 1e39", "mesh.obj:4: \"1e39\" is not a finite number"},
        {"v 1 2 0e999", "mesh.obj:4: tinyobjloader misreads a number"},
        {"v 1 2 three", "mesh.obj:4: \"three\" is not a number"},
        {"v 1 2 1,5", "mesh.obj:4: \"1,5\" is not a number"},
        {"v 1 2 0x10", "mesh.obj:4: \"0x10\" is not a number"},
        {"vn 0 0 1 0", "mesh.obj:4: \"vn\" needs 3 numbers at most, found 4"},
        {"vt inf", "mesh.obj:4: \"inf\" is not a finite number"},
        {"v 1 \\\n2 bad", "mesh.obj:4: \"bad\" is not a number"},
        {"v 1 \\\n2 3\nv 1 2 bad", "mesh.obj:6: \"bad\" is not a number"},
        {"# no faces", "mesh.obj: no faces: the file has 3 vertices"},
    };
    for (const auto& [line, message] : mistakes) {
        EXPECT_CONTAINS(errorOfObj(TRIANGLE + line + "\n"), message);
    }
    EXPECT_CONTAINS(errorOfObj(TRIANGLE + "f 1 1 2\n"), "no faces: all 1 triangles have zero area");
}

TEST(Obj, normalsOfTheFileAreNormalisedAndBadOnesBecomeTheFacets)
{
    Scene scene;
    warningsOf(
        [&] { scene = loadObj(TRIANGLE + "vn 0 3 4\nvn nan 0 0\nvn 0 0 0\nf 1//1 2//2 3//3\n"); });
    const TriangleCorners& n = scene.triangleCorners.at(0);
    EXPECT_EQ(n.n0, vec3(0, 0.6f, 0.8f));
    EXPECT_EQ(n.n1, vec3(0, 0, 1));
    EXPECT_EQ(n.n2, vec3(0, 0, 1));
}

TEST(Obj, smoothNormalsAreTheMeanOfTheFacetsByAreaAcrossSeams)
{
    // Two squares at a right angle whose shared edge is written twice.
    const std::string roof =
        "v 0 0 0\nv 0 0 1\nv 1 0 1\nv 1 0 0\nv 0 0 0\nv 0 0 1\nv 0 1 1\nv 0 1 0\n"
        "f 1 2 3 4\nf 5 8 7 6\n";
    SceneOptions options;
    EXPECT_TRUE(loadObj(roof, options).triangleCorners.empty());
    options.smoothNormals = true;
    const Scene scene = loadObj(roof, options);
    ASSERT_EQ(scene.triangleCorners.size(), 4u);
    // At corner 1 both triangles of each square meet; at corner 2 one of each.
    const float d = 0.70710678f;
    EXPECT_NEAR(scene.triangleCorners[0].n0.x, d, 1e-7);
    EXPECT_NEAR(scene.triangleCorners[0].n0.y, d, 1e-7);
    EXPECT_EQ(scene.triangleCorners[0].n0, scene.triangleCorners[2].n0);
    EXPECT_EQ(scene.triangleCorners[0].n2, vec3(0, 1, 0));
}

TEST(Mtl, diffuseBecomesBaseColorAndEmissionIsKept)
{
    SceneFolder files;
    files.write(
        "m.mtl",
        "newmtl lamp\nKd 0.5 0.25 0\nKe 3 2 1\n\nnewmtl bare \n  newmtl hot\nKd 5 -1 0.5\n");
    files.write("a.obj", "mtllib m.mtl\n" + TRIANGLE +
                             "usemtl lamp\nf 1 2 3\nusemtl bare\nf 1 2 3\nusemtl hot \nf 1 2 3\n");
    Scene scene;
    const std::string warning = warningsOf([&] { scene = files.load("a.obj"); });
    ASSERT_EQ(scene.materials.size(), 3u);
    EXPECT_EQ(scene.materials[0].baseColor, vec3(0.5f, 0.25f, 0));
    EXPECT_EQ(scene.materials[0].emission, vec3(3, 2, 1));
    EXPECT_EQ(scene.materials[1].baseColor, vec3(0.7f));
    EXPECT_EQ(scene.materials[2].baseColor, vec3(1, 0, 0.5f));
    EXPECT_EQ(scene.materialNames[2], "hot");
    EXPECT_CONTAINS(warning, "1 colours outside [0,1] (Ka, Kd, Ks) or below 0 (Ke)");
}

TEST(Mtl, missingFileAndUnusedKeysAreToldAndBecomeGrey)
{
    SceneFolder files;
    files.write("m.mtl", "newmtl a\nKd 1 1 1\nNs 10\nmap_Ks ../../../../etc/passwd\n");
    files.write("a.obj", "mtllib m.mtl none.mtl\n" + TRIANGLE + "usemtl b\nf 1 2 3\n");
    Scene scene;
    const std::string warning = warningsOf([&] { scene = files.load("a.obj"); });
    EXPECT_EQ(scene.materials.at(0).baseColor, vec3(0.7f));
    EXPECT_CONTAINS(warning, "a.obj:1: material file \"none.mtl\" is missing");
    EXPECT_CONTAINS(warning, "norm are used; left out: map_Ks");
}

TEST(Mtl, ambientSpecularAndExponentAreForPhong)
{
    SceneFolder files;
    files.write("m.mtl", "newmtl a\nKa 0.5 0.25 0\nKd 1 1 0.5\nKs 0.75 1 0\nNs 96\n"
                         "newmtl b\nKd 0 0.5 1\nnewmtl c\nKs 0 3 0\nNs 2e6\n");
    files.write("a.obj", "mtllib m.mtl\n" + TRIANGLE +
                             "usemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\nusemtl c\nf 1 2 3\n");
    Scene scene;
    const std::string warning = warningsOf([&] { scene = files.load("a.obj"); });
    EXPECT_EQ(scene.materials.at(0).ambientColor, vec3(0.5f, 0.25f, 0));
    EXPECT_EQ(scene.materials[0].specularColor, vec3(0.75f, 1, 0));
    EXPECT_EQ(scene.materials[0].shininess, 96.0f);
    EXPECT_EQ(scene.materials.at(1).ambientColor, vec3(0, 0.5f, 1));  // its Kd
    EXPECT_EQ(scene.materials[1].specularColor, vec3(0));
    EXPECT_EQ(scene.materials[1].shininess, 50.0f);
    EXPECT_EQ(scene.materials.at(2).specularColor, vec3(0, 1, 0));
    EXPECT_EQ(scene.materials[2].shininess, 1e6f);
    EXPECT_CONTAINS(warning, "2 colours outside [0,1] (Ka, Kd, Ks)");
    files.write("m.mtl", "newmtl a\nKd 1 1 1\nNs many\n");
    EXPECT_CONTAINS(errorOfFile(files, "a.obj"), "m.mtl:3: ");
}

TEST(Mtl, fileNamesMayHaveBlanks)
{
    SceneFolder files;
    files.write("my file.mtl", "newmtl a b\nKd 0 1 0\n");
    files.write("a.obj", "mtllib my file.mtl\n" + TRIANGLE + "usemtl a b\nf 1 2 3\n");
    EXPECT_EQ(files.load("a.obj").materials.at(0).baseColor, vec3(0, 1, 0));
}

TEST(Mtl, colorsThatAreNoNumbersAreErrors)
{
    SceneFolder files;
    files.write("a.obj", "mtllib m.mtl\n" + TRIANGLE + "f 1 2 3\n");
    for (const char* color : {"Kd 1 nan 1", "Kd 1 1", "Ke x y z", "Kd 1 1 1e99"}) {
        files.write("m.mtl", "newmtl a\n" + std::string(color) + "\n");
        EXPECT_CONTAINS(errorOfFile(files, "a.obj"), "m.mtl:2: ");
    }
    files.write("m.mtl", "newmtl a\nKd 0e999 1 1\n");
    EXPECT_CONTAINS(errorOfFile(files, "a.obj"), "m.mtl: tinyobjloader misreads a colour of \"a\"");
    files.write("a.obj", "mtllib ../../etc/m.mtl\n" + TRIANGLE + "f 1 2 3\n");
    EXPECT_CONTAINS(errorOfFile(files, "a.obj"),
                    "a.obj:1: \"../../etc/m.mtl\" lies outside the scene's folder");
}

}  // namespace
}  // namespace sahl
