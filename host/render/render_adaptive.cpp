#include "render/render_adaptive.h"

#include "util/interrupt.h"
#include "util/memory.h"

#include <algorithm>
#include <chrono>

namespace sahl {

namespace {

struct TileInWork {
    TileRequest request;  // within the plan's window
    std::unique_ptr<AdaptiveTile> tile;
    uint32_t active = 0;  // pixels
    uint32_t passes = 0;
};

/// How many of the tiles from `first` on can be in work together: one at least.
size_t batchSize(std::span<const TileRequest> tiles, size_t first, uint64_t maxPixels)
{
    uint64_t pixels = 0;
    size_t end = first;
    while (end < tiles.size()) {
        pixels += uint64_t{tiles[end].width} * tiles[end].height;
        if (pixels > maxPixels && end > first) break;
        end++;
    }
    return end - first;
}

using PassDone = std::function<void(const std::function<RenderResult()>&)>;

class AdaptiveRender {
public:
    AdaptiveRender(Device& device, const RenderPlan& plan, const AdaptiveRule& rule,
                   const std::function<void(const RenderProgress&)>& report,
                   const PassDone& passDone)
        : device_(device),
          plan_(plan),
          rule_(rule),
          report_(report),
          passDone_(passDone),
          result_{Film(plan.width, plan.height), 0, false, 0}
    {
        result_.adaptive.pixels = uint64_t{plan.width} * plan.height;
        samplesMissing_ = double(result_.adaptive.pixels) * rule.maxSamples;
    }

    RenderResult run()
    {
        std::vector<TileRequest> all =
            tilesOf(plan_.width, plan_.height, plan_.tileSize, device_.maxTilePixels());
        std::span<const TileRequest> tiles = all;
        // Software devices take the host's memory, others a copy of theirs there.
        uint64_t maxPixels =
            std::min(device_.maxAdaptivePixels(), availableMemory() / 2 / sizeof(AdaptivePixel));
        for (size_t first = 0; first < tiles.size() && !result_.interrupted;) {
            size_t count = batchSize(tiles, first, maxPixels);
            renderTogether(tiles.subspan(first, count));
            first += count;
        }
        result_.seconds = secondsSoFar();
        return std::move(result_);
    }

private:
    void renderTogether(std::span<const TileRequest> requests)
    {
        std::vector<TileInWork> tiles;
        for (const TileRequest& request : requests) {
            tiles.push_back({request, device_.beginAdaptive(inFullPicture(request, plan_), rule_),
                             request.width * request.height, 0});
        }
        uint32_t passes = 0;
        auto isActive = [](const TileInWork& tile) { return tile.active > 0; };
        while (std::ranges::any_of(tiles, isActive) && runPass(tiles)) {
            passes++;
            progress_.samplesDone = std::min(passes * BLOCK_SIZE, rule_.maxSamples);
            if (passDone_) passDone_([&] { return resultWith(tiles, passes); });
        }
        result_ = resultWith(tiles, passes);
    }

    /// What there was before and what the tiles had after `passes` passes.
    RenderResult resultWith(std::span<const TileInWork> tiles, uint32_t passes) const
    {
        RenderResult result = result_;
        for (const TileInWork& tile : tiles) addTile(tile, passes, result);
        result.passes = std::max(result.passes, passes);
        result.seconds = secondsSoFar();
        return result;
    }

    /// One pass of every tile that has active pixels; false when a signal came before its end.
    bool runPass(std::vector<TileInWork>& tiles)
    {
        for (TileInWork& work : tiles) {
            if (work.active == 0) continue;
            if (interruptSignal() != 0) {
                result_.interrupted = true;
                return false;
            }
            uint32_t before = work.active;
            AdaptivePass pass = work.tile->runPass();
            work.active = pass.activePixels;
            work.passes++;
            reportPass(work, before, pass);
        }
        return true;
    }

    void reportPass(const TileInWork& work, uint32_t activeBefore, const AdaptivePass& pass)
    {
        double left = double(rule_.maxSamples) - double(work.passes) * BLOCK_SIZE;
        samplesMissing_ -=
            double(activeBefore) * std::min(left + BLOCK_SIZE, double(rule_.maxSamples));
        samplesMissing_ += double(work.active) * std::max(left, 0.0);
        samplesDone_ += double(pass.samples);
        progress_.fraction = samplesDone_ / (samplesDone_ + samplesMissing_);
        progress_.rays += pass.rays;
        progress_.seconds = secondsSoFar();
        report_(progress_);
    }

    /// An interrupted first pass keeps its finished tiles.
    static void addTile(const TileInWork& work, uint32_t passes, RenderResult& result)
    {
        const TileRequest& at = work.request;
        std::vector<AdaptivePixel> pixels(size_t{at.width} * at.height);
        work.tile->read(pixels);
        bool withNewest = work.passes <= passes || passes == 0;
        for (const AdaptivePixel& pixel : pixels) {
            if (!withNewest && pixel.block.samplesDone > 0) continue;
            result.adaptive.converged += pixel.state == PIXEL_CONVERGED ? 1 : 0;
            result.adaptive.atMaximum += pixel.state == PIXEL_AT_MAXIMUM ? 1 : 0;
        }
        result.film.add(at.x, at.y, at.width, at.height, pixels, withNewest);
    }

    double secondsSoFar() const
    {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

    Device& device_;
    RenderPlan plan_;
    AdaptiveRule rule_;
    const std::function<void(const RenderProgress&)>& report_;
    const PassDone& passDone_;
    RenderResult result_;  // of the tiles that are finished
    RenderProgress progress_;
    double samplesDone_ = 0;
    double samplesMissing_ = 0;  // at most
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

RenderResult renderAdaptive(
    Device& device, const RenderPlan& plan, const AdaptiveRule& rule,
    const std::function<void(const RenderProgress&)>& report,
    const std::function<void(const std::function<RenderResult()>&)>& passDone)
{
    return AdaptiveRender(device, plan, rule, report, passDone).run();
}

}  // namespace sahl
