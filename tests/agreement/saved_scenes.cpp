// Saved and unsaved scenes are the same scene: equal films, digests and counters, on the device and
// on the CPU.
#include "image/image.h"
#include "support/device_test.h"
#include "support/gltf_room.h"
#include "support/saved_files.h"
#include "support/source_folder.h"

namespace sahl::testing {
namespace {

class SavedScenes : public DeviceTest {
protected:
    /// The same film from the scene as built, from the binary file and from JSON.
    void expectSameFilms(const PreparedScene& original)
    {
        const fs::path binary = folder.path / "x.sahl", json = folder.path / "x.json";
        writeSavedScene(original, binary);
        const PreparedScene saved = loadSavedScene(binary, {});
        const Film expected = renderFilm(*cpu_, original);
        EXPECT_GT(expected.counters.boxTests, 0u);
        EXPECT_TRUE(renderFilm(*cpu_, saved) == expected);
        EXPECT_TRUE(renderFilm(*device_, saved) == expected);
        EXPECT_EQ(saved.bvh.statistics.primitivesSeen, original.bvh.statistics.primitivesSeen);
        writeTreeJson(original, json);
        const PreparedScene tree = loadTreeJson(json, {});
        EXPECT_TRUE(renderFilm(*cpu_, tree) == expected);
        EXPECT_TRUE(renderFilm(*device_, tree) == expected);
    }

    TemporaryFolder folder;

private:
    std::unique_ptr<Device> device_ = openFirstDevice();
    std::unique_ptr<Device> cpu_ = makeCpuDevice({});
};

TEST_F(SavedScenes, ofEveryFeatureRenderToTheSameBits)
{
    expectSameFilms(prepareText(richScene()));
    Image stripes = {8, 8, {}};  // the angular map that one of the scenes names
    for (uint32_t i = 0; i < 3 * 64; i++) stripes.rgb.push_back(static_cast<float>(i % 7));
    writeFileAtomically(folder.path / "angular.pfm", encodePfm(stripes));
    writeFileAtomically(folder.path / "room.glb", gltfRoom());
    const fs::path scenes = sourceFolder() / "tests/scenes";
    for (const auto& entry : fs::directory_iterator(scenes)) {
        SCOPED_TRACE(entry.path().filename().string());
        const fs::path scene = folder.path / entry.path().filename();
        fs::copy_file(entry.path(), scene);
        expectSameFilms(
            prepareScene(loadScene(scene, smallPicture(16, 12, 9)), BvhBuild::automatic, 2));
    }
}

TEST_F(SavedScenes, ofOneObjectPlacedTwentyTimesRenderToTheSameBits)
{
    expectSameFilms(prepareText(crowdScene()));
}

TEST_F(SavedScenes, ofAMeshRenderToTheSameBits)
{
    SAHL_REQUIRE_ASSET("meshes/miro/bunny.obj");
    const fs::path bunny = assetFolder() / "meshes/miro/bunny.obj";
    const SceneOptions options = smallPicture(48, 48, 8);
    expectSameFilms(prepareScene(loadScene(bunny, options), BvhBuild::automatic, 2));
}

}  // namespace
}  // namespace sahl::testing
