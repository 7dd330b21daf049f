// Machines without a Vulkan loader, driver or layer: "auto" computes on the CPU and says why,
// everything else is a clear error.
#include "support/temporary_folder.h"
#include "util/files.h"

#include <cstdio>
#include <fstream>

#include <sys/wait.h>

namespace sahl::testing {
namespace {

struct Outcome {
    int exitCode = -1;
    std::string text;  // of stdout and stderr
};

/// Runs open_device for `selection` with `environment` ("A=b C=d") added to ours. Leaks of the
/// drivers would change its exit code in builds with AddressSanitizer.
Outcome openDeviceIn(const std::string& environment, const std::string& selection)
{
    std::string command = "env ASAN_OPTIONS=detect_leaks=0 " + environment +
                          " " OPEN_DEVICE_PROGRAM " '" + selection + "' 2>&1";
    Outcome outcome;
    FILE* pipe = popen(command.c_str(), "r");
    if (!pipe) return outcome;
    char buffer[256];
    while (size_t length = fread(buffer, 1, sizeof(buffer), pipe))
        outcome.text.append(buffer, length);
    int status = pclose(pipe);
    if (WIFEXITED(status)) outcome.exitCode = WEXITSTATUS(status);
    return outcome;
}

void expectText(const Outcome& outcome, int exitCode, const std::string& words)
{
    EXPECT_EQ(outcome.exitCode, exitCode) << outcome.text;
    EXPECT_NE(outcome.text.find(words), std::string::npos) << outcome.text;
}

/// No Vulkan at all, for the reason that `words` tell.
void expectNoVulkan(const std::string& environment, const std::string& words)
{
    expectText(openDeviceIn(environment, "cpu"), 0, "cpu: \n");
    expectText(openDeviceIn(environment, "auto"), 0, "cpu: computing on the CPU: " + words);
    for (const char* selection : {"0", "discrete", "software", "llvmpipe"}) {
        Outcome outcome = openDeviceIn(environment, selection);
        expectText(outcome, 5, std::string("--device ") + selection + ": no such device");
        expectText(outcome, 5, words);
    }
}

TEST(DeviceEnvironment, noDriverSelected_isNoVulkan)
{
    expectNoVulkan("VK_LOADER_DRIVERS_SELECT='nope*'", "no Vulkan driver found");
}

TEST(DeviceEnvironment, noManifest_isNoVulkan)
{
    expectNoVulkan("VK_DRIVER_FILES=/nonexistent.json", "no Vulkan driver found");
}

TEST(DeviceEnvironment, manifestOfAMissingLibrary_isNoVulkan)
{
    TemporaryFolder folder;
    fs::path manifest = folder.path / "gone.json";
    writeFileAtomically(manifest, std::string(R"({"file_format_version": "1.0.0",
        "ICD": {"library_path": "/nonexistent/libvulkan_gone.so", "api_version": "1.1.0"}})"));
    expectNoVulkan("VK_DRIVER_FILES=" + manifest.string(), "no Vulkan driver found");
}

TEST(DeviceEnvironment, noLoaderLibrary_isNoVulkan)
{
    TemporaryFolder folder;
    for (const char* name : {"libvulkan.so.1", "libvulkan.so"}) {
        std::ofstream(folder.path /
                      name);  // an empty file stands before the real one and cannot be loaded
    }
    expectNoVulkan("LD_LIBRARY_PATH=" + folder.path.string(), "no Vulkan loader found");
}

TEST(DeviceEnvironment, unknownDevice_isAnErrorWithTheListOfDevices)
{
    for (const char* selection :
         {"99", "4294967296", "-1", "Voodoo", "", "00000000-0000-0000-0000-000000000000"}) {
        Outcome outcome = openDeviceIn("", selection);
        expectText(outcome, 5, "devices here:\n  0  ");
        expectText(outcome, 5, "\n  cpu  ");
    }
}

TEST(DeviceEnvironment, validationLayerMissing_namesItsPackage)
{
    expectText(openDeviceIn("SAHL_VALIDATION=1 VK_LAYER_PATH=/nonexistent", "0"), 5,
               "vulkan-validationlayers");
}

}  // namespace
}  // namespace sahl::testing
