// Scenes that cannot be read, and outputs that would destroy what was read.
#include "cli/sahl_program.h"

#include <sys/stat.h>

#if defined(__SANITIZE_ADDRESS__)
#define SAHL_ADDRESS_SANITIZER
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SAHL_ADDRESS_SANITIZER
#endif
#endif

namespace sahl::testing {
namespace {

class Inputs : public SceneFolderTest {
protected:
    RunResult renderScene(const std::string& scene, Arguments more = {}) const
    {
        RunOptions options = here();
        options.obeysPermissions = true;
        options.timeLimit = 10;
        Arguments arguments = {"render", scene, "--device", "cpu"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return sahl(arguments, options);
    }
};

TEST_F(Inputs, scenesThatAreNoFile_areRefusedAtOnce)
{
    fs::create_directory(folder / "folder.json");
    ASSERT_EQ(::mkfifo((folder / "pipe.json").c_str(), 0666), 0);
    fs::create_symlink("/dev/zero", folder / "zero.json");
    fs::create_symlink("loop.json", folder / "loop.json");
    writeText(folder / "secret.json", ballScene());
    fs::permissions(folder / "secret.json", fs::perms::none);

    expectRefused(renderScene("missing.json"), 3, "missing.json: cannot read: No such file");
    expectRefused(renderScene("folder.json"), 3, "folder.json: is a directory, not a file");
    expectRefused(renderScene("pipe.json"), 3, "pipe.json: is not a regular file");
    expectRefused(renderScene("zero.json"), 3, "zero.json: is not a regular file");
    expectRefused(renderScene("loop.json"), 3, "loop.json: cannot read: Too many levels");
    expectRefused(renderScene("secret.json"), 3, "secret.json: cannot read: Permission denied");
    expectRefused(renderScene("/dev/zero"), 3, "/dev/zero: is not a regular file");
    expectRefused(renderScene("."), 3, ".: is a directory");
}

TEST_F(Inputs, emptyAndForeignScenes_areRefusedAtOnce)
{
    writeText(folder / "empty.json", "");
    writeText(folder / "empty.obj", "");
    writeText(folder / "scene.xml", "<scene/>");
    expectRefused(renderScene("empty.json"), 3, "empty.json");
    expectRefused(renderScene("empty.obj"), 3, "empty.obj");
    expectRefused(renderScene("scene.xml"), 3, "scene.xml: \".xml\" files are not read; use .json");
    EXPECT_EQ(files(), (std::vector<std::string>{"empty.json", "empty.obj", "scene.xml"}));
}

TEST_F(Inputs, brokenScene_namesFileLineAndColumn)
{
    writeText(folder / "broken.json", "{\n  \"shapes\": [\n    { \"type\": \"teepot\" }\n  ]\n}\n");
    RunResult result = renderScene("broken.json");
    expectRefused(result, 3, "broken.json:3:");
    EXPECT_HAS(result.err, "teapot");
}

TEST_F(Inputs, onePixel_isAPicture)
{
    RunResult result = renderScene("ball.json", {"--width", "1", "--height", "1", "-o", "a.pfm"});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(textOf(folder / "a.pfm").size(), std::string("PF\n1 1\n-1.0\n").size() + 12);
}

TEST_F(Inputs, pictureOfTooManyPixels_isRefusedWithNumbers)
{
    expectRefused(
        renderScene("ball.json", {"--width", "32768", "--height", "8193"}), 3,
        "32768 x 8193 pixels; each side must be 1 to 32768, the product at most 268435456");
    writeText(folder / "huge.json", ballScene(65536, 65536));
    expectRefused(renderScene("huge.json"), 3, "32768");
    EXPECT_EQ(files(), (std::vector<std::string>{"huge.json"}));
}

#ifndef SAHL_ADDRESS_SANITIZER  // which needs a large address space for itself
TEST_F(Inputs, pictureBeyondTheMemory_isRefusedWithNumbers)
{
    RunOptions options = here();
    options.addressSpace = uint64_t{1} << 30;
    RunResult result = render({"--width", "4096", "--height", "4096"}, options);
    expectRefused(result, 6, "a picture of 4096 x 4096 pixels needs ");
    EXPECT_HAS(result.err, " GiB of memory, 1.0 GiB are available; render a smaller one");
    EXPECT_EQ(files(), std::vector<std::string>{});
}
#endif

class KeptInputs : public Inputs {
protected:
    /// Refused, naming the file, which stays as it was.
    void expectKept(const std::string& name, const Arguments& arguments) const
    {
        std::string before = textOf(folder / name);
        RunResult result = sahl(arguments, here());
        expectRefused(result, 2, "is an input; writing it would destroy it");
        EXPECT_HAS(result.err, name);
        EXPECT_EQ(textOf(folder / name), before);
    }
};

TEST_F(KeptInputs, scene_isNotReplacedByStatistics)
{
    expectKept("ball.json", {"render", "ball.json", "--device", "cpu", "--stats", "ball.json"});
    expectKept("ball.json", {"render", "ball.json", "--device", "cpu", "--stats",
                             "../" + folder.filename().string() + "/ball.json"});
}

TEST_F(KeptInputs, probeOfTheCommandLine_isNotReplaced)
{
    ASSERT_EQ(render({"-o", "sky.exr"}).exitCode, 0);
    expectKept("sky.exr",
               {"render", "ball.json", "--device", "cpu", "--probe", "sky.exr", "-o", "sky.exr"});
    expectKept("sky.exr", {"verify", "ball.json", "--device", "cpu", "--probe", "sky.exr",
                           "--difference", "./sky.exr"});
}

TEST_F(KeptInputs, probeOfTheScene_isNotReplacedByTheDefaultOutput)
{
    ASSERT_EQ(render({"-o", "sky.exr"}).exitCode, 0);
    auto scene = nlohmann::json::parse(ballScene());
    scene["environment"] = {{"file", "sky.exr"}};
    writeText(folder / "sky.json", scene.dump());
    expectKept("sky.exr", {"render", "sky.json", "--device", "cpu"});
}

TEST_F(KeptInputs, mesh_isNotReplaced)
{
    writeText(folder / "mesh.exr", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    auto scene = nlohmann::json::parse(ballScene());
    scene["shapes"] = {{{"type", "mesh"}, {"file", "mesh.obj"}}};
    writeText(folder / "scene.json", scene.dump());
    fs::create_symlink("mesh.exr", folder / "mesh.obj");
    expectKept("mesh.exr", {"render", "scene.json", "--device", "cpu", "-o", "mesh.exr"});
}

TEST_F(KeptInputs, pictureAndStatistics_needTwoFiles)
{
    expectRefused(render({"-o", "a.exr", "--stats", "a.exr"}), 2,
                  "a.exr: is a picture to write; name another file for --stats");
}

}  // namespace
}  // namespace sahl::testing
