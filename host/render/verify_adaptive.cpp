// A device against the reference under adaptive sampling: every sum, every count, every decision.

#include "device/adaptive_schedule.h"
#include "film/replicates.h"
#include "render/adaptive_passes.h"
#include "render/render.h"
#include "render/verify.h"
#include "util/interrupt.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstring>
#include <tuple>

namespace sahl {

namespace {

/// The same but for queues, whose order is free.
bool sameBits(const AdaptivePixel& a, const AdaptivePixel& b)
{
    return std::memcmp(&a, &b, offsetof(AdaptivePixel, queue)) == 0;
}

uint32_t samplesOf(const AdaptivePixel& pixel)
{
    return pixel.film.samplesA + pixel.film.samplesB + pixel.block.samplesDone;
}

/// Some tiles on one device, to their end.
struct Side {
    Device& device;
    double& seconds;
    Film& film;
    std::vector<std::vector<AdaptivePixel>> pixels = {};  // of each tile
    bool interrupted = false;

    void render(const AdaptiveWindow& window, std::span<const TileRequest> tiles, const AdaptiveRule& rule)
    {
        auto start = std::chrono::steady_clock::now();
        AdaptivePasses work(device, window, tiles, rule);
        auto mayGoOn = [&] { return !(interrupted = interruptSignal() != 0); };
        while (!work.isFinished() && work.runPass(mayGoOn, [](auto&&...) {})) continue;
        pixels.clear();
        for (const TileInWork& done : work.tiles()) {
            const TileRequest& at = done.request;
            pixels.emplace_back(size_t{at.width} * at.height);
            done.tile->read(pixels.back());
            film.add(at.x, at.y, at.width, at.height, pixels.back(), true);
        }
        seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
};

/// The pixel where devices part first, and the fewer of the samples that they took of it.
struct FirstPixel {
    uint32_t x = 0, y = 0;
    uint32_t samples = 0;
};

/// Looks for the first sample that differs; when none does, the decision to stop did.
Divergence locateIn(Device& device, Device& reference, const DeviceScene& scene,
                    const FirstPixel& pixel)
{
    for (uint32_t first = 0; first < pixel.samples; first += BLOCK_SIZE) {
        uint32_t count = std::min(BLOCK_SIZE, pixel.samples - first);
        Divergence found =
            locateDivergence(device, reference, scene, {pixel.x, pixel.y, 1, 1, first, count});
        if (found.stage != "not reproducible") return found;
    }
    Divergence found;
    found.x = pixel.x;
    found.y = pixel.y;
    found.sample = pixel.samples - 1;
    found.stage = "decision to stop";
    return found;
}

}  // namespace

VerifyResult verifyAdaptive(Device& device, Device& reference, const DeviceScene& scene,
                            const AdaptiveRule& rule, uint32_t tileSize,
                            const std::function<void(double)>& report)
{
    uint32_t width = scene.frame.width;
    uint32_t height = scene.frame.height;
    VerifyResult result;
    result.deviceFilm = Film(width, height);
    result.referenceFilm = Film(width, height);
    device.setScene(scene);
    reference.setScene(scene);
    result.deviceFilm.halvesWeighEqually = rule.rule == ADAPTIVE_CROSSED;
    result.referenceFilm.halvesWeighEqually = rule.rule == ADAPTIVE_CROSSED;
    result.deviceFilm.replicateSize = replicateSizeOf(scene.frame.samplerKind);
    result.referenceFilm.replicateSize = result.deviceFilm.replicateSize;
    Side ours = {device, result.deviceSeconds, result.deviceFilm};
    Side theirs = {reference, result.referenceSeconds, result.referenceFilm};
    std::optional<FirstPixel> first;
    std::vector<TileRequest> all = tilesOf(
        width, height, tileSize, std::min(device.maxTilePixels(), reference.maxTilePixels()));
    const size_t together = looksAtNeighbours(rule) ? all.size() : 1;
    for (size_t done = 0; done < all.size(); done += together) {
        const auto tiles = std::span(all).subspan(done, together);
        ours.render({0, 0, width, height}, tiles, rule);
        report((double(done) + double(together) / 2) / double(all.size()));
        theirs.render({0, 0, width, height}, tiles, rule);
        if (ours.interrupted || theirs.interrupted) {
            result.interrupted = true;
            return result;
        }
        for (size_t t = 0; t < tiles.size(); t++) {
            const TileRequest& tile = tiles[t];
            for (uint32_t i = 0; i < ours.pixels[t].size(); i++) {
                const AdaptivePixel& a = ours.pixels[t][i];
                const AdaptivePixel& b = theirs.pixels[t][i];
                if (sameBits(a, b)) continue;
                result.differingPixels++;
                FirstPixel pixel = {tile.x + i % tile.width, tile.y + i / tile.width,
                                    std::min(samplesOf(a), samplesOf(b))};
                if (!first || std::tie(pixel.y, pixel.x) < std::tie(first->y, first->x)) first = pixel;
            }
        }
        report(double(done + together) / double(all.size()));
    }
    result.differingFilmBits = differingBits(result.deviceFilm, result.referenceFilm);
    if (first) result.first = locateIn(device, reference, scene, *first);
    return result;
}

}  // namespace sahl
