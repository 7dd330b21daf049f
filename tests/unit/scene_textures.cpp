// Textures of scene files, MTL files and meshes: what is read, and what is refused.
#include "scene/mesh_file.h"
#include "scene/texture.h"
#include "support/scene_files.h"
#include "support/temporary_folder.h"

#include "image/image.h"

#include <fmt/format.h>

namespace sahl::testing {
namespace {

const std::string SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

/// A PNG of one colour.
void writePng(const SceneFolder& files, const std::string& name, uint32_t width, uint32_t height,
              const std::array<uint8_t, 3>& color)
{
    Image8 image = {width, height, {}};
    for (uint32_t i = 0; i < width * height; i++)
        image.rgb.insert(image.rgb.end(), color.begin(), color.end());
    fs::create_directories((files.folder.path / name).parent_path());
    writeFileAtomically(files.folder.path / name, encodePng(image, {}));
}

std::string withMaterial(const std::string& material)
{
    return R"({"materials":{"m":{"type":"lambert",)" + material +
           R"(}},"shapes":[{"type":"rectangle","corner":[0,0,0],"edgeU":[1,0,0],"edgeV":[0,1,0],"material":"m"}],)"
           R"("environment":{"radiance":[1,1,1]}})";
}

struct TextureFiles : SceneFolder {
    TextureFiles()
    {
        writePng(*this, "a.png", 3, 2, {10, 20, 30});
        writePng(*this, "b.png", 3, 2, {200, 100, 50});
        writePng(*this, "c.png", 2, 2, {0, 0, 255});
    }
    Scene loadMaterial(const std::string& material) const
    {
        write("s.json", withMaterial(material));
        return load("s.json");
    }
    std::string errorOf(const std::string& material) const
    {
        write("s.json", withMaterial(material));
        return errorOfFile(*this, "s.json");
    }
    /// A square of a material "m".
    Scene loadMtl(const std::string& mtl) const
    {
        write("m.mtl", "newmtl m\n" + mtl);
        write("m.obj", "mtllib m.mtl\n" + SQUARE +
                           "vt 0 0\nvt 2 -1.5\nvt 0.5\nusemtl m\nf 1/1 2/2 3/3\nf 1 3 4\n");
        return load("m.obj");
    }
    std::string errorOfMtl(const std::string& mtl) const
    {
        return badInputOf([&] { loadMtl(mtl); });
    }
};

TEST(SceneTextures, areReadOnce_andLookedUpAsAskedFor)
{
    const TextureFiles files;
    const Scene scene = files.loadMaterial(
        R"("baseColorTexture":"a.png","normalTexture":{"file":"a.png","strength":2,"wrap":"clamp"},)"
        R"("emissionTexture":{"file":"./a.png","filter":"nearest","wrapV":"clamp","scale":[2,3],"offset":0.5})");
    ASSERT_EQ(scene.textures.size(), 3u);
    EXPECT_EQ(scene.textureTexels.size(), SRGB_TABLE_SIZE + 6);
    EXPECT_EQ(scene.textureTexels.back(), packTexel(10, 20, 30, 255));
    const Material& m = scene.materials.at(0);
    EXPECT_EQ(m.baseColor, vec3(1));
    EXPECT_EQ(m.emission, vec3(1));
    const Texture& color = scene.textures.at(m.baseColorTexture - 1);
    EXPECT_EQ(color.flags, TEXTURE_SRGB);
    EXPECT_EQ(color.width, 3u);
    EXPECT_EQ(color.height, 2u);
    const Texture& normal = scene.textures.at(m.normalTexture - 1);
    EXPECT_EQ(normal.flags, TEXTURE_CLAMP_S | TEXTURE_CLAMP_T);
    EXPECT_EQ(normal.strength, 2);
    const Texture& lamp = scene.textures.at(m.emissionTexture - 1);
    EXPECT_EQ(lamp.flags, TEXTURE_SRGB | TEXTURE_NEAREST | TEXTURE_CLAMP_T);
    EXPECT_EQ(lamp.rowS, vec3(2, 0, 0.5f));
    EXPECT_EQ(lamp.rowT, vec3(0, 3, 0.5f));
    EXPECT_EQ(m.roughnessTexture, NO_TEXTURE);
}

TEST(SceneTextures, ofTheSameLook_areOne)
{
    const TextureFiles files;
    const Scene scene = files.loadMaterial(
        R"("baseColorTexture":"a.png","emissionTexture":"a.png","baseColor":[0.5,0.5,0.5])");
    EXPECT_EQ(scene.textures.size(), 1u);
    EXPECT_EQ(scene.materials.at(0).baseColor, vec3(0.5f));
}

TEST(SceneTextures, thatCannotBe_areRefusedWithTheirPlace)
{
    const TextureFiles files;
    EXPECT_CONTAINS(files.errorOf(R"("baseColorTexture":"none.png")"), "the file \"none.png\" of");
    EXPECT_CONTAINS(files.errorOf(R"("baseColorTexture":"/etc/passwd")"),
                    "lies outside the scene's folder");
    EXPECT_CONTAINS(files.errorOf(R"("baseColorTexture":"s.json")"), "is neither PNG nor JPEG");
    EXPECT_CONTAINS(files.errorOf(R"("texture":"a.png")"), "did you mean \"baseColorTexture\"?");
    EXPECT_CONTAINS(files.errorOf(R"("alphaCutoff":0.5)"), "needs a \"baseColorTexture\"");
    EXPECT_CONTAINS(files.errorOf(R"("normalTexture":{"file":"a.png","colorSpace":"srgb"})"),
                    "colorSpace");
    EXPECT_CONTAINS(files.errorOf(R"("baseColorTexture":{"file":"a.png","scale":[1,2,3]})"),
                    "needs 2 numbers");
    files.write(
        "b.json",
        R"({"materials":{"m":{"type":"lambert","baseColorTexture":"a.png","alphaCutoff":0.5}},)"
        R"("shapes":[{"type":"sphere","material":"m"}]})");
    EXPECT_CONTAINS(errorOfFile(files, "b.json"), "a sphere cannot have holes");
}

TEST(SceneTextures, coordinatesOfTriangles_areOnePairForEachPosition)
{
    const TextureFiles files;
    auto sceneWith = [](const std::string& more) {
        return R"({"materials":{"m":{"type":"lambert","baseColorTexture":"a.png"}},"shapes":[)"
               R"({"type":"triangles","positions":[[0,0,0],[1,0,0],[0,1,0]],"indices":[[0,1,2]],)"
               R"("material":"m","uvs":[[0.25,0],[1,-2],[0,3])" +
               more + R"(]}],"environment":{"radiance":[1,1,1]}})";
    };
    files.write("t.json", sceneWith(""));
    const TriangleCorners corners = files.load("t.json").triangleCorners.at(0);
    EXPECT_EQ(vec3(corners.u0, corners.u1, corners.u2), vec3(0.25f, 1, 0));
    EXPECT_EQ(vec3(corners.v0, corners.v1, corners.v2), vec3(0, -2, 3));
    EXPECT_EQ(corners.n0, vec3(0));
    files.write("t.json", sceneWith(",[1,1]"));
    EXPECT_CONTAINS(errorOfFile(files, "t.json"), "3 positions and 4 pairs of texture coordinates");
}

TEST(MtlTextures, becomeThoseOfTheMaterial)
{
    const TextureFiles files;
    const Scene scene =
        files.loadMtl("Kd 0.5 0.5 0.5\nmap_Kd -s 2 4 1 -o 0.5 -clamp on a.png\nmap_Ke b.png\n"
                      "norm -bm 0.5 c.png\nPr 0.5\nPm 1\n");
    const Material& m = scene.materials.at(0);
    EXPECT_EQ(m.baseColor, vec3(0.5f));
    EXPECT_EQ(m.emission, vec3(1));
    const Texture& color = scene.textures.at(m.baseColorTexture - 1);
    EXPECT_EQ(color.flags, TEXTURE_SRGB | TEXTURE_CLAMP_S | TEXTURE_CLAMP_T);
    EXPECT_EQ(color.rowS, vec3(2, 0, 0.5f));
    EXPECT_EQ(color.rowT, vec3(0, 4, 0));
    EXPECT_EQ(scene.textures.at(m.emissionTexture - 1).flags, TEXTURE_SRGB);
    EXPECT_EQ(scene.textures.at(m.normalTexture - 1).flags, 0u);
    EXPECT_EQ(scene.textures.at(m.normalTexture - 1).strength, 0.5f);
    EXPECT_EQ(m.alphaCutoff, 0);
    EXPECT_EQ(m.type, MATERIAL_METALLIC_ROUGHNESS);
    EXPECT_EQ(m.roughness, 0.5f);
    EXPECT_EQ(m.metallic, 1);
    const TriangleCorners corners = scene.triangleCorners.at(0);
    EXPECT_EQ(vec3(corners.u0, corners.u1, corners.u2), vec3(0, 2, 0.5f));
    EXPECT_EQ(vec3(corners.v0, corners.v1, corners.v2), vec3(0, -1.5f, 0));
    EXPECT_EQ(scene.primitives.at(1).shape, SHAPE_FLAT);
}

TEST(MtlTextures, ofRoughnessAndMetalAndOfAlpha_areJoined)
{
    const TextureFiles files;
    const Scene scene = files.loadMtl(
        "map_Kd a.png\nmap_d -imfchan g b.png\nd 0.8\nmap_Pr -imfchan r b.png\nmap_Pm a.png\n");
    const Material& m = scene.materials.at(0);
    EXPECT_EQ(m.baseColor, vec3(1));
    EXPECT_FLOAT_EQ(m.alphaCutoff, 0.625f);
    auto texelOf = [&](uint32_t number) {
        return scene.textureTexels.at(scene.textures.at(number - 1).firstTexel);
    };
    EXPECT_EQ(texelOf(m.baseColorTexture), packTexel(10, 20, 30, 100));
    // 0.2126 x 10 + 0.7152 x 20 + 0.0722 x 30 = 18.6
    EXPECT_EQ(texelOf(m.roughnessTexture), packTexel(255, 200, 19, 255));
    EXPECT_EQ(m.type, MATERIAL_METALLIC_ROUGHNESS);
    EXPECT_EQ(m.roughness, 1);
    EXPECT_EQ(m.metallic, 1);
    EXPECT_EQ(files.loadMtl("Pr 0.25\n").materials.at(0).metallic, 0);
    EXPECT_EQ(files.loadMtl("Kd 1 1 1\n").materials.at(0).type, MATERIAL_LAMBERT);
    const Scene alone = files.loadMtl("map_Pm -imfchan b c.png\n");
    EXPECT_EQ(alone.textureTexels.back(), packTexel(255, 255, 255, 255));
}

TEST(MtlTextures, thatCannotBe_areRefusedWithTheirLine)
{
    const TextureFiles files;
    EXPECT_CONTAINS(files.errorOfMtl("map_Kd none.png\n"), "m.mtl:2: the texture");
    EXPECT_CONTAINS(files.errorOfMtl("map_Kd none.png\n"), "is missing");
    for (const char* name :
         {"../../../../etc/passwd", "/etc/passwd", R"(\\host\share\a.png)", R"(..\a.png)"}) {
        EXPECT_CONTAINS(files.errorOfMtl(std::string("map_Kd ") + name + "\n"), "m.mtl:2: ");
        EXPECT_CONTAINS(files.errorOfMtl(std::string("map_Kd ") + name + "\n"),
                        "lies outside the scene's folder");
    }
    for (const char* name : {"$HOME/a.png", "`id`", "http://a/b.png"})
        EXPECT_CONTAINS(files.errorOfMtl(std::string("map_Kd ") + name + "\n"), "is missing");
    EXPECT_CONTAINS(files.errorOfMtl("map_Kd -zoom 3 a.png\n"),
                    "m.mtl:2: \"-zoom\" is no option of map_Kd");
    EXPECT_CONTAINS(files.errorOfMtl("map_Kd -clamp maybe a.png\n"),
                    "needs \"on\" or \"off\", found \"maybe\"");
    EXPECT_CONTAINS(files.errorOfMtl("map_Kd -s a.png\n"), "needs a number");
    EXPECT_CONTAINS(files.errorOfMtl("map_Kd\n"), "names no file");
    EXPECT_CONTAINS(files.errorOfMtl("map_Pr a.png\nmap_Pm c.png\n"), "3 x 2");
    EXPECT_CONTAINS(files.errorOfMtl("map_Pr -s 2 a.png\nmap_Pm b.png\n"),
                    "must have the same -s, -o and -clamp");
    EXPECT_CONTAINS(files.errorOfMtl("Pr x\n"), "m.mtl:2: \"x\" is not a number");
}

TEST(MtlTextures, optionsWithoutEffect_areTold)
{
    const TextureFiles files;
    const std::string warning =
        warningsOf([&] { files.loadMtl("map_Kd -blendu off -mm 0 1 a.png\nd 0.5\n"); });
    EXPECT_CONTAINS(warning, "left out: -blendu, -mm, d without map_d");
}

TEST(MtlTextures, filesWithBlanksAndInFolders_areFound)
{
    const TextureFiles files;
    writePng(files, "tex/my wood.png", 1, 1, {1, 2, 3});
    EXPECT_EQ(files.loadMtl("map_Kd -s 1 1 1 tex\\my wood.png\n").textureTexels.back(),
              packTexel(1, 2, 3, 255));
}

TEST(PlyTextures, coordinatesAreReadByAnyOfTheirNames)
{
    for (const auto& [u, v] :
         {std::pair("u", "v"), std::pair("s", "t"), std::pair("texture_u", "texture_v")}) {
        const SceneFolder files;
        files.write(
            "a.ply",
            fmt::format(
                "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                "property float z\nproperty float {}\nproperty float {}\nelement face 1\n"
                "property list uchar int vertex_indices\nend_header\n"
                "0 0 0 0.5 1\n1 0 0 2 nan\n0 1 0 -1 3\n3 0 1 2\n",
                u, v));
        const ObjFile file = readMeshFile(files.folder.path / "a.ply", {files.folder.path, {}});
        ASSERT_EQ(file.mesh.uvs.size(), 3u);
        EXPECT_EQ(file.mesh.uvs[1], vec2(2, 0));
        EXPECT_EQ(file.mesh.uvs[2], vec2(-1, 3));
        EXPECT_EQ(file.mesh.triangles[0].uv, (std::array<uint32_t, 3>{0, 1, 2}));
    }
}

/// Scenes without textures have no use for coordinates: nothing of them changes.
TEST(MeshTextures, coordinatesAreKeptOnlyWhereSomethingUsesThem)
{
    const TextureFiles files;
    EXPECT_TRUE(files.loadMtl("Kd 1 1 1\n").triangleCorners.empty());
    EXPECT_EQ(files.loadMtl("map_Kd a.png\n").triangleCorners.size(), 1u);
}

}  // namespace
}  // namespace sahl::testing
