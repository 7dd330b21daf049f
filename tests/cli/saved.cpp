// sahl bvh, and scenes that it saved.
#include "cli/sahl_program.h"

namespace sahl::testing {
namespace {

class SavedFiles : public SceneFolderTest {
protected:
    RunResult run(const Arguments& arguments) const { return sahl(arguments, here()); }

    /// The picture of a scene on the CPU as the bytes of a PFM.
    std::string pictureOf(const std::string& scene, const Arguments& more = {}) const
    {
        Arguments arguments = {"render", scene, "--device", "cpu", "-o", "picture.pfm"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const RunResult result = run(arguments);
        EXPECT_EQ(result.exitCode, 0) << result.err;
        return textOf(folder / "picture.pfm");
    }
};

TEST_F(SavedFiles, bvh_tellsAboutTheTreeAndWritesNothing)
{
    const RunResult result = run({"bvh", "ball.json"});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_HAS(result.out, "scene      ball.json, 320 primitives");
    EXPECT_HAS(result.out, " inner nodes, ");
    EXPECT_HAS(result.out, "SAH cost   ");
    EXPECT_HAS(result.out, "memory     ");
    EXPECT_EQ(result.err, "");
    EXPECT_EQ(files(), std::vector<std::string>{});
}

TEST_F(SavedFiles, bvh_statisticsAreThoseOfRender)
{
    ASSERT_EQ(run({"bvh", "ball.json", "--stats", "bvh.json", "-q"}).out, "");
    ASSERT_EQ(render({"-o", "a.pfm", "--stats", "render.json"}).exitCode, 0);
    const auto bvh = nlohmann::json::parse(textOf(folder / "bvh.json"));
    const auto rendered = nlohmann::json::parse(textOf(folder / "render.json"));
    EXPECT_EQ(bvh["tree"], rendered["tree"]);
    EXPECT_EQ(bvh["scene"]["primitives"], 320);
    EXPECT_GT(bvh["bytes"]["total"], 320 * 48);
    EXPECT_GE(bvh["seconds"]["build"], 0);
}

TEST_F(SavedFiles, savedScenesRenderToTheSamePicture)
{
    const RunResult saving = run({"bvh", "ball.json", "-o", "ball.sahl", "--json", "tree.json"});
    ASSERT_EQ(saving.exitCode, 0) << saving.err;
    EXPECT_HAS(saving.out, "wrote      ball.sahl\nwrote      tree.json\n");
    const std::string picture = pictureOf("ball.json");
    fs::remove(folder / "ball.json");
    EXPECT_EQ(pictureOf("ball.sahl"), picture);
    EXPECT_EQ(pictureOf("tree.json"), picture);
    EXPECT_NE(pictureOf("ball.sahl", {"--seed", "5"}), picture);
}

TEST_F(SavedFiles, savedScenesWithInstancesRenderToTheSamePicture)
{
    writeText(folder / "crowd.json", R"({"camera": {"eye": [0, 2, 6], "lookAt": [0, 0, 0]},
        "film": {"width": 16, "height": 12}, "integrator": {"samplesPerPixel": 2},
        "groups": {"ball": {"shapes": [{"type": "sphereMesh", "level": 1}]},
                   "pair": {"shapes": [{"type": "instance", "of": "ball"},
                                       {"type": "instance", "of": "ball", "transform": {"scale": 0.5,
                                        "translate": [2, 0, 0]}}]}},
        "shapes": [{"type": "instance", "of": "pair"},
                   {"type": "instance", "of": "pair", "transform": {"scale": [1, -1, 1],
                    "translate": [0, 1, -2]}}],
        "environment": {"builtin": "studio"}})");
    const RunResult saving = run({"bvh", "crowd.json", "-o", "crowd.sahl", "--json", "tree.json"});
    ASSERT_EQ(saving.exitCode, 0) << saving.err;
    ASSERT_EQ(run({"bvh", "tree.json", "-o", "again.sahl"}).exitCode, 0);
    const std::string picture = pictureOf("crowd.json");
    EXPECT_EQ(pictureOf("crowd.sahl"), picture);
    EXPECT_EQ(pictureOf("tree.json"), picture);
    EXPECT_EQ(pictureOf("again.sahl"), picture);
}

TEST_F(SavedFiles, savedScenes_takeTheOptionsOfThePicture)
{
    const Arguments options = {"--width", "20", "--height",      "9",
                               "--spp",   "3",  "--max-bounces", "1"};
    ASSERT_EQ(run({"bvh", "ball.json", "-o", "ball.sahl"}).exitCode, 0);
    EXPECT_EQ(pictureOf("ball.sahl", options), pictureOf("ball.json", options));
}

TEST_F(SavedFiles, savedScenes_areVerifiedAndSavedAgain)
{
    ASSERT_EQ(run({"bvh", "ball.json", "-o", "ball.sahl", "--json", "a.json"}).exitCode, 0);
    const RunResult verified = run({"verify", "ball.sahl", "--device", "cpu"});
    EXPECT_EQ(verified.exitCode, 0) << verified.err;
    EXPECT_HAS(verified.out, "EQUAL      0 differing bits");
    ASSERT_EQ(run({"bvh", "ball.sahl", "-o", "again.sahl", "--json", "b.json"}).exitCode, 0);
    EXPECT_EQ(textOf(folder / "again.sahl"), textOf(folder / "ball.sahl"));
    EXPECT_EQ(textOf(folder / "a.json"), textOf(folder / "b.json"));
    EXPECT_EQ(run({"bvh", "a.json"}).exitCode, 0);
}

TEST_F(SavedFiles, savedScenes_knowTheQualityOfTheirTrees)
{
    ASSERT_EQ(run({"bvh", "ball.json", "--bvh-quality", "high", "-o", "ball.sahl"}).exitCode, 0);
    EXPECT_HAS(run({"bvh", "ball.sahl"}).out, "built by reinsertion");
}

TEST_F(SavedFiles, savedScenes_refuseOptionsThatNeedTheOriginal)
{
    ASSERT_EQ(run({"bvh", "ball.json", "-o", "ball.sahl"}).exitCode, 0);
    for (const Arguments& option : {Arguments{"--bvh-build", "sweep"},
                                    {"--bvh-quality", "high"},
                                    {"--smooth-normals"},
                                    {"--probe-mapping", "angular"}}) {
        Arguments arguments = {"render", "ball.sahl", "--device", "cpu", "-o", "a.pfm"};
        arguments.insert(arguments.end(), option.begin(), option.end());
        expectRefused(run(arguments), 2, option[0]);
    }
}

TEST_F(SavedFiles, damagedFilesAreRefusedByName)
{
    ASSERT_EQ(run({"bvh", "ball.json", "-o", "ball.sahl", "--json", "tree.json"}).exitCode, 0);
    const std::string saved = textOf(folder / "ball.sahl"), tree = textOf(folder / "tree.json");
    writeText(folder / "cut.sahl", saved.substr(0, saved.size() / 2));
    std::string altered = saved;
    altered[altered.size() / 2] ^= 1;
    writeText(folder / "altered.sahl", altered);
    writeText(folder / "picture.sahl", "P6");
    writeText(folder / "cut.json", tree.substr(0, tree.size() / 2));
    for (const char* command : {"render", "verify", "bvh"}) {
        auto withFile = [&](const std::string& name) {
            Arguments arguments = {command, name};
            if (command != std::string("bvh"))
                arguments.insert(arguments.end(), {"--device", "cpu"});
            return run(arguments);
        };
        expectRefused(withFile("cut.sahl"), 3, "cut.sahl: section 'header': the file has");
        expectRefused(withFile("altered.sahl"), 3, "altered.sahl: section '");
        expectRefused(withFile("picture.sahl"), 3, "picture.sahl: is not a saved scene");
        expectRefused(withFile("cut.json"), 3, "cut.json:");
        expectRefused(withFile("missing.sahl"), 3, "missing.sahl: cannot read");
    }
}

TEST_F(SavedFiles, outputsAreCheckedBeforeAnythingIsRead)
{
    expectRefused(run({"bvh", "ball.json", "-o", "ball.bin"}), 2, "must end in .sahl");
    expectRefused(run({"bvh", "ball.json", "--json", "tree.txt"}), 2, "must end in .json");
    expectRefused(run({"bvh", "ball.json", "-o", "none/ball.sahl"}), 4, "none/ball.sahl");
    expectRefused(run({"bvh", "ball.json", "--json", "a.json", "--stats", "a.json"}), 2,
                  "a.json: is written twice");
    expectRefused(run({"bvh", "ball.json", "--json", "ball.json"}), 2, "is an input");
    EXPECT_EQ(files(), std::vector<std::string>{});
    ASSERT_EQ(run({"bvh", "ball.json", "-o", "ball.sahl"}).exitCode, 0);
    expectRefused(run({"bvh", "ball.sahl", "-o", "ball.sahl"}), 2, "is an input");
    EXPECT_EQ(run({"bvh", "ball.sahl"}).exitCode, 0);
}

}  // namespace
}  // namespace sahl::testing
