// What `sahl verify` checks, on one small scene for each feature and on the showcase: 0 differing
// bits.

#include "image/image.h"
#include "render/verify.h"
#include "support/device_test.h"
#include "support/gltf_room.h"
#include "support/render_scenes.h"
#include "support/scene_files.h"
#include "support/source_folder.h"

namespace sahl::testing {
namespace {

fs::path testFolder()
{
    return sourceFolder() / "tests";
}

/// Colours that differ from texel to texel, as a picture of an angular map.
void writeAngularMap(const fs::path& path)
{
    constexpr uint32_t SIZE = 16;
    Image image = {SIZE, SIZE, {}};
    for (uint32_t y = 0; y < SIZE; y++) {
        for (uint32_t x = 0; x < SIZE; x++) {
            const float right = static_cast<float>(x) / SIZE, down = static_cast<float>(y) / SIZE;
            const float stripe = (x + y) % 5 == 0 ? 2.0f : 0.0f;
            image.rgb.insert(image.rgb.end(),
                             {0.2f + 2 * right + stripe, 0.3f + down, 1.5f - right + stripe});
        }
    }
    writeFileAtomically(path, encodePfm(image));
}

class VerifyFeatures : public DeviceTest {
protected:
    /// Compares a device with the reference and says whether the picture shows anything.
    static void expectEqual(Device& device, Scene scene)
    {
        const RenderSettings settings = scene.settings;
        const PreparedScene prepared = prepareScene(std::move(scene), BvhBuild::automatic, 2);
        auto cpu = makeCpuDevice({});
        const VerifyResult result =
            verifyDevice(device, *cpu, prepared.deviceScene(), settings.spp, 0, [](double) {});
        EXPECT_TRUE(result.equal()) << result.differingPixels << " pixels differ";
        EXPECT_EQ(result.differingFilmBits, 0u);
        const Counters& counters = result.deviceFilm.counters;
        EXPECT_EQ(counters.cameraRays, uint64_t{settings.width} * settings.height * settings.spp);
        const bool phong = settings.integrator == INTEGRATOR_PHONG;
        EXPECT_GT(phong ? counters.shadowRays : counters.indirectRays, counters.cameraRays / 4)
            << "hardly anything was hit";
        EXPECT_EQ(counters.badSamples, 0u);
    }

    static std::unique_ptr<Device> openWith(DeviceOptions::Math math)
    {
        DeviceOptions options;
        options.math = math;
        return openFirstDevice(options);
    }
};

/// Scenes of tests/scenes, one for each feature. All on one device: compiling its kernels takes
/// some drivers much longer than rendering.
class VerifySmallScenes : public VerifyFeatures, public ::testing::WithParamInterface<const char*> {
protected:
    static void SetUpTestSuite() { device = openWith(DeviceOptions::Math::automatic); }
    static void TearDownTestSuite() { device.reset(); }

    inline static std::unique_ptr<Device> device;

    static Scene load()
    {
        const SceneFolder files;
        writeAngularMap(files.folder.path / "angular.pfm");
        files.write("room.glb", gltfRoom());
        const std::string name = std::string(GetParam()) + ".json";
        fs::copy_file(testFolder() / "scenes" / name, files.folder.path / name);
        return files.load(name);
    }
};

class LongVerifySmallScenes : public VerifySmallScenes {
protected:
    static void SetUpTestSuite() { device = openWith(DeviceOptions::Math::exact); }
};

TEST_P(VerifySmallScenes, haveNoDifferingBit)
{
    expectEqual(*device, load());
}

TEST_P(LongVerifySmallScenes, haveNoDifferingBitInExactMath)
{
    expectEqual(*device, load());
}

constexpr const char* SMALL_SCENES[] = {
    "mirror", "dielectric",  "conductor",  "report_material", "sphere",  "lens",  "orthographic",
    "spot",   "directional", "background", "emission",        "angular", "phong", "instances", "gltf",
    "rough_conductor", "rough_dielectric", "layers"};

const auto nameOfScene = [](const auto& tested) { return std::string(tested.param); };

INSTANTIATE_TEST_SUITE_P(, VerifySmallScenes, ::testing::ValuesIn(SMALL_SCENES), nameOfScene);
INSTANTIATE_TEST_SUITE_P(, LongVerifySmallScenes, ::testing::ValuesIn(SMALL_SCENES), nameOfScene);

Scene showcase()
{
    SceneOptions options;
    options.width = 160;
    options.height = 90;
    options.spp = 8;
    return loadScene(testFolder() / "../scenes/showcase/showcase.json", options);
}

TEST_F(VerifyFeatures, showcaseHasNoDifferingBit)
{
    expectEqual(*openWith(DeviceOptions::Math::automatic), showcase());
}

class LongVerifyFeatures : public VerifyFeatures {};

TEST_F(LongVerifyFeatures, showcaseHasNoDifferingBitInExactMath)
{
    expectEqual(*openWith(DeviceOptions::Math::exact), showcase());
}

}  // namespace
}  // namespace sahl::testing
