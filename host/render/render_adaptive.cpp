#include "render/render_adaptive.h"

#include "util/interrupt.h"
#include "util/memory.h"

#include <algorithm>
#include <chrono>

namespace sahl {

namespace {

struct TileInWork {
    TileRequest request;
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

class AdaptiveRender {
public:
    AdaptiveRender(Device& device, const RenderPlan& plan, const AdaptiveRule& rule,
                   const std::function<void(const RenderProgress&)>& report)
        : device_(device),
          rule_(rule),
          report_(report),
          result_{{Film(plan.width, plan.height), 0, false, 0}, {}}
    {
        result_.outcome.pixels = uint64_t{plan.width} * plan.height;
        samplesMissing_ = double(result_.outcome.pixels) * rule.maxSamples;
    }

    AdaptiveResult run(std::span<const TileRequest> tiles)
    {
        // Software devices take the host's memory, others a copy of theirs there.
        uint64_t maxPixels =
            std::min(device_.maxAdaptivePixels(), availableMemory() / 2 / sizeof(AdaptivePixel));
        for (size_t first = 0; first < tiles.size() && !result_.render.interrupted;) {
            size_t count = batchSize(tiles, first, maxPixels);
            renderTogether(tiles.subspan(first, count));
            first += count;
        }
        result_.render.seconds = secondsSoFar();
        return std::move(result_);
    }

private:
    void renderTogether(std::span<const TileRequest> requests)
    {
        std::vector<TileInWork> tiles;
        for (const TileRequest& request : requests) {
            tiles.push_back({request, device_.beginAdaptive(request, rule_),
                             request.width * request.height, 0});
        }
        uint32_t passes = 0;
        auto isActive = [](const TileInWork& tile) { return tile.active > 0; };
        while (std::ranges::any_of(tiles, isActive) && runPass(tiles)) {
            passes++;
            progress_.samplesDone = std::min(passes * BLOCK_SIZE, rule_.maxSamples);
        }
        for (const TileInWork& tile : tiles) addToFilm(tile, passes);
        result_.render.passes = std::max(result_.render.passes, passes);
    }

    /// One pass of every tile that has active pixels; false when a signal came before its end.
    bool runPass(std::vector<TileInWork>& tiles)
    {
        for (TileInWork& work : tiles) {
            if (work.active == 0) continue;
            if (interruptSignal() != 0) {
                result_.render.interrupted = true;
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

    /// Adds what a tile had after `passes` passes. An interrupted first pass keeps its finished
    /// tiles.
    void addToFilm(const TileInWork& work, uint32_t passes)
    {
        const TileRequest& request = work.request;
        std::vector<AdaptivePixel> pixels(size_t{request.width} * request.height);
        work.tile->read(pixels);
        bool withNewest = work.passes <= passes || passes == 0;
        for (const AdaptivePixel& pixel : pixels) {
            if (!withNewest && pixel.block.samplesDone > 0) continue;
            result_.outcome.converged += pixel.state == PIXEL_CONVERGED ? 1 : 0;
            result_.outcome.atMaximum += pixel.state == PIXEL_AT_MAXIMUM ? 1 : 0;
        }
        result_.render.film.add(request.x, request.y, request.width, request.height, pixels,
                                withNewest);
    }

    double secondsSoFar() const
    {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

    Device& device_;
    AdaptiveRule rule_;
    const std::function<void(const RenderProgress&)>& report_;
    AdaptiveResult result_;
    RenderProgress progress_;
    double samplesDone_ = 0;
    double samplesMissing_ = 0;  // at most
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

AdaptiveResult renderAdaptive(Device& device, const RenderPlan& plan, const AdaptiveRule& rule,
                              const std::function<void(const RenderProgress&)>& report)
{
    std::vector<TileRequest> tiles =
        tilesOf(plan.width, plan.height, plan.tileSize, device.maxTilePixels());
    return AdaptiveRender(device, plan, rule, report).run(tiles);
}

}  // namespace sahl
