// A scene of instances on devices: whatever else changes, no bit of the film does.
#include "shared/bindings.h"
#include "support/device_test.h"
#include "support/render_scenes.h"
#include "support/source_folder.h"

namespace sahl::testing {
namespace {

class InstanceBits : public DeviceTest {
protected:
    static const PreparedScene& scene()
    {
        static const PreparedScene prepared = [] {
            SceneOptions options = smallPicture(40, 24, 4);
            const fs::path path = sourceFolder() / "tests/scenes/instances.json";
            return prepareScene(loadScene(path, options), BvhBuild::sweep, 1);
        }();
        return prepared;
    }

    static const Film& reference()
    {
        static const Film film = renderFilm(*makeCpuDevice({}), scene());
        return film;
    }

    static void expectReference(const DeviceOptions& options)
    {
        EXPECT_TRUE(renderFilm(*openFirstDevice(options), scene()) == reference());
    }
};

TEST_F(InstanceBits, areEqualThroughStorageBuffersAndTexelBuffers)
{
    DeviceOptions options;
    options.buffers = DeviceOptions::Buffers::storage;
    expectReference(options);
    options.buffers = DeviceOptions::Buffers::texel;
    expectReference(options);
}

/// With 9 steps at a time nearly every path stops inside some instance, often in the step into it.
TEST_F(InstanceBits, areEqualWhenPathsStopInsideInstances)
{
    for (uint32_t steps : {9u, 61u}) {
        DeviceOptions options;
        options.stepBudget = steps;
        auto device = openFirstDevice(options);
        EXPECT_TRUE(renderFilm(*device, scene()) == reference()) << steps;
        EXPECT_GT(device->statistics().resumptions, 0u);
    }
}

TEST_F(InstanceBits, areEqualWithExactMath)
{
    DeviceOptions options;
    options.math = DeviceOptions::Math::exact;
    expectReference(options);
}

TEST_F(InstanceBits, areEqualInEveryOrderOfTraversal)
{
    for (uint32_t order : {ORDER_LEFT_FIRST, ORDER_RIGHT_FIRST}) {
        DeviceOptions options;
        options.traversalOrder = order;
        const Film cpu = renderFilm(*makeCpuDevice(options), scene());
        EXPECT_TRUE(cpu.half[0] == reference().half[0]);
        EXPECT_TRUE(cpu.half[1] == reference().half[1]);
        EXPECT_EQ(cpu.digest, reference().digest);
        EXPECT_TRUE(renderFilm(*openFirstDevice(options), scene()) == cpu);
    }
}

TEST_F(InstanceBits, ofFirstHitsAreEqual)
{
    const TileRequest tile = {0, 0, 40, 24, 0, BLOCK_SIZE};
    std::vector<FirstHits> expected(40 * 24), found(40 * 24);
    auto cpu = makeCpuDevice({});
    cpu->setScene(scene().deviceScene());
    cpu->renderFirstHits(tile, expected);
    auto device = openFirstDevice();
    device->setScene(scene().deviceScene());
    device->renderFirstHits(tile, found);
    EXPECT_EQ(std::memcmp(found.data(), expected.data(), found.size() * sizeof(FirstHits)), 0);
}

/// A device takes a scene with instances after one without, and the other way round.
TEST_F(InstanceBits, areEqualAfterAnotherScene)
{
    const PreparedScene plain =
        prepareScene(builtInScene(smallPicture(40, 24, 4)), BvhBuild::sweep, 1);
    const Film expected = renderFilm(*makeCpuDevice({}), plain);
    auto device = openFirstDevice();
    EXPECT_TRUE(renderFilm(*device, plain) == expected);
    EXPECT_TRUE(renderFilm(*device, scene()) == reference());
    EXPECT_TRUE(renderFilm(*device, plain) == expected);
}

}  // namespace
}  // namespace sahl::testing
