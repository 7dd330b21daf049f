#include "render/verify.h"

#include "film/replicates.h"
#include "render/render.h"
#include "util/interrupt.h"

#include <bit>
#include <chrono>
#include <cmath>
#include <cstring>

namespace sahl {

namespace {

/// Renders a tile and returns the seconds it took.
double timedRender(Device& device, const TileRequest& tile, std::vector<PixelBlock>& blocks)
{
    auto start = std::chrono::steady_clock::now();
    device.render(tile, blocks);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

PixelBlock renderPixel(Device& device, const TileRequest& pixel)
{
    std::vector<PixelBlock> block(1);
    device.render(pixel, block);
    return block[0];
}

std::string stageOf(const PixelBlock& a, const PixelBlock& b)
{
    if (a.digest != b.digest) return "hit";
    if (std::memcmp(&a.sum, &b.sum, sizeof(a.sum)) != 0 || a.sumY2 != b.sumY2) return "light";
    return "counters";
}

uint64_t differingBits(const Fixed64x64& a, const Fixed64x64& b)
{
    return static_cast<uint64_t>(std::popcount(a.whole ^ b.whole) + std::popcount(a.fraction ^ b.fraction));
}

bool comesBefore(const TileRequest& a, const TileRequest& b)
{
    return a.y != b.y ? a.y < b.y : a.x < b.x;
}

}  // namespace

bool sameBits(const PixelBlock& a, const PixelBlock& b) { return std::memcmp(&a, &b, sizeof(a)) == 0; }

Divergence locateDivergence(Device& device, Device& reference, const DeviceScene& scene, TileRequest pixel)
{
    Divergence found;
    found.x = pixel.x;
    found.y = pixel.y;
    auto differs = [&] {
        found.device = renderPixel(device, pixel);
        found.reference = renderPixel(reference, pixel);
        return !sameBits(found.device, found.reference);
    };

    uint32_t samples = pixel.sampleCount;
    pixel.sampleCount = 1;
    while (!differs()) {
        if (pixel.sampleCount == samples) {
            found.stage = "not reproducible";
            return found;
        }
        pixel.sampleCount++;
    }
    found.sample = pixel.firstSample + pixel.sampleCount - 1;

    DeviceScene shorter = scene;
    for (uint32_t bounces = 0; bounces <= scene.frame.maxBounces; bounces++) {
        shorter.frame.maxBounces = bounces;
        device.setScene(shorter);
        reference.setScene(shorter);
        found.bounce = bounces;
        if (differs()) break;
    }
    found.stage = stageOf(found.device, found.reference);
    device.setScene(scene);
    reference.setScene(scene);
    return found;
}

uint64_t differingBits(const Film& a, const Film& b)
{
    uint64_t bits = 0;
    for (int half = 0; half < 2; half++) {
        for (size_t i = 0; i < a.half[half].size(); i++) {
            const HalfPixel& p = a.half[half][i];
            const HalfPixel& q = b.half[half][i];
            for (int c = 0; c < 3; c++) bits += differingBits(p.sum[c], q.sum[c]);
            bits += differingBits(p.sumY2, q.sumY2);
        }
    }
    return bits;
}

VerifyResult verifyDevice(Device& device, Device& reference, const DeviceScene& scene, uint32_t spp,
                          uint32_t tileSize, const std::function<void(double)>& report)
{
    uint32_t width = scene.frame.width;
    uint32_t height = scene.frame.height;
    VerifyResult result;
    result.deviceFilm = Film(width, height);
    result.referenceFilm = Film(width, height);
    result.deviceFilm.replicateSize = replicateSizeOf(scene.frame.samplerKind);
    result.referenceFilm.replicateSize = result.deviceFilm.replicateSize;
    device.setScene(scene);
    reference.setScene(scene);

    std::vector<TileRequest> tiles =
        tilesOf(width, height, tileSize, std::min(device.maxTilePixels(), reference.maxTilePixels()));
    std::vector<bool> differs(size_t{width} * height);
    std::optional<TileRequest> first;  // one pixel, in its first differing block
    double stepsDone = 0;
    double steps = double(tiles.size()) * std::ceil(double(spp) / BLOCK_SIZE);
    for (uint32_t done = 0; done < spp && !result.interrupted; done += BLOCK_SIZE) {
        for (TileRequest tile : tiles) {
            if (interruptSignal() != 0) {
                result.interrupted = true;
                break;
            }
            tile.firstSample = done;
            tile.sampleCount = std::min(BLOCK_SIZE, spp - done);
            std::vector<PixelBlock> ours(size_t{tile.width} * tile.height);
            std::vector<PixelBlock> theirs(ours.size());
            result.deviceSeconds += timedRender(device, tile, ours);
            result.referenceSeconds += timedRender(reference, tile, theirs);
            result.deviceFilm.add(tile.x, tile.y, tile.width, tile.height, tile.firstSample, ours);
            result.referenceFilm.add(tile.x, tile.y, tile.width, tile.height, tile.firstSample, theirs);
            for (uint32_t i = 0; i < ours.size(); i++) {
                if (sameBits(ours[i], theirs[i])) continue;
                TileRequest pixel = tile;
                pixel.x += i % tile.width;
                pixel.y += i / tile.width;
                pixel.width = pixel.height = 1;
                differs[size_t{pixel.y} * width + pixel.x] = true;
                if (!first || comesBefore(pixel, *first)) first = pixel;
            }
            report(++stepsDone / steps);
        }
    }
    for (bool pixel : differs) result.differingPixels += pixel ? 1 : 0;
    result.differingFilmBits = differingBits(result.deviceFilm, result.referenceFilm);
    if (first) result.first = locateDivergence(device, reference, scene, *first);
    return result;
}

Image differenceImage(const Film& a, const Film& b)
{
    Image difference = meanImage(a);
    Image other = meanImage(b);
    for (size_t i = 0; i < difference.rgb.size(); i++) {
        difference.rgb[i] = std::fabs(difference.rgb[i] - other.rgb[i]);
    }
    return difference;
}

}  // namespace sahl
