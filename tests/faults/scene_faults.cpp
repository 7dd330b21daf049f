// Hostile scene and OBJ files: each gives a scene or a badInput error, never a crash or a hang.
#include "support/assets.h"
#include "support/scene_files.h"
#include "support/soups.h"

#include <chrono>
#include <cmath>

namespace sahl {
namespace {

using namespace sahl::testing;

/// Checks what every later stage relies on.
void expectSound(const Scene& scene)
{
    for (size_t i = 0; i < scene.primitives.size(); i++) {
        const Primitive& t = scene.primitives[i];
        ASSERT_EQ(t.number, i);
        ASSERT_LT(t.material, scene.materials.size());
        ASSERT_TRUE(t.shape == SHAPE_FLAT || t.shape < scene.triangleCorners.size());
        for (const vec3& p : {t.p0, t.p1, t.p2}) {
            ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
        }
    }
    for (const TriangleCorners& n : scene.triangleCorners) {
        for (const vec3& normal : {n.n0, n.n1, n.n2}) ASSERT_NEAR(glm::length(normal), 1, 1e-5);
    }
    for (const Material& m : scene.materials) {
        for (int k = 0; k < 3; k++) {
            ASSERT_TRUE(m.baseColor[k] >= 0 && m.baseColor[k] <= 1);
            ASSERT_TRUE(m.emission[k] >= 0 && std::isfinite(m.emission[k]));
        }
    }
    ASSERT_EQ(scene.probeTexels.size(), size_t{scene.probe.width} * scene.probe.height);
}

/// Loads quietly; true for a scene, false for badInput; anything else fails the test.
bool loads(const fs::path& path)
{
    SceneOptions options;
    options.width = 8;
    options.height = 8;
    bool loaded = false;
    warningsOf([&] {
        badInputOf([&] {
            expectSound(loadScene(path, options));
            loaded = true;
        });
    });
    return loaded;
}

TEST(SceneFaults, thingsThatAreNoFilesAreRefusedAtOnce)
{
    SceneFolder files;
    fs::create_directory(files.folder.path / "folder.json");
    fs::create_symlink("/dev/zero", files.folder.path / "zero.json");
    fs::create_symlink("/dev/zero", files.folder.path / "zero.obj");
    fs::create_symlink("loop.json", files.folder.path / "loop.json");
    EXPECT_CONTAINS(errorOfFile(files, "missing.json"), "missing.json: cannot read");
    EXPECT_CONTAINS(errorOfFile(files, "missing.obj"), "missing.obj: cannot read");
    EXPECT_CONTAINS(errorOfFile(files, "folder.json"), "is a directory");
    EXPECT_CONTAINS(errorOfFile(files, "zero.json"), "not a regular file");
    EXPECT_CONTAINS(errorOfFile(files, "zero.obj"), "not a regular file");
    EXPECT_CONTAINS(errorOfFile(files, "loop.json"), "loop.json: cannot read");
    EXPECT_CONTAINS(badInputOf([] { loadScene("/dev/zero", {}); }), "not a regular file");
    EXPECT_CONTAINS(errorOfText("empty.obj", ""), "no faces");
    EXPECT_CONTAINS(errorOfText("empty.json", ""), "empty.json:1:1: ");
    EXPECT_CONTAINS(errorOfText("mesh.stl", "solid"), "\".stl\" files are not read");
}

TEST(SceneFaults, namedFilesThatAreNoFilesAreRefused)
{
    SceneFolder files;
    fs::create_symlink("b.obj", files.folder.path / "a.obj");
    fs::create_symlink("a.obj", files.folder.path / "b.obj");
    for (const char* name :
         {"", "a.obj", "missing.obj", ".", "..", "/etc/passwd", "~/x.obj", "$HOME/x.obj",
          "`id`.obj", "http://example.com/x.obj", "\\\\\\\\host\\\\share\\\\x.obj",
          "../../../../etc/passwd", "x\\u0000.obj", "/dev/zero"}) {
        files.write("s.json",
                    fmt::format(R"({{ "shapes": [{{ "type": "mesh", "file": "{}" }}] }})", name));
        EXPECT_FALSE(loads(files.folder.path / "s.json")) << name;
        files.write("p.json", fmt::format(R"({{ "environment": {{ "file": "{}" }} }})", name));
        EXPECT_FALSE(loads(files.folder.path / "p.json")) << name;
    }
}

TEST(SceneFaults, materialFileThatIsTheMeshItselfOrALoopEnds)
{
    SceneFolder files;
    fs::create_symlink("b.mtl", files.folder.path / "a.mtl");
    fs::create_symlink("a.mtl", files.folder.path / "b.mtl");
    files.write("a.obj", "mtllib a.obj\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl x\nf 1 2 3\n");
    EXPECT_TRUE(loads(files.folder.path / "a.obj"));
    files.write("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    loads(files.folder.path / "a.obj");
}

TEST(SceneFaults, deepNestingIsRefusedWithItsPlace)
{
    EXPECT_CONTAINS(errorOfJson(std::string(1000000, '[')),
                    "scene.json:1:65: nested deeper than 64 levels");
    std::string objects;
    for (int i = 0; i < 100000; i++) objects += "{\"a\":";
    EXPECT_CONTAINS(errorOfJson(objects), "nested deeper than 64 levels");
}

TEST(SceneFaults, hugeFilesAreRefusedBeforeTheyAreRead)
{
    SceneFolder files;
    files.write("big.json", "{");
    fs::resize_file(files.folder.path / "big.json", uint64_t{200} << 20);
    EXPECT_CONTAINS(errorOfFile(files, "big.json"),
                    "has 209715200 bytes; at most 16777216 are read");
}

TEST(SceneFaults, aFaceOfAMillionCornersIsCutInTime)
{
    std::string text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf";
    for (int i = 0; i < 250000; i++) text += " 1 2 3 4";
    SceneFolder files;
    EXPECT_TRUE(loads(files.write("a.obj", text)));
}

TEST(SceneFaults, aLineOfManyMegabytesIsHandled)
{
    SceneFolder files;
    EXPECT_TRUE(loads(files.write("a.obj", "# " + std::string(20000000, 'x') +
                                               "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3")));
    EXPECT_FALSE(loads(files.write("a.obj", "v " + std::string(5000000, '1') + " 0 0\n")));
    EXPECT_FALSE(loads(files.write("a.obj", "v 0 0 0\n" + std::string(5000000, 'f'))));
}

TEST(SceneFaults, binaryDataAndUtf16AreNamedAsSuch)
{
    EXPECT_CONTAINS(errorOfObj(std::string("v 0 0 0\nv\0 1", 12)), "mesh.obj:2: a zero byte");
    SAHL_REQUIRE_ASSET("bad/obj-assimp/box_UTF16BE.obj");
    EXPECT_CONTAINS(
        badInputOf([] { loadScene(assetFolder() / "bad/obj-assimp/box_UTF16BE.obj", {}); }),
        "UTF-16");
}

TEST(SceneFaults, extremeCoordinatesLoadWithAWarning)
{
    SceneFolder files;
    for (const char* scale : {"1e30", "1e-6", "1e6", "3e38", "1e-20"}) {
        const std::string text = fmt::format("v 0 0 0\nv {0} 0 0\nv 0 {0} 0\nf 1 2 3\n", scale);
        loads(files.write("a.obj", text));
    }
    const std::string warning = warningsOf([&] {
        badInputOf([&] { loadText("a.obj", "v 0 0 0\nv 1e15 0 0\nv 0 1e15 0\nf 1 2 3\n"); });
    });
    EXPECT_CONTAINS(warning, "coordinates reach 1e+15 m");
}

TEST(SceneFaults, everyOddFileOfOtherProjectsLoadsOrIsRefused)
{
    int loaded = 0, refused = 0;
    for (const char* folder : {"bad/obj-assimp", "bad/obj-tinyobjloader", "bad/invalid-assimp"}) {
        SAHL_REQUIRE_ASSET(folder);
        for (const auto& entry : fs::directory_iterator(assetFolder() / folder)) {
            if (entry.path().extension() != ".obj") continue;
            SCOPED_TRACE(entry.path().string());
            (loads(entry.path()) ? loaded : refused)++;
        }
    }
    EXPECT_GE(loaded, 30);
    EXPECT_GE(refused, 8);
}

const char* const SMALL_OBJ = "mtllib m.mtl\no thing\nv 0.5 -1e2 0\nv 1 0 0\nv 0 1 0\nv 1 1 -1\nvn "
                              "0 0 1\nvn 0 1 0\nvt 0 0\nvt 0.5 1\n"
                              "g a\nusemtl red\nf 1/1/1 2/2/2 3/1/1\nf -1 -2 -3 -4\ns off\nusemtl "
                              "blue\nf 1//1 2//2 4//1\nl 1 2\n";

const char* const SMALL_JSON = R"({ "film": { "width": 8, "height": 8 },
  "camera": { "eye": [0, 1, 5], "lookAt": [0, 0, 0], "fovDeg": 40, "fovAxis": "vertical" },
  "materials": { "a": { "type": "lambert", "baseColor": [0.5, 0.25, 1], "emission": [0, 1e1, 0] } },
  "shapes": [{ "type": "triangles", "positions": [[0,0,0],[1,0,0],[0,1,0]], "indices": [[0,1,2]],
    "material": "a", "transform": { "scale": -2, "rotateDeg": { "axis": [1, 0, 0], "angle": 30 } } },
    { "type": "mesh", "file": "m.obj" }, { "type": "sphereMesh", "level": 1 }],
  "lights": [{ "type": "point", "position": [0, 4, 0], "intensity": [1, 1, 1] }],
  "environment": { "radiance": [0.1, 0.2, 0.3] } })";

/// Cuts the text short or changes a few of its bytes.
std::string damaged(std::string text, Random& random)
{
    if (random.below(4) == 0) return text.substr(0, random.below(static_cast<uint>(text.size())));
    static const std::string likely = "0123456789.-+eE/ \n\t\"{}[],:#\\vnft\0\xff";
    for (uint i = 0, count = 1 + random.below(4); i < count; i++) {
        char& c = text[random.below(static_cast<uint>(text.size()))];
        if (random.below(3) == 0)
            c = static_cast<char>(c ^ (1 << random.below(8)));
        else
            c = likely[random.below(static_cast<uint>(likely.size()))];
    }
    return text;
}

TEST(SceneFaults, damagedObjAndMtlFilesLoadOrAreRefused)
{
    const std::string mtl =
        "newmtl red\nKd 1 0 0\nKe 1 2 3\nmap_Kd x.png\n\nnewmtl blue\nKd 0 0 1\nNs 5\n";
    SceneFolder files;
    Random random(1);
    int loaded = 0;
    for (int i = 0; i < 1500; i++) {
        const std::string obj = damaged(SMALL_OBJ, random);
        files.write("m.mtl", damaged(mtl, random));
        SCOPED_TRACE(obj);
        if (loads(files.write("m.obj", obj))) loaded++;
    }
    EXPECT_GT(loaded, 100);
}

TEST(SceneFaults, damagedScenesLoadOrAreRefused)
{
    SceneFolder files;
    files.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    Random random(2);
    int loaded = 0;
    for (int i = 0; i < 1500; i++) {
        const std::string json = damaged(SMALL_JSON, random);
        SCOPED_TRACE(json);
        if (loads(files.write("s.json", json))) loaded++;
    }
    EXPECT_GT(loaded, 10);  // most damage breaks the syntax
}

}  // namespace
}  // namespace sahl
