// The CPU as a device: the text compiled as C++ (host/reference), on all cores.

#include "device/device.h"
#include "reference/render_tile.h"
#include "util/error.h"
#include "util/parallel.h"

#include <chrono>

namespace sahl {

namespace {

class CpuDevice final : public Device {
public:
    explicit CpuDevice(const DeviceOptions& options)
        : threads_(options.threads != 0 ? options.threads : defaultThreadCount()),
          order_(options.traversalOrder)
    {
    }

    DeviceInfo info() const override
    {
        return {fmt::format("CPU, {} thread{}", threads_, threads_ == 1 ? "" : "s"),
                reference::compilerName(), "cpu"};
    }

    void setScene(const DeviceScene& scene) override
    {
        scene_ = scene;
        statistics_.sceneBytes = scene.nodes.size_bytes() + scene.primitives.size_bytes() +
                                 scene.triangleNormals.size_bytes() + scene.materials.size_bytes() +
                                 scene.lights.size_bytes() + scene.probeTexels.size_bytes() +
                                 scene.instances.size_bytes();
    }

    void render(const TileRequest& tile, std::span<PixelBlock> blocks) override
    {
        auto start = std::chrono::steady_clock::now();
        reference::renderTile(scene_, tile, order_, threads_, blocks);
        std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
        statistics_.renderSeconds += seconds.count();
        statistics_.dispatches++;
        for (const PixelBlock& block : blocks) {
            if (block.faults != 0) {
                throw Error(ErrorKind::deviceLost, "the CPU's traversal stack overflowed: the tree is deeper "
                                                   "than the builder promises; please report this scene");
            }
        }
    }

    void renderFirstHits(const TileRequest& tile, std::span<FirstHits> pixels) override
    {
        reference::renderFirstHits(scene_, tile, threads_, pixels);
    }

    uint32_t maxTilePixels() const override { return 1u << 16; }

    DeviceStatistics statistics() const override { return statistics_; }

private:
    unsigned threads_;
    uint32_t order_;
    DeviceScene scene_;
    DeviceStatistics statistics_;
};

}  // namespace

std::unique_ptr<Device> makeCpuDevice(const DeviceOptions& options)
{
    return std::make_unique<CpuDevice>(options);
}

}  // namespace sahl
