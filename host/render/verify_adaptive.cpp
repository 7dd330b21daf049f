// A device against the reference under adaptive sampling: every sum, every count, every decision.

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

/// A tile on one device, to its end.
struct Side {
    Device& device;
    double& seconds;
    std::vector<AdaptivePixel> pixels = {};
    bool interrupted = false;

    void render(const TileRequest& request, const AdaptiveRule& rule, Film& film)
    {
        auto start = std::chrono::steady_clock::now();
        auto tile = device.beginAdaptive(request, rule);
        pixels.resize(size_t{request.width} * request.height);
        while (tile->runPass().activePixels > 0 && !interrupted)
            interrupted = interruptSignal() != 0;
        tile->read(pixels);
        film.add(request.x, request.y, request.width, request.height, pixels, true);
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
    Side ours = {device, result.deviceSeconds};
    Side theirs = {reference, result.referenceSeconds};
    std::optional<FirstPixel> first;
    std::vector<TileRequest> tiles = tilesOf(
        width, height, tileSize, std::min(device.maxTilePixels(), reference.maxTilePixels()));
    double tilesDone = 0;
    for (const TileRequest& tile : tiles) {
        ours.render(tile, rule, result.deviceFilm);
        theirs.render(tile, rule, result.referenceFilm);
        if (ours.interrupted || theirs.interrupted) {
            result.interrupted = true;
            return result;
        }
        for (uint32_t i = 0; i < ours.pixels.size(); i++) {
            if (sameBits(ours.pixels[i], theirs.pixels[i])) continue;
            result.differingPixels++;
            FirstPixel pixel = {tile.x + i % tile.width, tile.y + i / tile.width,
                                std::min(samplesOf(ours.pixels[i]), samplesOf(theirs.pixels[i]))};
            if (!first || std::tie(pixel.y, pixel.x) < std::tie(first->y, first->x)) first = pixel;
        }
        report(++tilesDone / double(tiles.size()));
    }
    result.differingFilmBits = differingBits(result.deviceFilm, result.referenceFilm);
    if (first) result.first = locateIn(device, reference, scene, *first);
    return result;
}

}  // namespace sahl
