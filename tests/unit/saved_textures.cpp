// Scenes with textures, saved and loaded again, as binary and as nested JSON.
#include "support/saved_files.h"
#include "support/texture_scenes.h"

namespace sahl::testing {
namespace {

PreparedScene original()
{
    return prepareScene(leavesScene(24, 16, 8), BvhBuild::sweep, 1);
}

void expectSameTextures(const PreparedScene& a, const PreparedScene& b)
{
    const DeviceScene p = a.deviceScene(), q = b.deviceScene();
    ASSERT_GT(p.textures.size(), 5u);
    EXPECT_TRUE(sameBytes(p.textures, q.textures));
    EXPECT_TRUE(sameBytes(p.textureTexels, q.textureTexels));
}

TEST(SavedTextures, areKeptToTheBit_inBinaryFiles)
{
    const TemporaryFolder folder;
    const PreparedScene scene = original();
    writeSavedScene(scene, folder.path / "x.sahl");
    const PreparedScene loaded = loadSavedScene(folder.path / "x.sahl", {});
    expectSame(loaded, scene);
    expectSameTextures(loaded, scene);
}

TEST(SavedTextures, areKeptToTheBit_inNestedJson)
{
    const TemporaryFolder folder;
    const PreparedScene scene = original();
    writeTreeJson(scene, folder.path / "x.json");
    const PreparedScene loaded = loadTreeJson(folder.path / "x.json", {});
    expectSameButNormals(loaded, scene);
    expectSameTextures(loaded, scene);
}

/// What loading a binary file with one altered element says.
template <class Element>
std::string errorOfAltered(const std::string& section, size_t index,
                           const std::function<void(Element&)>& alter)
{
    const TemporaryFolder folder;
    const fs::path path = folder.path / "x.sahl";
    writeSavedScene(original(), path);
    std::vector<OwnSection> sections = sectionsOf(path);
    OwnSection& own = sectionNamed(sections, section);
    Element element = own.get<Element>(index);
    alter(element);
    own.set(index, element);
    writeSections(path, sections);
    return badInputOf([&] { loadSavedScene(path, {}); });
}

TEST(SavedTextures, thatPointBesideTheirTexels_areRefused)
{
    auto errorOf = [](const std::function<void(Texture&)>& alter) {
        return errorOfAltered<Texture>("textures", 1, alter);
    };
    EXPECT_EQ(errorOf([](Texture&) {}), "");
    for (const auto& alter : std::initializer_list<std::function<void(Texture&)>>{
             [](Texture& t) { t.firstTexel = 255; }, [](Texture& t) { t.firstTexel = 0xffffffff; },
             [](Texture& t) { t.width = 0; }, [](Texture& t) { t.height = 32768; },
             [](Texture& t) { t.width = 0x80000000; }, [](Texture& t) { t.flags = 16; },
             [](Texture& t) { t.rowS.x = std::nanf(""); }, [](Texture& t) { t.mean.y = -1; }}) {
        EXPECT_CONTAINS(errorOf(alter), "section 'textures': number 1");
    }
    EXPECT_CONTAINS(
        errorOfAltered<Material>("materials", 1, [](Material& m) { m.normalTexture = 99; }),
        "number 1 has texture 99 of");
    EXPECT_CONTAINS(
        errorOfAltered<TriangleCorners>("corners", 0, [](auto& c) { c.v1 = std::nanf(""); }),
        "texture coordinates of number 0");
    EXPECT_CONTAINS(
        errorOfAltered<uint32_t>("textureTexels", 7, [](uint32_t& t) { t = 0xffffffff; }),
        "the sRGB curve falls at 7");
}

}  // namespace
}  // namespace sahl::testing
