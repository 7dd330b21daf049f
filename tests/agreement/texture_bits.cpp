// A scene of textures, normal maps, holes and a lamp with a picture, on devices: the bits are those
// of the CPU.
#include "shared/bindings.h"
#include "support/device_test.h"
#include "support/render_scenes.h"
#include "support/texture_scenes.h"

namespace sahl::testing {
namespace {

class TextureBits : public DeviceTest {
protected:
    static const PreparedScene& scene()
    {
        static const PreparedScene prepared =
            prepareScene(leavesScene(40, 24, 4), BvhBuild::sweep, 1);
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

TEST_F(TextureBits, areEqual)
{
    expectReference({});
}

// Every pipeline takes seconds to compile, so the rest is not for every day.
class LongTextureBits : public TextureBits {};

TEST_F(LongTextureBits, areEqualThroughStorageBuffersAndTexelBuffers)
{
    DeviceOptions options;
    options.buffers = DeviceOptions::Buffers::storage;
    expectReference(options);
    options.buffers = DeviceOptions::Buffers::texel;
    expectReference(options);
}

TEST_F(LongTextureBits, areEqualWithExactMath)
{
    DeviceOptions options;
    options.math = DeviceOptions::Math::exact;
    expectReference(options);
}

TEST_F(LongTextureBits, areEqualInAnotherOrderOfTraversal)
{
    DeviceOptions options;
    options.traversalOrder = ORDER_RIGHT_FIRST;
    const Film cpu = renderFilm(*makeCpuDevice(options), scene());
    EXPECT_EQ(cpu.digest, reference().digest);
    EXPECT_TRUE(renderFilm(*openFirstDevice(options), scene()) == cpu);
}

/// One device: a scene without textures, this one, the same without holes, and first hits.
TEST_F(LongTextureBits, areEqualAfterOtherScenes_andOfFirstHits)
{
    auto device = openFirstDevice();
    const PreparedScene plain =
        prepareScene(builtInScene(smallPicture(40, 24, 4)), BvhBuild::sweep, 1);
    EXPECT_TRUE(renderFilm(*device, plain) == renderFilm(*makeCpuDevice({}), plain));
    EXPECT_TRUE(renderFilm(*device, scene()) == reference());

    const TileRequest tile = {0, 0, 40, 24, 0, BLOCK_SIZE};
    std::vector<FirstHits> expected(40 * 24), found(40 * 24);
    auto cpu = makeCpuDevice({});
    cpu->setScene(scene().deviceScene());
    cpu->renderFirstHits(tile, expected);
    device->renderFirstHits(tile, found);
    EXPECT_EQ(std::memcmp(found.data(), expected.data(), found.size() * sizeof(FirstHits)), 0);

    Scene closed = leavesScene(40, 24, 4);
    for (Material& material : closed.materials) material.alphaCutoff = 0;
    const PreparedScene whole = prepareScene(std::move(closed), BvhBuild::sweep, 1);
    EXPECT_TRUE(renderFilm(*device, whole) == renderFilm(*makeCpuDevice({}), whole));
}

}  // namespace
}  // namespace sahl::testing
