// The phong integrator on devices and on the reference: the same bits whatever is added up, and
// however often a path is suspended between its lights.

#include "shared/bindings.h"
#include "support/device_test.h"
#include "support/render_scenes.h"
#include "support/source_folder.h"

namespace sahl::testing {
namespace {

class PhongBits : public DeviceTest {
protected:
    static Scene load(uint32_t width, uint32_t height, uint32_t spp)
    {
        const fs::path path = sourceFolder() / "tests/scenes/phong.json";
        return loadScene(path, smallPicture(width, height, spp));
    }

    static const PreparedScene& scene()
    {
        static const PreparedScene prepared = prepareScene(load(32, 24, 9), BvhBuild::automatic, 2);
        return prepared;
    }

    static const Film& reference()
    {
        static const Film film = renderFilm(*makeCpuDevice({}), scene());
        return film;
    }
};

TEST_F(PhongBits, onTheDeviceAndTheReference)
{
    const Counters& counters = reference().counters;
    EXPECT_TRUE(renderFilm(*openFirstDevice(), scene()) == reference());
    EXPECT_GT(counters.shadowRays, counters.cameraRays);
    EXPECT_EQ(counters.indirectRays, 0u);
    EXPECT_EQ(counters.badSamples, 0u);
}

TEST_F(PhongBits, whenPathsRunOutOfStepsAndGoOn)
{
    DeviceOptions options;
    options.stepBudget = 5;
    auto device = openFirstDevice(options);
    EXPECT_TRUE(renderFilm(*device, scene()) == reference());
    EXPECT_GT(device->statistics().resumptions, 0u);
}

TEST_F(PhongBits, withExactDivisionAndRoot)
{
    DeviceOptions options;
    options.math = DeviceOptions::Math::exact;
    EXPECT_TRUE(renderFilm(*openFirstDevice(options), scene()) == reference());
}

TEST_F(PhongBits, throughStorageBuffers)
{
    DeviceOptions options;
    options.buffers = DeviceOptions::Buffers::storage;
    EXPECT_TRUE(renderFilm(*openFirstDevice(options), scene()) == reference());
}

TEST_F(PhongBits, ofEveryChoiceOfTermsShadowsAndNormals)
{
    auto device = openFirstDevice();
    auto cpu = makeCpuDevice({});
    Scene small = load(16, 12, 1);
    std::vector<Film> films;
    for (uint32_t shading = 0; shading < 2 * SHADING_FLAT; shading++) {
        Scene changed = small;
        changed.settings.shading = shading;
        const PreparedScene prepared = prepareScene(std::move(changed), BvhBuild::sweep, 2);
        films.push_back(renderFilm(*cpu, prepared));
        EXPECT_TRUE(renderFilm(*device, prepared) == films.back()) << shading;
        EXPECT_EQ(films.back().counters.shadowRays > 0,
                  (shading & SHADING_SHADOWS) != 0 &&
                      (shading & (SHADING_DIFFUSE | SHADING_SPECULAR)) != 0);
    }
    // Each bit shows in the picture, the last two where the light of a lamp is added up.
    const uint32_t all = SHADING_TERMS | SHADING_SHADOWS | SHADING_FLAT;
    for (uint32_t bit = 1; bit <= SHADING_FLAT; bit *= 2) {
        EXPECT_FALSE(films[all].half[0] == films[all & ~bit].half[0]) << bit;
    }
}

TEST_F(PhongBits, underMoreLightsThanADriverLoops)
{
    // Some drivers end every loop after 65,535 iterations: the lights of one sample are more.
    Scene crowded = load(2, 2, 1);
    const Light lamp = crowded.lights.front();
    crowded.lights.assign(70000, lamp);
    for (size_t i = 0; i < crowded.lights.size(); i++) {
        crowded.lights[i].intensity = vec3(float(1 + i % 7) * 1e-4f);
    }
    crowded.settings.shading = SHADING_DIFFUSE;
    const PreparedScene prepared = prepareScene(std::move(crowded), BvhBuild::sweep, 2);
    const Film film = renderFilm(*makeCpuDevice({}), prepared);
    EXPECT_TRUE(renderFilm(*openFirstDevice(), prepared) == film);
    EXPECT_EQ(film.counters.badSamples, 0u);
}

}  // namespace
}  // namespace sahl::testing
