// Every scene of the report's figures: 0 differing bits. Scenes that need a mesh which is not in
// the repository are skipped, by name, where neither SAHL_ASSETS nor tools/fetch_assets has it.

#include "render/verify.h"
#include "support/device_test.h"
#include "support/render_scenes.h"
#include "support/scene_files.h"
#include "support/source_folder.h"

#include <algorithm>
#include <sstream>

namespace sahl::testing {
namespace {

const std::string FETCHED = "../../../.assets/meshes/";  // how these scenes name meshes

/// All scenes of scenes/report, as figNN/name.json.
std::vector<std::string> reportScenes()
{
    const fs::path folder = sourceFolder() / "scenes/report";
    std::vector<std::string> scenes;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.path().extension() == ".json") {
            scenes.push_back(entry.path().lexically_relative(folder).string());
        }
    }
    std::sort(scenes.begin(), scenes.end());
    return scenes;
}

std::string textOf(const fs::path& path)
{
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

/// The file names of fetched meshes that a scene names.
std::vector<std::string> meshesOf(const std::string& text)
{
    std::vector<std::string> meshes;
    for (size_t at = text.find(FETCHED); at != std::string::npos; at = text.find(FETCHED, at + 1)) {
        const size_t name = at + FETCHED.size();
        meshes.push_back(text.substr(name, text.find('"', name) - name));
    }
    return meshes;
}

/// The folder that has all of `meshes`; empty where none has.
fs::path folderWith(const std::vector<std::string>& meshes)
{
    for (const fs::path& folder :
         {assetFolder() / "meshes/miro", sourceFolder() / ".assets/meshes"}) {
        if (std::all_of(meshes.begin(), meshes.end(),
                        [&](auto& mesh) { return fs::exists(folder / mesh); }))
            return folder;
    }
    return {};
}

/// Those that name a mesh that is not in the repository, or those that name none.
std::vector<std::string> scenesThatNeedMeshes(bool theyDo)
{
    std::vector<std::string> scenes = reportScenes();
    std::erase_if(scenes, [&](const std::string& scene) {
        return meshesOf(textOf(sourceFolder() / "scenes/report" / scene)).empty() == theyDo;
    });
    return scenes;
}

/// All on one device: compiling its kernels takes some drivers much longer than rendering.
class VerifyReport : public DeviceTest, public ::testing::WithParamInterface<std::string> {
protected:
    static void SetUpTestSuite() { device = openFirstDevice(); }
    static void TearDownTestSuite() { device.reset(); }

    static void expectNoDifferingBit(const std::string& text, const fs::path& meshes);

    inline static std::unique_ptr<Device> device;
};

void VerifyReport::expectNoDifferingBit(const std::string& text, const fs::path& meshes)
{
    SceneOptions options;
    options.width = options.height = 32;
    const SceneFolder files;
    std::string placed = text;
    for (size_t at; (at = placed.find(FETCHED)) != std::string::npos;) {
        placed.replace(at, FETCHED.size(), fs::canonical(meshes).string() + "/");
    }
    options.allowedPaths = {meshes};
    const uint32_t spp = 2;
    const bool adaptive = text.find("\"adaptive\"") != std::string::npos;
    (adaptive ? options.maxSpp : options.spp) = spp;
    if (adaptive) options.minSpp = 1;
    files.write("scene.json", placed);
    const PreparedScene prepared =
        prepareScene(files.load("scene.json", options), BvhBuild::automatic, 2);
    auto cpu = makeCpuDevice({});
    const DeviceScene scene = prepared.deviceScene();
    const VerifyResult result =
        adaptive ? verifyAdaptive(*device, *cpu, scene, prepared.scene.settings.adaptive, 0,
                                  [](double) {})
                 : verifyDevice(*device, *cpu, scene, spp, 0, [](double) {});
    EXPECT_TRUE(result.equal()) << result.differingPixels << " pixels differ";
    EXPECT_EQ(result.differingFilmBits, 0u);
    const Counters& counters = result.deviceFilm.counters;
    EXPECT_EQ(counters.cameraRays, uint64_t{2} * 32 * 32);
    EXPECT_EQ(counters.badSamples, 0u);
    EXPECT_GT(counters.bounces, counters.cameraRays / 20) << "hardly anything was hit";
}

TEST_P(VerifyReport, hasNoDifferingBit)
{
    expectNoDifferingBit(textOf(sourceFolder() / "scenes/report" / GetParam()), sourceFolder());
}

class VerifyReportMeshes : public VerifyReport {};

TEST_P(VerifyReportMeshes, hasNoDifferingBit)
{
    const std::string text = textOf(sourceFolder() / "scenes/report" / GetParam());
    const fs::path meshes = folderWith(meshesOf(text));
    if (meshes.empty())
        GTEST_SKIP() << GetParam() << " needs " << meshesOf(text).front()
                     << ", which may not be copied into this repository (set SAHL_ASSETS, or "
                        "tools/fetch_assets)";
    expectNoDifferingBit(text, meshes);
}

const auto nameOfScene = [](const auto& tested) {
    std::string name = tested.param.substr(0, tested.param.rfind('.'));
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == '/' || c == '-'; }, '_');
    return name;
};

INSTANTIATE_TEST_SUITE_P(, VerifyReport, ::testing::ValuesIn(scenesThatNeedMeshes(false)),
                         nameOfScene);
INSTANTIATE_TEST_SUITE_P(, VerifyReportMeshes, ::testing::ValuesIn(scenesThatNeedMeshes(true)),
                         nameOfScene);

}  // namespace
}  // namespace sahl::testing
