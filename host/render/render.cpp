#include "render/render.h"

#include "film/film_error.h"
#include "util/interrupt.h"

#include <algorithm>
#include <chrono>

namespace sahl {

namespace {

uint64_t raysOf(const Counters& counters)
{
    return counters.cameraRays + counters.indirectRays + counters.shadowRays;
}

/// A rendered tile that waits for its pass to be complete.
struct FinishedTile {
    TileRequest tile;
    std::vector<PixelBlock> blocks;
};

void addToFilm(const std::vector<FinishedTile>& tiles, Film& film)
{
    for (const FinishedTile& done : tiles) {
        film.add(done.tile.x, done.tile.y, done.tile.width, done.tile.height, done.tile.firstSample,
                 done.blocks);
    }
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

RenderResult renderPicture(Device& device, const RenderPlan& plan,
                           const std::function<void(const RenderProgress&)>& report,
                           const std::function<void(const RenderResult&)>& passDone)
{
    auto start = std::chrono::steady_clock::now();
    auto secondsSoFar = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };

    RenderResult result = {Film(plan.width, plan.height), 0, false, 0};
    result.film.varianceOverBlocks = device.samplerKind() == SAMPLER_SOBOL;
    RenderProgress progress;
    double allSamples = double(plan.width) * plan.height * plan.sampleCount;
    double samplesDone = 0;
    std::vector<TileRequest> tiles = tilesOf(plan.width, plan.height, plan.tileSize, device.maxTilePixels());
    for (uint32_t done = 0; done < plan.sampleCount && !result.interrupted;) {
        uint32_t count = std::min(BLOCK_SIZE, plan.sampleCount - done);
        std::vector<FinishedTile> pass;
        for (TileRequest tile : tiles) {
            if (interruptSignal() != 0) {
                result.interrupted = true;
                break;
            }
            tile.firstSample = plan.firstSample + done;
            tile.sampleCount = count;
            pass.push_back({tile, std::vector<PixelBlock>(size_t{tile.width} * tile.height)});
            device.render(inFullPicture(tile, plan), pass.back().blocks);

            for (const PixelBlock& block : pass.back().blocks) {
                progress.rays += uint64_t{block.samplesDone} + block.indirectRays + block.shadowRays;
            }
            samplesDone += double(tile.width) * tile.height * count;
            progress.fraction = samplesDone / allSamples;
            progress.seconds = secondsSoFar();
            report(progress);
        }
        if (result.interrupted && result.passes > 0) break;
        addToFilm(pass, result.film);
        if (result.interrupted) break;
        done += count;
        result.passes++;
        progress.samplesDone = done;
        progress.rays = raysOf(result.film.counters);
        progress.relativeError = relativeError(result.film);
        result.seconds = secondsSoFar();
        if (done >= plan.sampleCount) break;
        result.stoppedBy = stopsAfter(plan, result.passes, result.seconds);
        if (result.stoppedBy != StoppedBy::nothing) break;
        if (passDone) passDone(result);
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
