// Machines without Vulkan, and people with another locale.
#include "cli/sahl_program.h"

#include <cstdlib>

namespace sahl::testing {
namespace {

class Environment : public SceneFolderTest {};

TEST_F(Environment, withoutADriver_autoComputesOnTheCpuAndSaysSo)
{
    writeText(folder / "gone.driver", R"({"file_format_version": "1.0.0",
        "ICD": {"library_path": "/nonexistent/libvulkan_gone.so", "api_version": "1.1.0"}})");
    writeText(folder / "libvulkan.so.1", "");  // stands before the real one and cannot be loaded
    writeText(folder / "libvulkan.so", "");
    const std::map<std::string, std::optional<std::string>> environments[] = {
        {{"VK_LOADER_DRIVERS_SELECT", "nope*"}},
        {{"VK_DRIVER_FILES", folder / "gone.driver"}},
        {{"VK_DRIVER_FILES", "/nonexistent.json"}},
        {{"LD_LIBRARY_PATH", folder}}};
    for (const auto& environment : environments) {
        RunOptions options = here();
        options.environment = environment;
        RunResult automatic = sahl({"render", "ball.json", "-o", "a.exr"}, options);
        EXPECT_EQ(automatic.exitCode, 0) << automatic.err;
        EXPECT_HAS(automatic.err, "computing on the CPU: no Vulkan ");
        EXPECT_EQ(automatic.out, "a.exr\n");

        RunResult chosen = sahl({"render", "ball.json", "--device", "0"}, options);
        expectRefused(chosen, 5, "--device 0: no such device; devices here:");
        EXPECT_HAS(chosen.err, "\n  cpu  ");

        RunResult list = sahl({"devices", "--json"}, options);
        auto devices = nlohmann::json::parse(list.out);
        EXPECT_EQ(list.exitCode, 0);
        EXPECT_TRUE(devices["vulkan"].empty());
        EXPECT_HAS(devices["noVulkan"].get<std::string>(), "no Vulkan ");
    }
}

TEST_F(Environment, unknownDevice_isRefusedWithTheList)
{
    for (const char* device : {"99", "voodoo", "-1", ""}) {
        RunResult result = sahl({"render", "ball.json", "--device", device}, here());
        EXPECT_EQ(result.exitCode, 5) << result.err;
        EXPECT_HAS(result.err,
                   std::string("--device ") + device + ": no such device; devices here:");
        EXPECT_HAS(result.err, "\n  cpu  this machine's processor\n");
        EXPECT_EQ(files(), std::vector<std::string>{});
    }
}

/// Numbers are written with a comma in German. The locale is compiled here, where that can be done:
/// most machines without people do not have it.
TEST_F(Environment, localeWithDecimalComma_changesNoByte)
{
    Arguments arguments = {"--exposure", "1.5", "--tone-map", "exposure", "-o", "a.exr", "-o", "a.png"};
    ASSERT_EQ(render(arguments).exitCode, 0);
    std::string exr = textOf(folder / "a.exr");
    std::string png = textOf(folder / "a.png");

    std::string compile =
        "localedef -i de_DE -f UTF-8 " + (folder / "de_DE.UTF-8").string() + " 2>&1";
    if (FILE* output = popen((compile + " >/dev/null").c_str(), "r")) pclose(output);
    RunOptions options = here();
    options.environment = {{"LC_ALL", "de_DE.UTF-8"}, {"LOCPATH", folder}};
    RunResult result = render(arguments, options);
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(textOf(folder / "a.exr"), exr);
    EXPECT_EQ(textOf(folder / "a.png"), png);
}

}  // namespace
}  // namespace sahl::testing
