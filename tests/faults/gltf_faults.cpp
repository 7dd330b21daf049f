// Damaged and hostile glTF files: each gives a sound scene or a badInput error, never a crash, a
// hang or memory that nothing announced.
#include "support/gltf_files.h"
#include "support/scene_files.h"
#include "support/soups.h"

#include <algorithm>
#include <cmath>

namespace sahl {
namespace {

using namespace sahl::testing;

void expectSound(const Scene& scene)
{
    auto check = [&](const std::vector<Primitive>& primitives) {
        for (const Primitive& t : primitives) {
            ASSERT_LT(t.material, scene.materials.size());
            ASSERT_TRUE(t.shape == SHAPE_FLAT || t.shape < scene.triangleCorners.size());
            for (const vec3& p : {t.p0, t.p1, t.p2})
                ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
        }
    };
    check(scene.primitives);
    for (const auto& object : scene.objects) check(object);
    for (const Placement& placement : scene.instances) {
        ASSERT_LT(placement.object, scene.objects.size());
        ASSERT_TRUE(isPlaceable(placement));
    }
    for (const Light& light : scene.lights)
        ASSERT_TRUE(std::isfinite(light.intensity.x) && std::isfinite(light.position.x));
}

/// The error of a file, "" for a sound scene. Anything else fails the test.
std::string loads(const fs::path& path)
{
    SceneOptions options;
    options.width = options.height = 8;
    std::string error;
    warningsOf([&] { error = badInputOf([&] { expectSound(loadScene(path, options)); }); });
    return error;
}

/// Everything that is read: two nodes, a camera, a light, a material, normals, sparse positions.
std::string richMembers()
{
    return R"("bufferViews": [{"buffer": 0, "byteLength": 96, "byteStride": 24}, {"buffer": 0, "byteOffset": 96, "byteLength": 12},
                              {"buffer": 0, "byteOffset": 108, "byteLength": 4}, {"buffer": 0, "byteOffset": 112, "byteLength": 24}],
              "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "sparse":
                                {"count": 2, "indices": {"bufferView": 2, "componentType": 5123}, "values": {"bufferView": 3}}},
                            {"bufferView": 0, "byteOffset": 12, "componentType": 5126, "count": 4, "type": "VEC3"},
                            {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}],
              "extensionsUsed": ["KHR_lights_punctual"],
              "extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "spot": {}}]}},
              "materials": [{"emissiveFactor": [1, 1, 0], "pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1]}}],
              "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 2, "material": 0}]}],
              "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}],
              "nodes": [{"mesh": 0, "children": [1, 2]}, {"mesh": 0, "scale": [1, 2, 3]},
                        {"camera": 0, "translation": [0, 0, 5], "extensions": {"KHR_lights_punctual": {"light": 0}}}],
              "scenes": [{"nodes": [0]}])";
}

std::string richBuffer()
{
    return bytesOf<float>(
               {0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0}) +
           bytesOf<uint16_t>({0, 1, 2, 0, 2, 3, 1, 3}) + bytesOf<float>({2, 0, 0, 0, 2, 0});
}

TEST(GltfFaults, aFileCutAnywhereIsRefused)
{
    SceneFolder files;
    const std::string whole = glbBytes(richMembers(), richBuffer());
    ASSERT_EQ(loads(files.write("model.glb", whole)), "");
    for (size_t size = 0; size < whole.size(); size += size < 40 ? 1 : 37)
        ASSERT_NE(loads(files.write("model.glb", whole.substr(0, size))), "") << size;
    // The header says how long the file is; with that corrected, the parts still say how long they
    // are.
    for (size_t size = 12; size < whole.size(); size += 41) {
        const std::string cut = glbHeader(size) + whole.substr(12, size - 12);
        ASSERT_NE(loads(files.write("model.glb", cut)), "") << size;
    }
}

TEST(GltfFaults, aFileWithAnyByteChangedIsSoundOrRefused)
{
    SceneFolder files;
    const std::string whole = glbBytes(richMembers(), richBuffer());
    size_t refused = 0, tried = 0;
    Random random(17);
    for (size_t at = 0; at < whole.size(); at++) {
        std::string damaged = whole;
        damaged[at] = static_cast<char>(damaged[at] ^ (1 << (random.below(8))));
        refused += loads(files.write("model.glb", damaged)) != "";
        tried++;
    }
    EXPECT_GT(refused, tried / 4);
    EXPECT_LT(refused, tried);
}

/// The square's file with one text in it replaced.
std::string errorOfChanged(const std::string& from, const std::string& to)
{
    std::string file = squareFile(R"("nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}])");
    const size_t at = file.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return errorOfText("model.gltf", file.replace(at, from.size(), to));
}

TEST(GltfFaults, everyReferenceSizeAndKindIsChecked)
{
    const std::vector<std::array<std::string, 3>> cases = {
        {R"("version": "2.0")", R"("version": "1.0")", "glTF 1.0 is not read; only 2.0"},
        {R"("version": "2.0")", R"("version": "2.0", "minVersion": "2.1")",
         "needs a reader of glTF 2.1"},
        {R"("byteLength": 60)", R"("byteLength": 61)",
         "buffer 0 should have 61 bytes; there are 60"},
        {R"("byteLength": 60)", R"("byteLength": -1)", "\"byteLength\" of buffer 0 is -1"},
        {R"("byteLength": 12)", R"("byteLength": 13)",
         "buffer view 1 ends at byte 61 of buffer 0, which has 60"},
        {R"("byteLength": 12)", R"("byteLength": 10)",
         "accessor 1 ends at byte 12 of buffer view 1, which has 10"},
        {R"("byteOffset": 48)", R"("byteOffset": 4294967295)",
         "buffer view 1 ends at byte 4294967307"},
        {R"("buffer": 0)", R"("buffer": 1)",
         "\"buffer\" of buffer view 0 is 1; the file has 1 buffers"},
        {R"("byteLength": 48)", R"("byteLength": 48, "byteStride": 8)",
         "elements of 12 bytes, and the stride"},
        {R"("byteLength": 48)", R"("byteLength": 48, "byteStride": 16)",
         "accessor 0 ends at byte 60 of buffer view 0"},
        {R"("byteLength": 48)", R"("byteLength": 48, "byteStride": 14)",
         "is 14, which is no multiple of 4"},
        {R"("bufferView": 0)", R"("bufferView": 2)", "the file has 2 buffer views"},
        {R"("bufferView": 0)", R"("bufferView": 0, "byteOffset": 2)", "must be multiples of 4"},
        {R"("bufferView": 0, )", R"("byteOffset": 4, )",
         "has \"byteOffset\" and no \"bufferView\""},
        {R"("componentType": 5126)", R"("componentType": 5124)",
         "is 5124; known: 5120 to 5123, 5125, 5126"},
        {R"("componentType": 5126)", R"("componentType": 5125)",
         "POSITION of primitive 0 of mesh 0 is accessor 0"},
        {R"("type": "VEC3")", R"("type": "VEC2")",
         "POSITION of primitive 0 of mesh 0 is accessor 0, VEC2"},
        {R"("type": "VEC3")", R"("type": "VEC5")", "did you mean \"VEC2\"?"},
        {R"("count": 4)", R"("count": 3)",
         "index 5 of primitive 0 of mesh 0, accessor 1, is 3; there are 3 vertices"},
        {R"("count": 4)", R"("count": 4294967295)", "accessor 0 ends at byte 51539607540"},
        {R"("count": 4)", R"("count": 0)", "it must lie in [1, 4294967295]"},
        {R"("count": 4)", R"("count": 1e400)", "number overflow"},
        {R"("count": 4)", R"("count": "4")", "must be a number, found a text"},
        {R"("bufferView": 0, "componentType": 5126, "count": 4)",
         R"("componentType": 5126, "count": 4294967295)", "at most 1048576 can be without"},
        {R"("POSITION": 0)", R"("POSITION": 2)", "the file has 2 accessors"},
        {R"("POSITION": 0)", R"("POSITION": 0, "NORMAL": 1)",
         "NORMAL of primitive 0 of mesh 0 is accessor 1, SCALAR"},
        {R"("POSITION": 0)", R"("POSITION": 0, "_X": 1)",
         "have 4 and 6 values; they must have as many"},
        {R"("indices": 1)", R"("indices": 0)", "must be a SCALAR of whole numbers without sign"},
        {R"("indices": 1)", R"("indices": 1, "mode": 7)", "it must lie in [0, 6]"},
        {R"("indices": 1)", R"("indices": 1, "material": 0)", "the file has 0 materials"},
        {R"("mesh": 0)", R"("mesh": 1)", "\"mesh\" of node 0 is 1; the file has 1 meshes"},
        {R"("mesh": 0)", R"("mesh": 0, "camera": 0)", "the file has 0 cameras"},
        {R"("mesh": 0)", R"("mesh": 0, "skin": 0)", "the file has 0 skins"},
        {R"("mesh": 0)", R"("mesh": 0, "extensions": {"KHR_lights_punctual": {"light": 0}})",
         "has 0 lights"},
        {R"("mesh": 0)", R"("mesh": 0, "children": [0])", "node 0 is below itself"},
        {R"("mesh": 0)", R"("mesh": 0, "children": [1])",
         "a child of node 0 is 1; the file has 1 nodes"},
        {R"([{"mesh": 0}])", R"([{"children": [1, 1]}, {"mesh": 0}])",
         "node 1 is a child of node 0 and of node 0"},
        {R"([{"mesh": 0}])", R"([{"children": [2]}, {"children": [2]}, {}])",
         "is a child of node 0 and of node 1"},
        {R"([{"mesh": 0}])", R"([{}, {"children": [2]}, {"children": [1]}])",
         "node 1 is below itself"},
        {R"([{"mesh": 0}])", R"([{}, {"children": [0]}])",
         "node 0 of scene 0 is below node 1; it must be a root"},
        {R"("nodes": [0])", R"("nodes": [0, 0])", "scene 0 has node 0 twice"},
        {R"("nodes": [0])", R"("nodes": [1])", "a node of scene 0 is 1; the file has 1 nodes"},
        {R"("mesh": 0)", R"("mesh": 0, "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,1, 0,0,0,1])",
         "last row of \"matrix\" of node 0"},
        {R"("mesh": 0)",
         R"("mesh": 0, "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1], "scale": [1,1,1])",
         "has both"},
        {R"("mesh": 0)", R"("mesh": 0, "rotation": [0, 0, 0, 0])",
         "must be a unit quaternion; its length is 0"},
        {R"("mesh": 0)", R"("mesh": 0, "translation": [0, 1e39, 0])", "it must lie in"},
        {R"("mesh": 0)", R"("mesh": 0, "scale": [1, 1])", "needs 3 numbers, found 2"},
    };
    for (const auto& [from, to, expected] : cases)
        EXPECT_CONTAINS(errorOfChanged(from, to), expected);
    // Floats that are not finite, in buffers.
    const std::string file = gltfText(squareMembers(R"("nodes": [{"mesh": 0}])"),
                                      bytesOf<float>({0, 0, 0, NAN, 0, 0, 1, 1, 0, 0, 1, 0}) +
                                          bytesOf<uint16_t>({0, 1, 2, 0, 2, 3}));
    EXPECT_CONTAINS(errorOfText("model.gltf", file),
                    "vertex 1 of primitive 0 of mesh 0, accessor 0, is (nan, 0, 0)");
}

TEST(GltfFaults, sparseIndicesMustRiseAndLieWithin)
{
    auto errorOf = [](const std::vector<uint16_t>& indices) {
        std::string buffer = richBuffer();
        std::copy_n(bytesOf(indices).begin(), 4, buffer.begin() + 108);
        return errorOfText("model.gltf", gltfText(richMembers(), buffer));
    };
    EXPECT_EQ(errorOf({1, 3}), "");
    EXPECT_CONTAINS(errorOf({1, 4}),
                    "index 1 of accessor 0: sparse: indices is 4; they must rise, and there are 4");
    EXPECT_CONTAINS(errorOf({3, 1}), "index 1 of accessor 0: sparse: indices is 1; they must rise");
    EXPECT_CONTAINS(errorOf({2, 2}), "they must rise");
}

TEST(GltfFaults, moreTrianglesThanAnythingHoldsAreRefusedBeforeTheyAreMade)
{
    // 40,000 primitives share one list of 30,000 indices: 400 million triangles in 4 MB.
    const std::string primitive = R"({"attributes": {"POSITION": 0}, "indices": 1})";
    std::string primitives = primitive;
    for (int i = 1; i < 40000; i++) primitives += "," + primitive;
    const std::string file = gltfText(
        R"("bufferViews": [{"buffer": 0, "byteLength": 12}, {"buffer": 0, "byteOffset": 12, "byteLength": 30000}],
           "accessors": [{"bufferView": 0, "componentType": 5126, "count": 1, "type": "VEC3"},
                         {"bufferView": 1, "componentType": 5121, "count": 30000, "type": "SCALAR"}],
           "nodes": [{"mesh": 0}], "meshes": [{"primitives": [)" +
            primitives + "]}]",
        std::string(30012, '\0'));
    EXPECT_EQ(errorOfText("model.gltf", file),
              "model.gltf: 400000000 triangles; at most 268435440 can be rendered");
}

TEST(GltfFaults, deepOrEndlessTextIsRefused)
{
    EXPECT_CONTAINS(errorOfText("model.gltf", R"({"asset": )" + std::string(100000, '[')),
                    "nested deeper");
    EXPECT_CONTAINS(errorOfText("model.gltf", R"({"asset": [0)" + std::string(5000000, ',')),
                    "values in the JSON");
    EXPECT_CONTAINS(errorOfText("model.gltf", ""), "model.gltf:1:1");
    EXPECT_CONTAINS(errorOfText("model.gltf", "[]"), "the file must be an object");
    EXPECT_CONTAINS(errorOfText("model.gltf", R"({"asset": {"version": "2.0", "version": "2.0"}})"),
                    "duplicate key");
}

}  // namespace
}  // namespace sahl
