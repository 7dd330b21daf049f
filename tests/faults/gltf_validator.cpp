// Other people's glTF files, sound and broken: those of Khronos' validator with its own verdicts,
// and those on which other readers crashed.
#include "scene/gltf_model.h"
#include "support/assets.h"
#include "support/scene_files.h"

#include <algorithm>
#include <map>
#include <set>

namespace sahl {
namespace {

using namespace sahl::testing;

/// The error of reading a file, "" for none. Whether it shows anything does not matter.
std::string errorOfReading(const fs::path& path)
{
    std::string error;
    warningsOf([&] {
        error = badInputOf([&] {
            GltfModel model;
            readGltf(model, path, {folderOf(path), {}});
        });
    });
    return error;
}

struct Finding {
    std::string code, pointer;
};

/// The errors of a validator's report.
std::vector<Finding> errorsIn(const fs::path& report)
{
    const JsonDocument document = parseJson(report.string(), readTextFile(report));
    const JsonObject issues = *childOf(JsonObject(document, document.root, "report"), "issues");
    std::vector<Finding> errors;
    for (const JsonNode& node : itemsOf(issues, "messages")) {
        const JsonObject message(document, node, "message");
        if (message.uint("severity", 0, 0, 3) == 0)
            errors.push_back({message.string("code", ""), message.string("pointer", "")});
    }
    return errors;
}

/// Errors that do not touch what is read, and why.
const std::map<std::string, std::string> HARMLESS = {
    {"ACCESSOR_MIN_MISMATCH", "min and max are not used: boxes are made of the vertices"},
    {"ACCESSOR_MAX_MISMATCH", "likewise"},
    {"ACCESSOR_ELEMENT_OUT_OF_MIN_BOUND", "likewise"},
    {"ACCESSOR_ELEMENT_OUT_OF_MAX_BOUND", "likewise"},
    {"MESH_PRIMITIVE_POSITION_ACCESSOR_WITHOUT_BOUNDS", "likewise"},
    {"ACCESSOR_INVALID_FLOAT", "of numbers that the scene does not show"},
    {"ACCESSOR_INDEX_PRIMITIVE_RESTART", "likewise"},
    {"ACCESSOR_NON_CLAMPED", "colours of vertices are not used"},
    {"ACCESSOR_INVALID_SIGN", "tangents are not used"},
    {"ACCESSOR_VECTOR3_NON_UNIT", "normals are given unit length"},
    {"MESH_PRIMITIVE_INVALID_ATTRIBUTE", "attributes of other names are not used"},
    {"MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_UNSIGNED_INT", "likewise"},
    {"MESH_PRIMITIVE_INDEXED_SEMANTIC_CONTINUITY", "sets of coordinates may have any numbers"},
    {"MESH_PRIMITIVE_TOO_FEW_TEXCOORDS",
     "what has no texture coordinates shows one point of its textures"},
    {"MESH_PRIMITIVES_UNEQUAL_TARGETS_COUNT", "morph targets are left out"},
    {"BUFFER_VIEW_INVALID_BYTE_STRIDE",
     "the target of a view is not used: it is a hint for devices"},
    {"EMPTY_ENTITY", "an empty list is as good as none, and programs write them"},
    {"INVALID_JSON", "a byte order mark before the JSON is skipped"},
    {"UNEXPECTED_EXTENSION_OBJECT", "extensions are looked for where they belong"},
    {"UNDECLARED_EXTENSION", "extensions are read also where extensionsUsed forgets them"},
    {"NODE_SKIN_NO_SCENE", "skins are left out"},
    {"NODE_SKIN_WITH_NON_SKINNED_MESH", "likewise"},
    {"IMAGE_DATA_INVALID", "pictures are read once a mesh of the scene uses them"},
    {"IMAGE_UNEXPECTED_EOS", "likewise"},
    {"IMAGE_MIME_TYPE_INVALID", "likewise, and their content tells what they are"},
    {"TEXTURE_INVALID_IMAGE_MIME_TYPE", "likewise"},
    {"INVALID_URI", "of a picture: likewise"},
};

/// Whether an error is one of what Sahl does not look at.
bool isHarmless(const Finding& error)
{
    if (HARMLESS.count(error.code) > 0) return true;
    for (const char* part :
         {"/animations/", "/skins/", "/targets/", "/extensions/KHR_materials_variants",
          "/extensions/KHR_materials_anisotropy", "/extensions/KHR_materials_volume",
          "/extensions/EXT_texture_webp", "/extensions/KHR_invalid"}) {
        if (error.pointer.find(part) != std::string::npos) return true;
    }
    return false;
}

/// Files in which the validator finds no error and that are refused all the same.
const std::map<std::string, std::string> REFUSED = {
    {"base/accessor/unknown_type.gltf", "\"type\" of accessor 0 is \"NotaVEC3\""},
    {"base/asset/min_version_valid.gltf", "the file needs a reader of glTF 2.1"},
    {"base/buffer/data_uri.glb", "is not of the form data:TYPE;base64,CONTENT"},
    {"ext/KHR_lights_punctual/light/unknown_type.gltf", "\"type\" of light 0 is \"spherical\""},
    {"base/root/named_objects.gltf", "buffer view 0 ends at byte 648 of buffer 0, which has 0"},
    {"base/root/unused_objects.gltf", "buffer view 0 ends at byte 648 of buffer 0, which has 0"},
};

std::vector<fs::path> filesBelow(const fs::path& folder)
{
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const fs::path extension = entry.path().extension();
        if (extension == ".gltf" || extension == ".glb") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

TEST(GltfValidator, whatItFindsWrongIsRefusedAsFarAsItIsRead)
{
    SAHL_REQUIRE_ASSET("bad/gltf-validator");
    const fs::path folder = assetFolder() / "bad/gltf-validator";
    std::set<std::string> harmlessSeen;
    size_t broken = 0, refused = 0;
    for (const fs::path& file : filesBelow(folder)) {
        const std::string name = fs::relative(file, folder).string();
        const std::string error = errorOfReading(file);
        const auto expected = REFUSED.find(name);
        if (expected != REFUSED.end()) {
            EXPECT_CONTAINS(error, expected->second);
            continue;
        }
        const std::vector<Finding> findings = errorsIn(file.string() + ".report.json");
        const bool mustRefuse = !std::all_of(findings.begin(), findings.end(), isHarmless);
        EXPECT_EQ(error != "", mustRefuse || (error != "" && !findings.empty()))
            << name << ": " << error;
        broken += !findings.empty();
        refused += error != "";
        for (const Finding& finding : findings)
            if (error.empty()) harmlessSeen.insert(finding.code);
    }
    EXPECT_EQ(broken, 165u);
    EXPECT_EQ(refused, 83u);
    for (const auto& [code, why] : HARMLESS) EXPECT_EQ(harmlessSeen.count(code), 1u) << code;
}

TEST(GltfValidator, filesOnWhichOtherReadersCrashedAreReadOrRefused)
{
    SAHL_REQUIRE_ASSET("bad/gltf-assimp");
    const std::map<std::string, std::string> expected = {
        {"gltf-assimp/BoxWithInfinites-glTF-Binary/BoxWithInfinites.glb",
         "is (-inf, -0.5, 0.5); it must be finite"},
        {"gltf-assimp/IncorrectVertexArrays/Cube.gltf",
         "buffer view 2 ends at byte 936 of buffer 0"},
        {"gltf-assimp/IndexOutOfRange/AllIndicesOutOfRange.gltf",
         "is 65535; there are 24 vertices"},
        {"gltf-assimp/IndexOutOfRange/IndexOutOfRange.gltf", "is 255; there are 24 vertices"},
        {"gltf-assimp/RecursiveNodes/RecursiveNodes.gltf", "node 0 is below itself"},
        {"gltf-assimp/SchemaFailures/sceneWrongType.gltf", "No such file or directory"},
        {"gltf-assimp/issue_3269/texcoord_crash.gltf", ""},
        {"gltf-assimp/wrongTypes/badArray.gltf", "must be an array, found an object"},
        {"gltf-assimp/wrongTypes/badExtension.gltf", "must be an object, found a text"},
        {"gltf-assimp/wrongTypes/badNumber.gltf", "normalTexture lacks the key \"index\""},
        {"gltf-assimp/wrongTypes/badObject.gltf", "must be an object, found an array"},
        {"gltf-assimp/wrongTypes/badString.gltf",
         "\"name\" of scene 0 must be a text, found a number"},
        {"gltf-assimp/wrongTypes/badUint.gltf", "baseColorTexture is -1"},
        {"gltf-cgltf/BadBasisU.gltf", "syntax error"},
        {"gltf-cgltf/TriangleWithoutIndices.gltf", ""},
        {"gltf-tinygltf/BoundsChecking/integer-out-of-bounds.gltf", "is 1e+300; it must lie in"},
        {"gltf-tinygltf/BoundsChecking/invalid-buffer-index.gltf", "the file has 1 buffers"},
        {"gltf-tinygltf/BoundsChecking/invalid-buffer-view-index.gltf", "the file has 0 buffers"},
        {"gltf-tinygltf/BoundsChecking/invalid-primitive-indices.gltf", "the file has 0 buffers"},
        {"gltf-tinygltf/issue-416.gltf", "it must be like \"2.0\""},
    };
    for (const char* folder : {"gltf-assimp", "gltf-cgltf", "gltf-tinygltf"}) {
        for (const fs::path& file : filesBelow(assetFolder() / "bad" / folder)) {
            const auto found = expected.find(fs::relative(file, assetFolder() / "bad").string());
            ASSERT_NE(found, expected.end()) << file;
            const std::string error = errorOfReading(file);
            EXPECT_EQ(error.empty(), found->second.empty()) << file << ": " << error;
            EXPECT_CONTAINS(error, found->second);
        }
    }
}

TEST(GltfModels, haveTheTrianglesThatTheirFilesDescribe)
{
    const std::map<std::string, uint64_t> triangles = {
        {"CornellBox.glb", 36},
        {"Cubes.glb", 36},
        {"DamagedHelmet.glb", 15452},
        {"Fox.glb", 576},
        {"GolfBall.glb", 356},
        {"FlightHelmet/FlightHelmet.gltf", 94722},
        {"TonemappingTest/TonemappingTest.gltf", 6590},
        {"assimp/2CylinderEngine-glTF-Binary/2CylinderEngine.glb", 75730},
        {"assimp/BoxTexcoords-glTF/boxTexcoords.gltf", 12},
        {"assimp/BoxTextured-glTF/BoxTextured.gltf", 12},
        {"assimp/BoxTextured-glTF-Binary/BoxTextured.glb", 12},
        {"assimp/BoxTextured-glTF-Embedded/BoxTextured.gltf", 12},
        {"assimp/ClearCoat-glTF/ClearCoatTest.gltf", 37116},
        {"assimp/cameras/Cameras.gltf", 2},
        {"assimp/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_04.gltf", 2},
        {"assimp/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_05.gltf", 2},
        {"assimp/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_06.gltf", 2},
        {"assimp/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_11.gltf", 2},
        {"assimp/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_12.gltf", 2},
        {"assimp/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_13.gltf", 2},
        {"assimp/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_14.gltf", 2},
        {"assimp/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_15.gltf", 2},
        {"assimp/textureTransform/TextureTransformTest.gltf", 18},
        {"shader_ball/shader_ball.gltf", 9450},
        {"tinygltf/Cube/Cube.gltf", 12},
        {"tinygltf/CubeImageUriSpaces/CubeImageUriMultipleSpaces.gltf", 12},
        {"tinygltf/CubeImageUriSpaces/CubeImageUriSpaces.gltf", 12},
    };
    SAHL_REQUIRE_ASSET("gltf");
    SceneOptions options;
    options.width = options.height = 8;
    for (const fs::path& file : filesBelow(assetFolder() / "gltf")) {
        const auto found = triangles.find(fs::relative(file, assetFolder() / "gltf").string());
        std::string error;
        uint64_t count = 0;
        warningsOf([&] {
            error = badInputOf([&] {
                const Scene scene = loadScene(file, options);
                count = scene.primitives.size() + scene.droppedTriangles;
                for (const auto& object : scene.objects) count += object.size();
            });
        });
        if (found == triangles.end())  // points and lines
            EXPECT_CONTAINS(error, "the scene of this file has no triangles");
        else
            EXPECT_EQ(count, found->second) << file << error;
    }
}

}  // namespace
}  // namespace sahl
