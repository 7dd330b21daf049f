#include "render/render.h"

#include "film/film_error.h"
#include "film/replicates.h"
#include "util/interrupt.h"
#include "util/parallel.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <future>
#include <optional>

namespace sahl {

namespace {

/// A rendered tile that waits for its pass to be complete.
struct FinishedTile {
    TileRequest tile;
    ZeroedVector<PixelBlock> blocks;
};

using Pass = std::vector<FinishedTile>;

/// Adds passes to a film; behind the back of who renders the next one, where that is done elsewhere than on the
/// host's cores.
class FilmAdder {
public:
    FilmAdder(Film& film, unsigned threads, bool meanwhile) : film_(film), threads_(threads), meanwhile_(meanwhile) {}

    /// The film gets all tiles of `pass`, which is left as one to be used anew.
    void add(Pass& pass)
    {
        if (!meanwhile_) return addAll(pass);
        wait();
        std::swap(pass, underWay_);
        adding_ = std::async(std::launch::async, [this] { addAll(underWay_); });
    }

    /// Until the film has all that was added.
    void wait()
    {
        if (adding_.valid()) adding_.get();
    }

private:
    void addAll(const Pass& pass)
    {
        for (const FinishedTile& done : pass) {
            const TileRequest& tile = done.tile;
            film_.add(tile.x, tile.y, tile.width, tile.height, tile.firstSample, done.blocks, threads_);
        }
    }

    Film& film_;
    unsigned threads_;
    bool meanwhile_;
    Pass underWay_;
    std::future<void> adding_;
};

uint64_t raysIn(std::span<const PixelBlock> blocks, unsigned threads)
{
    constexpr size_t CHUNK = 1 << 14;
    std::atomic<uint64_t> rays = 0;
    parallelFor((blocks.size() + CHUNK - 1) / CHUNK, threads, [&](size_t chunk) {
        uint64_t inChunk = 0;
        const size_t first = chunk * CHUNK;
        for (const PixelBlock& block : blocks.subspan(first, std::min(CHUNK, blocks.size() - first)))
            inChunk += uint64_t{block.samplesDone} + block.indirectRays + block.shadowRays;
        rays += inChunk;
    });
    return rays;
}

}  // namespace

StoppedBy stopsAfter(const RenderPlan& plan, uint32_t passes, double seconds)
{
    if (plan.maxPasses > 0 && passes >= plan.maxPasses) return StoppedBy::passes;
    return plan.timeLimit > 0 && seconds >= plan.timeLimit ? StoppedBy::time : StoppedBy::nothing;
}

TileRequest inFullPicture(TileRequest tile, const RenderPlan& plan)
{
    tile.x += plan.left;
    tile.y += plan.top;
    return tile;
}

std::vector<TileRequest> tilesOf(uint32_t width, uint32_t height, uint32_t tileSize, uint32_t maxPixels)
{
    uint32_t side = 1;
    while ((side + 1) * (side + 1) <= maxPixels && side < 65536) side++;
    if (tileSize != 0) side = std::min(side, tileSize);
    uint32_t tileWidth = side;
    uint32_t tileHeight = side;
    if (tileSize == 0 && uint64_t{width} * height <= maxPixels) {
        tileWidth = width;
        tileHeight = height;
    }
    std::vector<TileRequest> tiles;
    for (uint32_t y = 0; y < height; y += tileHeight) {
        for (uint32_t x = 0; x < width; x += tileWidth) {
            tiles.push_back({x, y, std::min(tileWidth, width - x), std::min(tileHeight, height - y), 0, 0});
        }
    }
    return tiles;
}

namespace {

/// What follows tile i of a pass, in that pass or the next one.
std::optional<TileRequest> tileAfter(const TileRequest& tile, std::span<const TileRequest> tiles, size_t i,
                                     const RenderPlan& plan)
{
    const bool inThisPass = i + 1 < tiles.size();
    const uint32_t first = inThisPass ? tile.firstSample : tile.firstSample + BLOCK_SIZE;
    const uint32_t done = first - plan.firstSample;
    if (done >= plan.sampleCount) return {};
    TileRequest next = tiles[inThisPass ? i + 1 : 0];
    next.firstSample = first;
    next.sampleCount = std::min(BLOCK_SIZE, plan.sampleCount - done);
    return next;
}

}  // namespace

RenderResult renderPicture(Device& device, const RenderPlan& plan,
                           const std::function<void(const RenderProgress&)>& report,
                           const std::function<void(const RenderResult&)>& passDone)
{
    auto start = std::chrono::steady_clock::now();
    auto secondsSoFar = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };

    RenderResult result = {Film(plan.width, plan.height), 0, false, 0};
    result.film.replicateSize = replicateSizeOf(device.samplerKind());
    const std::string kind = device.info().kind;
    FilmAdder adder(result.film, plan.threads, kind != "cpu" && kind != "software");
    RenderProgress progress;
    double allSamples = double(plan.width) * plan.height * plan.sampleCount;
    double samplesDone = 0;
    std::vector<TileRequest> tiles = tilesOf(plan.width, plan.height, plan.tileSize, device.maxTilePixels());
    Pass pass;
    std::optional<RenderResult> whole;  // the last one that ended with a replicate
    for (uint32_t done = 0; done < plan.sampleCount && !result.interrupted;) {
        uint32_t count = std::min(BLOCK_SIZE, plan.sampleCount - done);
        pass.resize(tiles.size());
        for (size_t i = 0; i < tiles.size(); i++) {
            if (interruptSignal() != 0) {
                result.interrupted = true;
                pass.resize(i);
                break;
            }
            pass[i].tile = tiles[i];
            pass[i].tile.firstSample = plan.firstSample + done;
            pass[i].tile.sampleCount = count;
            pass[i].blocks.resize(size_t{tiles[i].width} * tiles[i].height);
            if (const std::optional<TileRequest> next = tileAfter(pass[i].tile, tiles, i, plan))
                device.expectTile(inFullPicture(*next, plan));
            device.render(inFullPicture(pass[i].tile, plan), pass[i].blocks);

            progress.rays += raysIn(pass[i].blocks, plan.threads);
            samplesDone += double(pass[i].blocks.size()) * count;
            progress.fraction = samplesDone / allSamples;
            progress.seconds = secondsSoFar();
            report(progress);
        }
        if (result.interrupted && result.passes > 0) break;
        adder.add(pass);
        if (result.interrupted) break;
        done += count;
        result.passes++;
        result.endsInReplicate = done % result.film.replicateSize != 0 && done < plan.sampleCount;
        if (plan.wholeReplicates && result.film.replicateSize > BLOCK_SIZE && !result.endsInReplicate) {
            adder.wait();
            whole = result;
        }
        progress.samplesDone = done;
        progress.relativeError = [&adder, &result, error = std::optional<double>()]() mutable {
            adder.wait();
            if (!error) error = relativeError(result.film);
            return *error;
        };
        result.seconds = secondsSoFar();
        if (done >= plan.sampleCount) break;
        result.stoppedBy = stopsAfter(plan, result.passes, result.seconds);
        if (result.stoppedBy != StoppedBy::nothing) break;
        if (passDone) {
            adder.wait();
            passDone(result);
        }
    }
    adder.wait();
    if (whole && result.endsInReplicate) {
        result.film = std::move(whole->film);
        result.passes = whole->passes;
        result.endsInReplicate = false;
    }
    result.seconds = secondsSoFar();
    return result;
}

std::vector<FirstHits> renderFirstHits(Device& device, const RenderPlan& plan, uint32_t samples)
{
    const uint32_t width = plan.width, height = plan.height;
    std::vector<FirstHits> picture(size_t{width} * height);
    for (TileRequest tile : tilesOf(width, height, 0, device.maxTilePixels())) {
        tile.sampleCount = samples;
        std::vector<FirstHits> pixels(size_t{tile.width} * tile.height);
        device.renderFirstHits(inFullPicture(tile, plan), pixels);
        for (uint32_t row = 0; row < tile.height; row++) {
            std::copy_n(pixels.begin() + row * tile.width, tile.width,
                        picture.begin() + (tile.y + row) * width + tile.x);
        }
    }
    return picture;
}

}  // namespace sahl
