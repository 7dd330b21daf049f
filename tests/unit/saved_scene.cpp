// Scenes saved with their tree, and loaded again: nothing is lost, nothing is built, nothing is
// copied.
#include "scene/camera.h"
#include "support/saved_files.h"

namespace sahl::testing {
namespace {

class SavedSceneTest : public ::testing::Test {
protected:
    PreparedScene savedAndLoaded(const PreparedScene& prepared, const SceneOptions& options = {})
    {
        writeSavedScene(prepared, path);
        return loadSavedScene(path, options);
    }

    TemporaryFolder folder;
    fs::path path = folder.path / "x.sahl";
};

TEST_F(SavedSceneTest, everyArrayAndSettingIsKeptToTheBit)
{
    const PreparedScene original = prepareText(richScene());
    ASSERT_GT(original.bvh.nodes.size(), 20u);
    ASSERT_GT(original.scene.triangleCorners.size(), 20u);
    expectSame(savedAndLoaded(original), original);
}

TEST_F(SavedSceneTest, arraysLieInTheFile)
{
    const PreparedScene loaded = savedAndLoaded(prepareText(richScene()));
    const std::span<const std::byte> file = loaded.file->bytes();
    auto liesInFile = [&](auto array) {
        const auto* begin = reinterpret_cast<const std::byte*>(array.data());
        return begin >= file.data() && begin + array.size_bytes() <= file.data() + file.size() &&
               (begin - file.data()) % 64 == 0;
    };
    const DeviceScene scene = loaded.deviceScene();
    EXPECT_TRUE(liesInFile(scene.nodes));
    EXPECT_TRUE(liesInFile(scene.primitives));
    EXPECT_TRUE(liesInFile(scene.triangleCorners));
    EXPECT_TRUE(liesInFile(scene.materials));
    EXPECT_TRUE(liesInFile(loaded.sceneLights()));
    EXPECT_TRUE(liesInFile(scene.probeTexels));
}

TEST_F(SavedSceneTest, instancesAreKeptToTheBit)
{
    const PreparedScene original =
        prepareScene(loadScene(instancesScene(), {}), BvhBuild::sweep, 2);
    ASSERT_GT(original.bvh.instances.size(), 8u);
    expectSame(savedAndLoaded(original), original);
}

TEST_F(SavedSceneTest, instancesAreNotSeenFromFartherAwayThanTheirBoxesHoldFor)
{
    const std::string text = R"({"film": {"width": 30, "height": 30},
        "groups": {"ball": {"shapes": [{"type": "sphere", "radius": 1}]}},
        "shapes": [{"type": "instance", "of": "ball"}], "environment": {"builtin": "studio"}})";
    writeSavedScene(prepareText(text), path);
    EXPECT_NO_THROW(loadSavedScene(path, smallPicture(60, 60, 1)));
    try {
        loadSavedScene(path, smallPicture(10, 60, 1));  // narrow: the framing camera moves back
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind, ErrorKind::usage);
        EXPECT_CONTAINS(error.what(), "a picture of 10 x 60 pixels moves the camera farther away");
    }
}

TEST_F(SavedSceneTest, movedScenesStayWhole)
{
    const PreparedScene original = prepareText(richScene());
    PreparedScene loaded = savedAndLoaded(original);
    const PreparedScene moved = std::move(loaded);
    expectSame(moved, original);
}

TEST_F(SavedSceneTest, sameSceneGivesTheSameBytes)
{
    const PreparedScene original = prepareText(richScene());
    writeSavedScene(original, path);
    writeSavedScene(loadSavedScene(path, {}), folder.path / "again.sahl");
    EXPECT_EQ(readFile(path), readFile(folder.path / "again.sahl"));
}

TEST_F(SavedSceneTest, ofNothing_isASceneOfNothing)
{
    const PreparedScene original = prepareText(R"({"environment": {"radiance": [1, 2, 3]}})");
    const PreparedScene loaded = savedAndLoaded(original);
    expectSame(loaded, original);
    EXPECT_EQ(loaded.bvh.rootRef, REF_NONE);
}

TEST_F(SavedSceneTest, ofASingleLeaf_hasNoNodes)
{
    const PreparedScene original = prepareText(
        R"({"shapes": [{"type": "sphere", "radius": 1}], "environment": {"builtin": "studio"}})");
    const PreparedScene loaded = savedAndLoaded(original);
    expectSame(loaded, original);
    EXPECT_EQ(loaded.deviceScene().nodes.size(), 0u);
}

TEST_F(SavedSceneTest, optionsOfThePictureCount)
{
    SceneOptions options = smallPicture(50, 20, 3);
    options.seed = 99;
    options.maxBounces = 1;
    options.probeFilter = "nearest";
    options.integrator = INTEGRATOR_PHONG;
    options.shadows = true;
    writeSavedScene(prepareText(richScene()), path);
    expectSame(loadSavedScene(path, options), prepareText(richScene(), options));
}

TEST_F(SavedSceneTest, aFramingCameraFramesEverySize)
{
    const std::string mesh = "v 0 0 0\nv 3 0 0\nv 0 1 0\nv 0 0 2\nf 1 2 3\nf 1 2 4\n";
    writeSavedScene(prepareScene(loadObj(mesh), BvhBuild::automatic, 1), path);
    for (const auto& [width, height] : {std::pair{90u, 20u}, std::pair{20u, 90u}}) {
        const SceneOptions options = smallPicture(width, height, 1);
        const Camera expected = loadText("mesh.obj", mesh, options).camera;
        const Camera found = loadSavedScene(path, options).scene.camera;
        EXPECT_EQ(std::memcmp(&expected, &found, sizeof(Camera)), 0) << width << " x " << height;
    }
}

TEST_F(SavedSceneTest, anotherProbeTakesThePlaceOfTheSavedOne)
{
    const fs::path probe = folder.path / "probe.pfm";
    writeFileAtomically(probe, encodePfm({2, 1, {1, 2, 3, 4, 5, 6}}));
    SceneOptions options;
    options.probe = probe;
    writeSavedScene(prepareText(richScene()), path);
    const PreparedScene expected = prepareText(richScene(), options);
    expectSame(loadSavedScene(path, options), expected);
    ASSERT_TRUE(expected.scene.background.has_value());
    EXPECT_EQ(vec3(expected.deviceScene().probeTexels[1]), vec3(4, 5, 6));

    writeTreeJson(loadSavedScene(path, {}), folder.path / "tree.json");
    expectSameButNormals(loadTreeJson(folder.path / "tree.json", options), expected);
}

TEST_F(SavedSceneTest, optionsThatNeedTheOriginalSceneAreRefused)
{
    writeSavedScene(prepareText(richScene()), path);
    SceneOptions smooth, mapping;
    smooth.smoothNormals = true;
    mapping.probeMapping = "angular";
    for (const auto& [options, name] :
         {std::pair{smooth, "--smooth-normals"}, std::pair{mapping, "--probe-mapping"}}) {
        try {
            loadSavedScene(path, options);
            ADD_FAILURE() << name;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind, ErrorKind::usage);
            EXPECT_CONTAINS(error.what(), name);
            EXPECT_CONTAINS(error.what(), "x.sahl: is a saved scene");
        }
    }
}

TEST_F(SavedSceneTest, withoutADescribedCamera_isRefusedRatherThanHalfSaved)
{
    PreparedScene prepared = prepareText(richScene());
    prepared.scene.cameraDescription.reset();
    EXPECT_CONTAINS(badInputOf([&] { writeSavedScene(prepared, path); }), "camera");
    EXPECT_FALSE(fs::exists(path));
}

TEST_F(SavedSceneTest, formsAreToldApart)
{
    const PreparedScene prepared = prepareText(richScene());
    writeSavedScene(prepared, path);
    writeTreeJson(prepared, folder.path / "tree.json");
    writeFileAtomically(folder.path / "spaced.json", std::string("\n { \"sahlTree\" : 1 }"));
    writeFileAtomically(folder.path / "scene.json", richScene());
    EXPECT_EQ(savedFormOf(path), SavedForm::binary);
    EXPECT_EQ(savedFormOf(folder.path / "tree.json"), SavedForm::json);
    EXPECT_EQ(savedFormOf(folder.path / "spaced.json"), SavedForm::json);
    EXPECT_EQ(savedFormOf(folder.path / "scene.json"), SavedForm::none);
    EXPECT_EQ(savedFormOf(folder.path / "missing.json"), SavedForm::none);
    EXPECT_EQ(savedFormOf("bunny.obj"), SavedForm::none);
}

}  // namespace
}  // namespace sahl::testing
