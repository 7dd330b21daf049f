// The CPU as a device: the text compiled as C++ (host/reference), on all cores.

#include "device/adaptive_schedule.h"
#include "device/device.h"
#include "device/walked_tree.h"
#include "reference/render_tile.h"
#include "util/error.h"
#include "util/parallel.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <numeric>
#include <utility>

namespace sahl {

namespace {

void refuseFaults(uint32_t faults)
{
    if (faults == 0) return;
    throw Error(ErrorKind::deviceLost, "the CPU's traversal stack overflowed: the tree is deeper "
                                       "than the builder promises; please report this scene");
}

/// What the tiles of a picture under adaptive sampling share.
struct CpuAdaptiveShared {
    DeviceScene scene;
    AdaptiveWindow window;
    AdaptiveRule rule;
    reference::Walk walk;
    unsigned threads;
    DeviceStatistics& statistics;
    std::vector<PixelEstimate> estimates;  // of the window, for rules that look at neighbours
};

class CpuAdaptiveTile final : public AdaptiveTile {
public:
    CpuAdaptiveTile(CpuAdaptiveShared& shared, const TileRequest& tile)
        : shared_(shared),
          tile_(tile),
          pixels_(size_t{tile.width} * tile.height),
          active_(pixels_.size())
    {
        std::iota(active_.begin(), active_.end(), 0u);
    }

    AdaptivePass runPass() override
    {
        if (active_.empty() && activeAfter_.empty()) return {};
        auto start = std::chrono::steady_clock::now();
        reference::foldBlocks(before_, pixels_);
        reference::renderAdaptivePass(shared_.scene, tile_, shared_.rule, passes_, shared_.walk,
                                      shared_.threads, active_, pixels_);
        before_ = std::move(active_);
        advance();
        passes_++;
        AdaptivePass pass = {activePixels(), 0, 0};
        for (uint32_t i : before_) {
            const PixelBlock& block = pixels_[i].block;
            refuseFaults(block.faults);
            pass.samples += block.samplesDone;
            pass.rays += uint64_t{block.samplesDone} + block.indirectRays + block.shadowRays;
        }
        std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
        shared_.statistics.renderSeconds += seconds.count();
        shared_.statistics.dispatches++;
        return pass;
    }

    uint32_t decide(const AdaptiveFloors& floors) override
    {
        const AdaptiveRule& rule = shared_.rule;
        reference::decidePixels(rule, floors, passes_, view(), before_, pixels_);
        if (rule.rule == ADAPTIVE_CROSSED) {
            active_ = reference::takersOf(rule, passes_, pixels_);
            activeAfter_ = reference::takersOf(rule, passes_ + 1, pixels_);
        } else {
            dropFinished();
        }
        return activePixels();
    }

    void read(std::span<AdaptivePixel> pixels) override { std::ranges::copy(pixels_, pixels.begin()); }

private:
    /// The queue of the next pass, after pass `passes_` over `before_`.
    void advance()
    {
        if (halvesGoApart(shared_.rule, passes_)) {
            active_ = std::exchange(activeAfter_,
                                    reference::advanceHalves(shared_.rule, passes_, before_, pixels_));
            return;
        }
        active_ = before_;
        dropFinished();
        if (decisionIsDue(shared_.rule, passes_ + 1))
            reference::estimatePixels(shared_.rule, view(), before_, pixels_);
    }

    void dropFinished()
    {
        std::erase_if(active_, [&](uint32_t i) { return pixels_[i].state != PIXEL_ACTIVE; });
    }

    uint32_t activePixels() const { return static_cast<uint32_t>(active_.size() + activeAfter_.size()); }

    reference::EstimatesView view()
    {
        const AdaptiveWindow& window = shared_.window;
        return {shared_.estimates, window.width, tile_.x - window.left, tile_.y - window.top, tile_.width};
    }

    CpuAdaptiveShared& shared_;
    TileRequest tile_;
    std::vector<AdaptivePixel> pixels_;
    std::vector<uint32_t> active_;       // pixels of the next pass
    std::vector<uint32_t> activeAfter_;  // of the pass after it, where halves go apart
    std::vector<uint32_t> before_;       // of the newest: not yet in the film
    uint32_t passes_ = 0;
};

class CpuAdaptivePicture final : public AdaptivePicture {
public:
    explicit CpuAdaptivePicture(CpuAdaptiveShared shared) : shared_(std::move(shared))
    {
        if (!looksAtNeighbours(shared_.rule)) return;
        shared_.estimates.resize(size_t{shared_.window.width} * shared_.window.height);
    }

    std::unique_ptr<AdaptiveTile> beginTile(const TileRequest& tile) override
    {
        return std::make_unique<CpuAdaptiveTile>(shared_, tile);
    }

    void readEstimates(std::span<PixelEstimate> estimates) override
    {
        std::ranges::copy(shared_.estimates, estimates.begin());
    }

private:
    CpuAdaptiveShared shared_;
};

class CpuDevice final : public Device {
public:
    explicit CpuDevice(const DeviceOptions& options)
        : threads_(options.threads != 0 ? options.threads : defaultThreadCount()),
          walk_{options.traversalOrder, 2},
          wantedWidth_(options.nodeWidth)
    {
    }

    DeviceInfo info() const override
    {
        return {fmt::format("CPU, {} thread{}", threads_, threads_ == 1 ? "" : "s"),
                reference::compilerName(), "cpu"};
    }

    void setScene(const DeviceScene& scene) override
    {
        walk_.nodeWidth = walkFormFor(scene, wantedWidth_, false).nodeWidth;
        scene_ = walkedScene(scene, walk_.nodeWidth);
        statistics_.sceneBytes = (walk_.nodeWidth == 4 ? scene.wide.nodes.size_bytes() : scene.nodes.size_bytes()) + scene.primitives.size_bytes() +
                                 scene.triangleCorners.size_bytes() + scene.materials.size_bytes() +
                                 scene.lights.size_bytes() + scene.probeTexels.size_bytes() +
                                 scene.instances.size_bytes() + scene.textures.size_bytes() +
                                 scene.textureTexels.size_bytes();
    }

    void render(const TileRequest& tile, std::span<PixelBlock> blocks) override
    {
        auto start = std::chrono::steady_clock::now();
        reference::renderTile(scene_, tile, walk_, threads_, blocks);
        std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
        statistics_.renderSeconds += seconds.count();
        statistics_.dispatches++;
        for (const PixelBlock& block : blocks) refuseFaults(block.faults);
    }

    void renderFirstHits(const TileRequest& tile, std::span<FirstHits> pixels) override
    {
        reference::renderFirstHits(scene_, tile, walk_, threads_, pixels);
    }

    double traceRays(std::span<const TraceRay> rays, bool anyHit, std::span<TraceHit> hits) override
    {
        auto start = std::chrono::steady_clock::now();
        reference::traceRays(scene_, rays, anyHit, walk_, threads_, hits);
        std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
        statistics_.dispatches++;
        for (const TraceHit& hit : hits) refuseFaults(hit.faults);
        return seconds.count();
    }

    std::unique_ptr<AdaptivePicture> beginAdaptive(const AdaptiveWindow& window,
                                                   const AdaptiveRule& rule) override
    {
        return std::make_unique<CpuAdaptivePicture>(
            CpuAdaptiveShared{scene_, window, rule, walk_, threads_, statistics_, {}});
    }

    uint32_t samplerKind() const override { return scene_.frame.samplerKind; }

    uint32_t maxTilePixels() const override { return 1u << 16; }

    uint64_t maxAdaptivePixels() const override { return std::numeric_limits<uint64_t>::max(); }

    DeviceStatistics statistics() const override { return statistics_; }

private:
    unsigned threads_;
    reference::Walk walk_;
    uint32_t wantedWidth_;
    DeviceScene scene_;
    DeviceStatistics statistics_;
};

}  // namespace

std::unique_ptr<Device> makeCpuDevice(const DeviceOptions& options)
{
    return std::make_unique<CpuDevice>(options);
}

}  // namespace sahl
