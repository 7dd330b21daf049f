// Kernels are compiled when they are first used and not again: lavapipe of Mesa 22 did it for every
// command buffer (shaders/kernels/uniforms.glsl), which is seconds each where nothing keeps what it
// made.

#include "support/adaptive_scenes.h"
#include "support/device_test.h"
#include "support/render_scenes.h"

#include <fstream>
#include <functional>
#include <sstream>

namespace sahl::testing {
namespace {

/// Bytes of code in this process: drivers that compile for the processor put theirs there.
uint64_t bytesOfCode()
{
    uint64_t bytes = 0;
    std::ifstream maps("/proc/self/maps");
    for (std::string line; std::getline(maps, line);) {
        uint64_t begin = 0, end = 0;
        char dash = 0;
        std::string permissions;
        std::istringstream(line) >> std::hex >> begin >> dash >> end >> permissions;
        if (permissions.find('x') != std::string::npos) bytes += end - begin;
    }
    return bytes;
}

class CompiledOnce : public DeviceTest {
protected:
    static const PreparedScene& scene()
    {
        static const PreparedScene prepared =
            prepareScene(builtInScene(smallPicture(24, 16, 16)), BvhBuild::sweep, 2);
        return prepared;
    }

    /// Work of several command buffers makes all its code the first time.
    static void expectNoNewCode(const std::function<void()>& work)
    {
        work();
        const uint64_t before = bytesOfCode();
        for (int i = 0; i < 8; i++) work();
        EXPECT_EQ(bytesOfCode(), before);
    }
};

TEST_F(CompiledOnce, isTheKernelOfWholePaths)
{
    const auto device = openFirstDevice();
    device->setScene(scene().deviceScene());
    expectNoNewCode([&] {
        for (const TileRequest& tile :
             {TileRequest{0, 0, 16, 16, 0, 8}, TileRequest{16, 0, 8, 16, 8, 5}}) {
            std::vector<PixelBlock> blocks(size_t{tile.width} * tile.height);
            device->render(tile, blocks);
        }
    });
}

TEST_F(CompiledOnce, areTheKernelsOfWaves)
{
    DeviceOptions options;
    options.variant = "storage-wave-shared";
    const auto device = openFirstDevice(options);
    device->setScene(scene().deviceScene());
    expectNoNewCode([&] {
        std::vector<PixelBlock> blocks(24 * 16);
        device->render({0, 0, 24, 16, 0, 3}, blocks);
    });
}

TEST_F(CompiledOnce, areTheKernelsOfAdaptiveSampling)
{
    const auto device = openFirstDevice();
    expectNoNewCode([&] { renderAdaptiveFilm(*device, scene(), reportRule(0.02f, 5, 24), 16); });
}

TEST_F(CompiledOnce, isTheKernelOfSingleRays)
{
    const auto device = openFirstDevice();
    device->setScene(scene().deviceScene());
    std::vector<TraceRay> rays(100);
    for (TraceRay& ray : rays) ray = {vec3(0, 1, 4), 1e30f, vec3(0, 0, -1), 0};
    std::vector<TraceHit> hits(rays.size());
    expectNoNewCode([&] {
        for (bool any : {false, true}) device->traceRays(rays, any, hits);
    });
}

}  // namespace
}  // namespace sahl::testing
