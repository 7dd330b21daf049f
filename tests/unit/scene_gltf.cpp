// glTF files: what of them becomes a scene.
#include "image/image.h"
#include "support/gltf_files.h"
#include "support/gzip_files.h"
#include "support/scene_files.h"

#include <cmath>

namespace sahl {
namespace {

using namespace sahl::testing;

Scene loadGltf(const std::string& text, const SceneOptions& options = {})
{
    return loadText("model.gltf", text, options);
}

std::string errorOfGltf(const std::string& text)
{
    return errorOfText("model.gltf", text);
}

const std::string ONE_NODE = R"("nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}])";

using Triangle = std::array<vec3, 3>;

std::vector<Triangle> trianglesOf(const std::vector<Primitive>& primitives)
{
    std::vector<Triangle> triangles;
    for (const Primitive& p : primitives) triangles.push_back({p.p0, p.p1, p.p2});
    return triangles;
}

const std::vector<Triangle> SQUARE = {{vec3(0, 0, 0), vec3(1, 0, 0), vec3(1, 1, 0)},
                                      {vec3(0, 0, 0), vec3(1, 1, 0), vec3(0, 1, 0)}};

/// The mesh's triangles as seen from the nodes of a file with the square.
std::vector<Triangle> squareAt(const std::string& nodesAndScenes)
{
    return trianglesOf(loadGltf(squareFile(nodesAndScenes)).primitives);
}

void expectNear(const vec3& a, const vec3& b)
{
    for (int k = 0; k < 3; k++) EXPECT_NEAR(a[k], b[k], 1e-6) << k;
}

/// A scene of one primitive with five vertices on the parabola y = x^2.
std::vector<Triangle> modeTriangles(const std::string& primitive, const std::string& indices = "")
{
    const std::string vertices = bytesOf<float>({0, 0, 0, 1, 1, 0, 2, 4, 0, 3, 9, 0, 4, 16, 0});
    const std::string members =
        R"("bufferViews": [{"buffer": 0, "byteLength": 60}, {"buffer": 0, "byteOffset": 60, "byteLength": 20}],
           "accessors": [{"bufferView": 0, "componentType": 5126, "count": 5, "type": "VEC3"},
                         {"bufferView": 1, )" +
        (indices.empty() ? R"("componentType": 5121, "count": 1)" : indices) +
        R"(, "type": "SCALAR"}],
           "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, )" +
        primitive + "}]}], " + ONE_NODE;
    return trianglesOf(loadGltf(gltfText(members, vertices + std::string(20, '\1'))).primitives);
}

std::vector<std::array<float, 3>> xOf(const std::vector<Triangle>& triangles)
{
    std::vector<std::array<float, 3>> x;
    for (const Triangle& t : triangles) x.push_back({t[0].x, t[1].x, t[2].x});
    return x;
}

using X = std::vector<std::array<float, 3>>;

TEST(Gltf, aFileWithoutCameraLightOrMaterialIsFramedLitByTheStudioAndWhite)
{
    const Scene scene = loadGltf(squareFile(ONE_NODE));
    EXPECT_EQ(trianglesOf(scene.primitives), SQUARE);
    ASSERT_EQ(scene.materials.size(), 1u);
    EXPECT_EQ(scene.materials[0].baseColor, vec3(1));
    EXPECT_GT(scene.probe.height, 0u);
    EXPECT_TRUE(scene.cameraDescription->framed.has_value());
}

TEST(Gltf, theBinaryFormIsTheSameScenePackedOrNot)
{
    const std::string bytes = glbBytes(squareMembers(ONE_NODE), squareBuffer());
    EXPECT_EQ(trianglesOf(loadText("model.glb", bytes).primitives), SQUARE);
    EXPECT_EQ(trianglesOf(loadText("model.glb.gz", packed(bytes)).primitives), SQUARE);
    EXPECT_EQ(trianglesOf(loadText("misnamed.gltf", bytes).primitives), SQUARE);
}

TEST(Gltf, stripsAndFansTurnLikeTheirFirstTriangle)
{
    EXPECT_EQ(xOf(modeTriangles(R"("mode": 4)")), (X{{0, 1, 2}}));
    EXPECT_EQ(xOf(modeTriangles(R"("mode": 5)")), (X{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
    EXPECT_EQ(xOf(modeTriangles(R"("mode": 6)")), (X{{1, 2, 0}, {2, 3, 0}, {3, 4, 0}}));
}

TEST(Gltf, indicesHaveOneTwoOrFourBytes)
{
    for (const auto& [type, bytes] :
         {std::pair<std::string, std::string>("5121", bytesOf<uint8_t>({0, 2, 3, 1, 2, 3, 0, 0})),
          {"5123", bytesOf<uint16_t>({0, 2, 3, 1, 2, 3})},
          {"5125", bytesOf<uint32_t>({0, 2, 3, 1, 2, 3})}}) {
        const std::string members =
            R"("bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": )" +
            std::to_string(bytes.size()) + R"(}],
               "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                             {"bufferView": 1, "componentType": )" +
            type + R"(, "count": 6, "type": "SCALAR"}],
               "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}], )" +
            ONE_NODE;
        const Scene scene = loadGltf(
            gltfText(members, bytesOf<float>({0, 0, 0, 1, 0, 0, 2, 1, 0, 3, 3, 0}) + bytes));
        EXPECT_EQ(xOf(trianglesOf(scene.primitives)), (X{{0, 2, 3}, {1, 2, 3}})) << type;
    }
}

TEST(Gltf, pointsLinesAndPrimitivesWithoutPositionsAreLeftOutWithAMessage)
{
    const std::string file =
        gltfText(squareViews() +
                     R"(, "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 0},
                                            {"attributes": {"POSITION": 0}, "mode": 3},
                                            {"attributes": {}},
                                            {"attributes": {"POSITION": 0}, "indices": 1}]}], )" +
                     ONE_NODE,
                 squareBuffer());
    const std::string warnings =
        warningsOf([&] { EXPECT_EQ(trianglesOf(loadGltf(file).primitives), SQUARE); });
    EXPECT_CONTAINS(warnings, "points and lines are left out (2 times)");
    EXPECT_CONTAINS(warnings, "a primitive without positions is left out\n");
    const std::string onlyPoints = gltfText(
        squareViews() +
            R"(, "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 0}]}], )" +
            ONE_NODE,
        squareBuffer());
    EXPECT_EQ(errorOfGltf(onlyPoints), "model.gltf: the scene of this file has no triangles");
}

TEST(Gltf, nodesAreScaledTurnedAndMovedBelowTheirParents)
{
    // A quarter turn about +z, twice as large along x, moved; below a node that is moved and
    // doubled.
    const auto parts = squareAt(R"("nodes": [
        {"children": [1], "translation": [10, 0, 0], "scale": [2, 2, 2]},
        {"mesh": 0, "translation": [0, 0, 1], "scale": [2, 1, 1],
         "rotation": [0, 0, 0.70710678118654752, 0.70710678118654752]}], "scenes": [{"nodes": [0]}])");
    ASSERT_EQ(parts.size(), 2u);
    expectNear(parts[0][0], {10, 0, 2});
    expectNear(parts[0][1], {10, 4, 2});
    expectNear(parts[0][2], {8, 4, 2});
    // The same as a matrix, column by column.
    const auto matrix = squareAt(R"("nodes": [
        {"children": [1], "matrix": [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 10, 0, 0, 1]},
        {"mesh": 0, "matrix": [0, 2, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 1]}], "scenes": [{"nodes": [0]}])");
    for (size_t k = 0; k < 3; k++) expectNear(matrix[1][k], parts[1][k]);
}

TEST(Gltf, mirroringKeepsTheFrontsOfTrianglesInFront)
{
    const auto mirrored =
        squareAt(R"("nodes": [{"mesh": 0, "scale": [-1, 1, 1]}], "scenes": [{"nodes": [0]}])");
    for (const Triangle& t : mirrored) EXPECT_GT(glm::cross(t[1] - t[0], t[2] - t[0]).z, 0);
}

TEST(Gltf, theDefaultSceneIsShownOrElseTheFirstOrElseAllRoots)
{
    const std::string nodes =
        R"("nodes": [{"mesh": 0}, {"mesh": 0, "translation": [5, 0, 0]}, {"mesh": 0, "translation": [9, 0, 0]}])";
    auto firstX = [&](const std::string& scenes) { return squareAt(nodes + scenes).at(0)[0].x; };
    EXPECT_EQ(firstX(R"(, "scenes": [{"nodes": [1]}, {"nodes": [2]}])"), 5);
    EXPECT_EQ(firstX(R"(, "scene": 1, "scenes": [{"nodes": [1]}, {"nodes": [2]}])"), 9);
    EXPECT_EQ(loadGltf(squareFile(nodes)).instances.size(), 3u);
}

TEST(Gltf, aMeshOfSeveralNodesIsStoredOnce)
{
    const Scene scene = loadGltf(squareFile(R"("nodes": [
        {"mesh": 0, "translation": [1, 0, 0]}, {"mesh": 0, "scale": [1, 1, -3]}, {"mesh": 0, "scale": [0, 1, 1]}],
        "scenes": [{"nodes": [0, 1, 2]}])"));
    EXPECT_TRUE(scene.primitives.empty());
    ASSERT_EQ(scene.objects.size(), 1u);
    EXPECT_EQ(trianglesOf(scene.objects[0]), SQUARE);
    ASSERT_EQ(scene.instances.size(), 2u);  // and one that is flat, which is left out
    EXPECT_EQ(scene.instances[0].translation, glm::dvec3(1, 0, 0));
    EXPECT_EQ(scene.instances[1].linear[2], glm::dvec3(0, 0, -3));
}

TEST(Gltf, aNodeThatFlattensSpaceIsLeftOutWithAMessage)
{
    const std::string warnings = warningsOf([&] {
        const auto shown = squareAt(
            R"("nodes": [{"mesh": 0}, {"mesh": 0, "scale": [1, 0, 1]}], "scenes": [{"nodes": [0, 1]}])");
        EXPECT_EQ(shown, SQUARE);
    });
    EXPECT_CONTAINS(warnings, "model.gltf: a mesh at a node that flattens space is left out");
}

TEST(Gltf, aChainOfAHundredThousandNodesIsFollowed)
{
    std::string nodes = R"("nodes": [)";
    for (int i = 1; i < 100000; i++)
        nodes += fmt::format(R"({{"translation": [1, 0, 0], "children": [{}]}}, )", i);
    nodes += R"({"mesh": 0}], "scenes": [{"nodes": [0]}])";
    EXPECT_EQ(squareAt(nodes)[0][0], vec3(99999, 0, 0));
}

TEST(Gltf, cameraOfANodeLooksAlongMinusZAndScaleDoesNotMatter)
{
    const std::string camera =
        R"("cameras": [{"type": "perspective", "perspective": {"yfov": 0.9272952180016122, "znear": 0.1, "aspectRatio": 2}}],
           "nodes": [{"mesh": 0}, {"camera": 0, "translation": [1, 2, 3], "scale": [2, 3, 4],
                      "rotation": [0, 0.70710678118654752, 0, 0.70710678118654752]}], "scenes": [{"nodes": [0, 1]}])";
    const Scene scene = loadGltf(squareFile(camera));
    EXPECT_EQ(scene.settings.width, 512u);
    EXPECT_EQ(scene.settings.height, 256u);
    EXPECT_EQ(scene.camera.position, vec3(1, 2, 3));
    expectNear(scene.camera.forward, {-1, 0, 0});
    expectNear(scene.camera.down, {0, -0.5f, 0});  // tan(yfov / 2) = 1/2
    expectNear(scene.camera.right, {0, 0, -1});

    SceneOptions square;
    square.width = square.height = 100;
    expectNear(loadGltf(squareFile(camera), square).camera.right, {0, 0, -0.5f});
    SceneOptions wide;
    wide.width = 100;
    EXPECT_EQ(loadGltf(squareFile(camera), wide).settings.height, 50u);
}

TEST(Gltf, orthographicCameraOfANodeThatMirrorsSeesAMirrorImage)
{
    const Scene scene = loadGltf(squareFile(
        R"("cameras": [{"type": "orthographic", "orthographic": {"xmag": 3, "ymag": 4, "znear": 0, "zfar": 10}}],
           "nodes": [{"mesh": 0}, {"camera": 0, "scale": [-1, 1, 1]}], "scenes": [{"nodes": [0, 1]}])"));
    EXPECT_EQ(scene.camera.type, CAMERA_ORTHOGRAPHIC);
    EXPECT_EQ(scene.settings.width, 384u);
    EXPECT_EQ(scene.settings.height, 512u);
    expectNear(scene.camera.forward, {0, 0, -1});
    expectNear(scene.camera.right, {-3, 0, 0});
    expectNear(scene.camera.down, {0, -4, 0});
}

TEST(Gltf, lightsShineAlongMinusZWhereTheirNodesAre)
{
    const Scene scene = loadGltf(squareFile(
        R"("extensionsUsed": ["KHR_lights_punctual"], "extensionsRequired": ["KHR_lights_punctual"],
           "extensions": {"KHR_lights_punctual": {"lights": [
               {"type": "point", "color": [1, 0.5, 0], "intensity": 8},
               {"type": "spot", "spot": {"innerConeAngle": 0.5235987755982988, "outerConeAngle": 1.0471975511965976}},
               {"type": "directional", "intensity": 3}]}},
           "nodes": [{"mesh": 0},
               {"translation": [0, 4, 0], "scale": [5, 5, 5], "extensions": {"KHR_lights_punctual": {"light": 0}}},
               {"rotation": [-0.70710678118654752, 0, 0, 0.70710678118654752], "translation": [0, 0, 2],
                "extensions": {"KHR_lights_punctual": {"light": 1}}},
               {"extensions": {"KHR_lights_punctual": {"light": 2}}}],
           "scenes": [{"nodes": [0, 1, 2, 3]}])"));
    ASSERT_EQ(scene.lights.size(), 3u);
    EXPECT_EQ(scene.probe.height, 0u);
    EXPECT_EQ(scene.lights[0].type, LIGHT_POINT);
    EXPECT_EQ(scene.lights[0].position, vec3(0, 4, 0));
    EXPECT_EQ(scene.lights[0].intensity, vec3(8, 4, 0));
    EXPECT_EQ(scene.lights[1].type, LIGHT_SPOT);
    EXPECT_EQ(scene.lights[1].position, vec3(0, 0, 2));
    expectNear(scene.lights[1].direction, {0, -1, 0});
    EXPECT_EQ(scene.lights[1].intensity, vec3(1));
    EXPECT_NEAR(scene.lights[1].cosInner, std::sqrt(0.75f), 1e-6);
    EXPECT_NEAR(scene.lights[1].cosOuter, 0.5f, 1e-6);
    EXPECT_EQ(scene.lights[2].type, LIGHT_DIRECTIONAL);
    EXPECT_EQ(scene.lights[2].direction, vec3(0, 0, -1));
    EXPECT_EQ(scene.lights[2].intensity, vec3(3));
}

TEST(Gltf, numbersMayBeInterleavedNormalisedOrWhole)
{
    // Position as three shorts and two bytes of filling, normal as three bytes and one.
    const std::string vertices =
        bytesOf<int16_t>({0, 0, 0, 0}) + bytesOf<int8_t>({0, 127, 0, 0}) +   //
        bytesOf<int16_t>({0, 0, 3, 0}) + bytesOf<int8_t>({0, -128, 0, 0}) +  //
        bytesOf<int16_t>({-2, 0, 0, 0}) + bytesOf<int8_t>({0, 0, 127, 0});
    const std::string file = gltfText(
        R"("extensionsUsed": ["KHR_mesh_quantization"], "extensionsRequired": ["KHR_mesh_quantization"],
           "bufferViews": [{"buffer": 0, "byteLength": 36, "byteStride": 12}],
           "accessors": [{"bufferView": 0, "componentType": 5122, "count": 3, "type": "VEC3"},
                         {"bufferView": 0, "byteOffset": 8, "componentType": 5120, "normalized": true, "count": 3, "type": "VEC3"}],
           "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}}]}], )" +
            ONE_NODE,
        vertices);
    const Scene scene = loadGltf(file);
    ASSERT_EQ(scene.primitives.size(), 1u);
    EXPECT_EQ(trianglesOf(scene.primitives)[0], (Triangle{vec3(0), vec3(0, 0, 3), vec3(-2, 0, 0)}));
    ASSERT_EQ(scene.triangleCorners.size(), 1u);
    EXPECT_EQ(scene.triangleCorners[0].n0, vec3(0, 1, 0));
    EXPECT_EQ(scene.triangleCorners[0].n1, vec3(0, -1, 0));
    EXPECT_EQ(scene.triangleCorners[0].n2, vec3(0, 0, 1));

    std::string withoutExtension = file;
    for (size_t i = 0; i < 2; i++)
        withoutExtension.replace(withoutExtension.find("\"KHR_mesh_quantization\""), 23, "");
    EXPECT_CONTAINS(
        errorOfGltf(withoutExtension),
        "POSITION of primitive 0 of mesh 0 is accessor 0, VEC3 of component type 5122 without "
        "KHR_mesh_quantization, which is not allowed");
}

TEST(Gltf, sparseAccessorsReplaceSomeElementsOfAViewOrOfZeros)
{
    const std::string buffer = bytesOf<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}) +
                               bytesOf<uint16_t>({0, 1, 3, 2, 1, 3}) +  //
                               bytesOf<uint16_t>({1, 3}) + bytesOf<float>({7, 0, 0, 0, 8, 0});
    for (const bool zeros : {false, true}) {
        const std::string members =
            R"("bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12},
                               {"buffer": 0, "byteOffset": 60, "byteLength": 4}, {"buffer": 0, "byteOffset": 64, "byteLength": 24}],
               "accessors": [{)" +
            std::string(zeros ? "" : R"("bufferView": 0, )") +
            R"("componentType": 5126, "count": 4, "type": "VEC3",
                 "sparse": {"count": 2, "indices": {"bufferView": 2, "componentType": 5123}, "values": {"bufferView": 3}}},
                {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}],
               "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}], )" +
            ONE_NODE;
        const Scene scene = loadGltf(gltfText(members, buffer));
        const vec3 corner = zeros ? vec3(0) : vec3(1, 1, 0);
        EXPECT_EQ(trianglesOf(scene.primitives)[0],
                  (Triangle{vec3(0), vec3(7, 0, 0), vec3(0, 8, 0)}));
        EXPECT_EQ(trianglesOf(scene.primitives)[1],
                  (Triangle{corner, vec3(7, 0, 0), vec3(0, 8, 0)}));
    }
}

TEST(Gltf, buffersAreFilesBesideItWithPercentSignsDecoded)
{
    SceneFolder files;
    files.write("two words.bin", squareBuffer());
    auto withUri = [](const std::string& uri) {
        return R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 60, "uri": ")" + uri +
               "\"}], " + squareMembers(ONE_NODE) + "}";
    };
    files.write("model.gltf", withUri("two%20words.bin"));
    EXPECT_EQ(trianglesOf(files.load("model.gltf").primitives), SQUARE);
    files.write("model.gltf", withUri("two words.bin"));
    EXPECT_EQ(trianglesOf(files.load("model.gltf").primitives), SQUARE);
    auto errorOf = [&](const std::string& uri) {
        files.write("model.gltf", withUri(uri));
        return errorOfFile(files, "model.gltf");
    };
    EXPECT_CONTAINS(errorOf("../other.bin"), "lies outside the scene's folder");
    EXPECT_CONTAINS(errorOf("%2e%2e/other.bin"), "lies outside the scene's folder");
    EXPECT_CONTAINS(errorOf("/etc/passwd"), "lies outside the scene's folder");
    EXPECT_CONTAINS(errorOf("https://example.org/a.bin"),
                    "only names of files and data: URIs are read");
    EXPECT_CONTAINS(errorOf("file:///etc/passwd"), "only names of files and data: URIs are read");
    EXPECT_CONTAINS(errorOf("two%2"), "% must be followed by two hexadecimal digits");
    EXPECT_CONTAINS(errorOf("data:;base64,AA!="), "0x21 is not base64");
    EXPECT_CONTAINS(errorOf("data:;base64,A"), "the base64 text is cut short");
    EXPECT_CONTAINS(errorOf("data:text/plain,hello"),
                    "is not of the form data:TYPE;base64,CONTENT");
    EXPECT_CONTAINS(errorOf("data:;base64,AAAA"), "buffer 0 should have 60 bytes; there are 3");
}

TEST(Gltf, extensionsThatAreRequiredAndNotKnownAreRefusedByName)
{
    EXPECT_EQ(errorOfGltf(
                  R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_draco_mesh_compression"],
"extensionsRequired": ["KHR_draco_mesh_compression"]})"),
              "model.gltf:2:23: the file requires the extension KHR_draco_mesh_compression, which "
              "is not read");
    const std::string warnings = warningsOf([&] {
        loadGltf(squareFile(R"("extensionsUsed": ["KHR_materials_sheen", "ACME_x"], )" + ONE_NODE));
    });
    EXPECT_CONTAINS(warnings,
                    "model.gltf: extensions that are not read: KHR_materials_sheen, ACME_x\n");
}

/// The one material of a file with a square that has it, and what the file has besides.
Material materialOf(const std::string& material, const std::string& more = "")
{
    const std::string members =
        squareViews() +
        R"(, "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
           "materials": [)" +
        material + "], " + more + ONE_NODE;
    return loadGltf(gltfText(members, squareBuffer())).materials.at(0);
}

TEST(Gltf, materialsHaveTheFactorsOfTheFile)
{
    const Material none = materialOf("{}");
    EXPECT_EQ(none.baseColor, vec3(1));
    EXPECT_EQ(none.metallic, 1);
    EXPECT_EQ(none.roughness, 1);
    EXPECT_EQ(none.eta, 1.5f);
    EXPECT_EQ(none.emission, vec3(0));
    EXPECT_EQ(none.alphaCutoff, 0);
    const Material all = materialOf(R"({"pbrMetallicRoughness":
            {"baseColorFactor": [0.25, 0.5, 0.75, 0.5], "metallicFactor": 0.125, "roughnessFactor": 0.375},
        "emissiveFactor": [1, 0.5, 0], "alphaMode": "MASK", "alphaCutoff": 0.125,
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 6},
                       "KHR_materials_ior": {"ior": 1.25},
                       "KHR_materials_transmission": {"transmissionFactor": 0.625}}})");
    EXPECT_EQ(all.baseColor, vec3(0.25f, 0.5f, 0.75f));
    EXPECT_EQ(all.metallic, 0.125f);
    EXPECT_EQ(all.roughness, 0.375f);
    EXPECT_EQ(all.emission, vec3(6, 3, 0));
    EXPECT_EQ(all.eta, 1.25f);
    EXPECT_EQ(all.transmission, 0.625f);
    EXPECT_EQ(all.alphaCutoff, 0.25f);  // of the texture's alpha, without the factor 0.5
}

TEST(Gltf, whatAlphaCutsAwayWholeIsNotThere)
{
    const std::string invisible = gltfText(
        squareViews() +
            R"(, "materials": [{"alphaMode": "MASK", "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.25]}}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}], )" +
            ONE_NODE,
        squareBuffer());
    EXPECT_CONTAINS(errorOfGltf(invisible), "has no triangles");
}

/// A picture of 2 x 1 texels, red and blue, as a PNG file.
std::string redAndBlue()
{
    const std::vector<uint8_t> bytes = encodePng({2, 1, {255, 0, 0, 0, 0, 255}}, {});
    return {bytes.begin(), bytes.end()};
}

TEST(Gltf, texturesAreLookedUpWhereTheFileSays)
{
    SceneFolder files;
    files.write("two words.png", redAndBlue());
    const std::string png = redAndBlue();
    const std::string buffer =
        squareBuffer() + bytesOf<float>({0, 0.25, 1, 0.25, 1, 1, 0, 1}) + png;
    const std::string members =
        R"("bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12},
                           {"buffer": 0, "byteOffset": 60, "byteLength": 32}, {"buffer": 0, "byteOffset": 92, "byteLength": )" +
        std::to_string(png.size()) + R"(}],
           "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                         {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
                         {"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC2"}],
           "images": [{"uri": "two%20words.png"}, {"bufferView": 3, "mimeType": "image/png"}, {"uri": "missing.png"}],
           "samplers": [{"wrapS": 33071, "magFilter": 9728}],
           "textures": [{"source": 0, "sampler": 0}, {"source": 1}, {"source": 2}],
           "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "extensions": {"KHR_texture_transform":
                              {"offset": [0.5, 0.25], "rotation": 1.5707963267948966, "scale": [2, 4]}}}},
                          "emissiveTexture": {"index": 1, "texCoord": 0}, "normalTexture": {"index": 1, "scale": 3}},
                         {"emissiveTexture": {"index": 2}}],
           "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 2, "TEXCOORD_1": 2}, "indices": 1, "material": 0}]}], )" +
        ONE_NODE;
    files.write("model.gltf", gltfText(members, buffer));
    const Scene scene = files.load("model.gltf");
    ASSERT_EQ(scene.textures.size(), 3u);
    EXPECT_EQ(scene.pictures.size(), 2u);  // that of the file, that of the buffer; none is missed
    const Material& material = scene.materials.at(0);
    const Texture& color = scene.textures.at(material.baseColorTexture - 1);
    EXPECT_EQ(color.flags, TEXTURE_SRGB | TEXTURE_CLAMP_S | TEXTURE_NEAREST);
    EXPECT_EQ(scene.textureTexels.at(color.firstTexel), 0xff0000ffu);
    // (u, v) of the file go to (4 v + 1/2, -2 u + 1/4); both v turned up: s = 4 (1 - v) + 1/2, t =
    // 2 u + 3/4.
    expectNear(color.rowS, {0, -4, 4.5f});
    expectNear(color.rowT, {2, 0, 0.75f});
    EXPECT_EQ(scene.textures.at(material.emissionTexture - 1).flags, TEXTURE_SRGB);
    const Texture& normal = scene.textures.at(material.normalTexture - 1);
    EXPECT_EQ(normal.flags, 0u);
    EXPECT_EQ(normal.strength, 3);
    // The corners' v of 0.25, 0.25, 1 are up in the scene.
    const TriangleCorners& corners = scene.triangleCorners.at(scene.primitives[0].shape);
    EXPECT_EQ(vec3(corners.u0, corners.u1, corners.u2), vec3(0, 1, 1));
    EXPECT_EQ(vec3(corners.v0, corners.v1, corners.v2), vec3(0.75f, 0.75f, 0));

    std::string broken = gltfText(members, buffer);
    broken.replace(broken.find("two%20words"), 11, "missing");
    files.write("model.gltf", broken);
    EXPECT_CONTAINS(errorOfFile(files, "model.gltf"), "missing.png");
}

TEST(Gltf, aSceneFileNamesItAmongItsShapes)
{
    SceneFolder files;
    files.write("model.glb", glbBytes(squareMembers(R"(
        "materials": [{"name": "unused"}],
        "nodes": [{"mesh": 0}, {"mesh": 0, "translation": [0, 0, 1]}], "scenes": [{"nodes": [0, 1]}])"),
                                      squareBuffer()));
    files.write("scene.json", R"({
        "materials": {"red": {"type": "lambert", "baseColor": [1, 0, 0]}},
        "groups": {"pair": {"shapes": [{"type": "mesh", "file": "model.glb"}]}},
        "shapes": [{"type": "mesh", "file": "model.glb", "material": "red", "transform": {"translate": [2, 0, 0]}},
                   {"type": "instance", "of": "pair", "transform": {"scale": 3}}]})");
    const Scene scene = files.load("scene.json");
    ASSERT_EQ(scene.instances.size(), 4u);
    ASSERT_EQ(scene.objects.size(), 2u);
    EXPECT_EQ(scene.materialNames[scene.objects[1][0].material], "red");
    EXPECT_EQ(scene.materialNames[scene.objects[0][0].material], "default");
    EXPECT_EQ(scene.instances[1].translation, glm::dvec3(2, 0, 1));
    EXPECT_EQ(scene.instances[3].translation, glm::dvec3(0, 0, 3));
    EXPECT_EQ(scene.instances[3].linear[0], glm::dvec3(3, 0, 0));
}

}  // namespace
}  // namespace sahl
