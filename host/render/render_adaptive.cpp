#include "render/render_adaptive.h"

#include "device/adaptive_schedule.h"
#include "film/replicates.h"
#include "render/adaptive_passes.h"
#include "util/error.h"
#include "util/interrupt.h"
#include "util/memory.h"

#include <algorithm>
#include <chrono>

namespace sahl {

namespace {

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
        result_.film.halvesWeighEqually = rule.rule == ADAPTIVE_CROSSED;
        result_.film.replicateSize = replicateSizeOf(device.samplerKind());
        samplesMissing_ = double(result_.adaptive.pixels) * rule.maxSamples;
    }

    RenderResult run()
    {
        std::vector<TileRequest> all =
            tilesOf(plan_.width, plan_.height, plan_.tileSize, device_.maxTilePixels());
        for (TileRequest& tile : all) tile = inFullPicture(tile, plan_);
        std::span<const TileRequest> tiles = all;
        // Software devices take the host's memory, others a copy of theirs there.
        constexpr uint64_t PER_PIXEL = sizeof(AdaptivePixel) + sizeof(PixelEstimate);
        uint64_t maxPixels = std::min(device_.maxAdaptivePixels(), availableMemory() / 2 / PER_PIXEL);
        for (size_t first = 0; first < tiles.size() && !result_.interrupted;) {
            size_t count = batchSize(tiles, first, maxPixels);
            if (count < tiles.size()) requireNoneTogether(maxPixels);
            renderTogether(tiles.subspan(first, count));
            first += count;
        }
        result_.seconds = secondsSoFar();
        return std::move(result_);
    }

private:
    /// Some rules, and a limit in time, need all pixels at once.
    void requireNoneTogether(uint64_t maxPixels) const
    {
        const bool neighbours = looksAtNeighbours(rule_);
        if (!neighbours && plan_.timeLimit <= 0) return;
        throw Error(ErrorKind::deviceLost,
                    fmt::format("{} keeps all {} pixels of the picture at work, and '{}' has room for {} "
                                "of them; render it in parts with --crop, or a smaller one",
                                neighbours ? "a rule that looks at neighbours" : "--time-limit",
                                result_.adaptive.pixels, device_.info().name, maxPixels));
    }

    void renderTogether(std::span<const TileRequest> tiles)
    {
        const AdaptiveWindow window = {plan_.left, plan_.top, plan_.width, plan_.height};
        AdaptivePasses work(device_, window, tiles, rule_);
        while (!work.isFinished() && runPass(work)) {
            progress_.samplesDone = std::min(work.passes() * BLOCK_SIZE, rule_.maxSamples);
            if (work.isFinished()) break;
            result_.stoppedBy = stopsAfter(plan_, work.passes(), secondsSoFar());
            if (result_.stoppedBy != StoppedBy::nothing) break;
            if (passDone_) passDone_([&] { return resultWith(work); });
        }
        result_ = resultWith(work);
    }

    /// What there was before and what the tiles have after their whole passes.
    RenderResult resultWith(const AdaptivePasses& work) const
    {
        RenderResult result = result_;
        for (const TileInWork& tile : work.tiles()) addTile(tile, work.passes(), result);
        result.passes = std::max(result.passes, work.passes());
        result.seconds = secondsSoFar();
        return result;
    }

    /// False when a signal came before the end of the pass.
    bool runPass(AdaptivePasses& work)
    {
        auto mayGoOn = [&] { return !(result_.interrupted = interruptSignal() != 0); };
        return work.runPass(mayGoOn, [&](const TileInWork& tile, uint32_t before, const AdaptivePass& pass) {
            reportPass(tile, before, pass);
        });
    }

    /// Where halves go apart a pixel is active in each, with half of the samples.
    double samplesLeft(uint32_t active, uint32_t passes) const
    {
        const double left = std::max(double(rule_.maxSamples) - double(passes) * BLOCK_SIZE, 0.0);
        return double(active) * left / (halvesGoApart(rule_, passes) ? 2 : 1);
    }

    void reportPass(const TileInWork& work, uint32_t activeBefore, const AdaptivePass& pass)
    {
        samplesMissing_ -= samplesLeft(activeBefore, work.passes - 1);
        samplesMissing_ += samplesLeft(work.active, work.passes);
        samplesDone_ += double(pass.samples);
        progress_.fraction = std::min(samplesDone_ / (samplesDone_ + std::max(samplesMissing_, 0.0)), 1.0);
        progress_.rays += pass.rays;
        progress_.seconds = secondsSoFar();
        report_(progress_);
    }

    /// An interrupted first pass keeps its finished tiles.
    void addTile(const TileInWork& work, uint32_t passes, RenderResult& result) const
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
        result.film.add(at.x - plan_.left, at.y - plan_.top, at.width, at.height, pixels, withNewest);
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
