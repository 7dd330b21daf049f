// The CPU as a device: the text compiled as C++ (host/reference), on all cores.

#include "device/device.h"
#include "reference/render_tile.h"
#include "util/error.h"
#include "util/parallel.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <numeric>

namespace sahl {

namespace {

void refuseFaults(const PixelBlock& block)
{
    if (block.faults == 0) return;
    throw Error(ErrorKind::deviceLost, "the CPU's traversal stack overflowed: the tree is deeper "
                                       "than the builder promises; please report this scene");
}

class CpuAdaptiveTile final : public AdaptiveTile {
public:
    CpuAdaptiveTile(const DeviceScene& scene, const TileRequest& tile, const AdaptiveRule& rule,
                    uint32_t order, unsigned threads, DeviceStatistics& statistics)
        : scene_(scene), tile_(tile), rule_(rule), order_(order), threads_(threads), statistics_(statistics),
          pixels_(size_t{tile.width} * tile.height), active_(pixels_.size())
    {
        std::iota(active_.begin(), active_.end(), 0u);
    }

    AdaptivePass runPass() override
    {
        if (active_.empty()) return {};
        auto start = std::chrono::steady_clock::now();
        reference::foldBlocks(before_, pixels_);
        reference::renderAdaptivePass(scene_, tile_, rule_, order_, threads_, active_, pixels_);
        before_ = active_;
        std::erase_if(active_, [&](uint32_t i) { return pixels_[i].state != PIXEL_ACTIVE; });
        AdaptivePass pass = {static_cast<uint32_t>(active_.size()), 0, 0};
        for (uint32_t i : before_) {
            const PixelBlock& block = pixels_[i].block;
            refuseFaults(block);
            pass.samples += block.samplesDone;
            pass.rays += uint64_t{block.samplesDone} + block.indirectRays + block.shadowRays;
        }
        std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
        statistics_.renderSeconds += seconds.count();
        statistics_.dispatches++;
        return pass;
    }

    void read(std::span<AdaptivePixel> pixels) override { std::ranges::copy(pixels_, pixels.begin()); }

private:
    DeviceScene scene_;
    TileRequest tile_;
    AdaptiveRule rule_;
    uint32_t order_;
    unsigned threads_;
    DeviceStatistics& statistics_;
    std::vector<AdaptivePixel> pixels_;
    std::vector<uint32_t> active_;  // pixels of the next pass
    std::vector<uint32_t> before_;  // of the newest: not yet in the film
};

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
        for (const PixelBlock& block : blocks) refuseFaults(block);
    }

    void renderFirstHits(const TileRequest& tile, std::span<FirstHits> pixels) override
    {
        reference::renderFirstHits(scene_, tile, threads_, pixels);
    }

    std::unique_ptr<AdaptiveTile> beginAdaptive(const TileRequest& tile, const AdaptiveRule& rule) override
    {
        return std::make_unique<CpuAdaptiveTile>(scene_, tile, rule, order_, threads_, statistics_);
    }

    uint32_t maxTilePixels() const override { return 1u << 16; }

    uint64_t maxAdaptivePixels() const override { return std::numeric_limits<uint64_t>::max(); }

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
