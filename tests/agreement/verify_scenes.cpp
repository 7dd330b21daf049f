// What `sahl verify` checks, on real meshes under real probes: 0 differing bits.

#include "render/verify.h"
#include "support/device_test.h"
#include "support/forwarding_device.h"
#include "support/render_scenes.h"
#include "support/source_folder.h"

namespace sahl::testing {
namespace {

struct Case {
    const char* name;
    const char* mesh;   // in the assets; "" for the default scene
    const char* probe;  // in the assets; "" for the scene's own
    const char* mapping;
};

void PrintTo(const Case& c, std::ostream* out)
{
    *out << c.name;
}

constexpr const char* UFFIZI = "probes/latlong/uffizi.hdr";
constexpr const char* BEACH = "probes/angular/beach_probe.hdr";

const Case CASES[] = {{"default", "", "", "latlong"},
                      {"bunny_uffizi", "meshes/miro/bunny.obj", UFFIZI, "latlong"},
                      {"bunny_beach", "meshes/miro/bunny.obj", BEACH, "angular"},
                      {"sponza_uffizi", "meshes/miro/sponza.obj", UFFIZI, "latlong"},
                      {"sponza_beach", "meshes/miro/sponza.obj", BEACH, "angular"}};

/// Puts Sponza's camera inside: seen from outside, few of its rays bounce.
void moveInside(Scene& scene)
{
    vec3 lo = scene.primitives[0].p0, hi = lo;
    for (const Primitive& t : scene.primitives) {
        for (vec3 p : {t.p0, t.p1, t.p2}) {
            lo = glm::min(lo, p);
            hi = glm::max(hi, p);
        }
    }
    CameraDescription inside;
    inside.eye = glm::mix(lo, hi, vec3(0.2f, 0.2f, 0.5f));
    inside.lookAt = glm::mix(lo, hi, vec3(0.9f, 0.25f, 0.5f));
    inside.fovDeg = 65;
    scene.camera = makeCamera(inside, scene.settings.width, scene.settings.height);
}

class VerifyScenes : public DeviceTest, public ::testing::WithParamInterface<Case> {
protected:
    void expectEqual(uint32_t size, uint32_t spp)
    {
        const Case& c = GetParam();
        SceneOptions options = smallPicture(size, size, spp);
        fs::path path = sourceFolder() / "scenes/default/default.json";
        if (*c.mesh != 0) path = assetFolder() / c.mesh;
        if (*c.probe != 0) {
            options.probe = assetFolder() / c.probe;
            options.probeMapping = c.mapping;
        }
        Scene scene = loadScene(path, options);
        if (std::string(c.name).starts_with("sponza")) moveInside(scene);
        PreparedScene prepared = prepareScene(std::move(scene), BvhBuild::automatic, 2);
        auto device = openFirstDevice();
        auto cpu = makeCpuDevice({});
        VerifyResult result =
            verifyDevice(*device, *cpu, prepared.deviceScene(), spp, 0, [](double) {});
        EXPECT_TRUE(result.equal()) << result.differingPixels << " pixels differ";
        EXPECT_EQ(result.differingFilmBits, 0u);
        EXPECT_EQ(result.deviceFilm.counters.cameraRays, uint64_t{size} * size * spp);
    }
};

TEST_P(VerifyScenes, haveNoDifferingBit)
{
    if (*GetParam().mesh != 0) SAHL_REQUIRE_ASSET(GetParam().mesh);
    if (*GetParam().probe != 0) SAHL_REQUIRE_ASSET(GetParam().probe);
    expectEqual(64, 8);
}

class LongVerifyScenes : public VerifyScenes {};

TEST_P(LongVerifyScenes, haveNoDifferingBitAtFullSize)
{
    if (*GetParam().mesh != 0) SAHL_REQUIRE_ASSET(GetParam().mesh);
    if (*GetParam().probe != 0) SAHL_REQUIRE_ASSET(GetParam().probe);
    expectEqual(256, 32);
}

INSTANTIATE_TEST_SUITE_P(, LongVerifyScenes, ::testing::ValuesIn(CASES),
                         [](const auto& tested) { return std::string(tested.param.name); });
INSTANTIATE_TEST_SUITE_P(, VerifyScenes, ::testing::ValuesIn(CASES),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST_F(DeviceTest, verifyFindsTheFirstPixelSampleAndBounceOfADifference)
{
    // The two devices get scenes that differ in one material, seen first after one bounce at most.
    struct Tampered final : ForwardingDevice {
        std::vector<Material> materials;
        void setScene(const DeviceScene& scene) override
        {
            DeviceScene changed = scene;
            materials.assign(scene.materials.begin(), scene.materials.end());
            for (Material& material : materials) material.baseColor *= 0.5f;
            changed.materials = materials;
            inner->setScene(changed);
        }
    };
    PreparedScene prepared =
        prepareScene(builtInScene(smallPicture(48, 32, 8)), BvhBuild::sweep, 2);
    Tampered tampered;
    tampered.inner = makeCpuDevice({});
    auto cpu = makeCpuDevice({});
    VerifyResult result = verifyDevice(tampered, *cpu, prepared.deviceScene(), 8, 0, [](double) {});
    ASSERT_TRUE(result.first.has_value());
    EXPECT_FALSE(result.equal());
    EXPECT_GT(result.differingFilmBits, 0u);
    // Albedo counts from the first scattering on, and does not change where paths go.
    EXPECT_EQ(result.first->bounce, 1u);
    EXPECT_EQ(result.first->stage, "light");
    EXPECT_NE(result.first->device.sum, result.first->reference.sum);
    EXPECT_EQ(result.first->device.digest, result.first->reference.digest);
}

}  // namespace
}  // namespace sahl::testing
