#include "reference/render_tile.h"

#include "reference/kernel.h"
#include "util/parallel.h"

#include <algorithm>

namespace sahl::reference {

namespace {

template <class Kernel>
Kernel kernelFor(const DeviceScene& scene)
{
    Kernel kernel = {};
    kernel.nodes = scene.nodes;
    kernel.wideNodes = scene.wide.nodes;
    kernel.primitives = scene.primitives;
    kernel.triangleCorners = scene.triangleCorners;
    kernel.materials = scene.materials;
    kernel.lights = scene.lights;
    kernel.aliasEntries = scene.aliasEntries;
    kernel.textures = scene.textures;
    kernel.textureTexels = scene.textureTexels;
    kernel.probeTexels = scene.probeTexels;
    kernel.instances = scene.instances;
    kernel.frame = scene.frame;
    return kernel;
}

/// A Kernel as a type to be named.
template <class K>
struct KernelType {
    using Kernel = K;
};

template <uint Width, class Action>
void withKernelOfWidth(const DeviceScene& scene, uint order, Action action)
{
    switch (order) {
    case ORDER_LEFT_FIRST:
        return action(KernelType<Kernel<ORDER_LEFT_FIRST, true, true, Width>>{});
    case ORDER_RIGHT_FIRST:
        return action(KernelType<Kernel<ORDER_RIGHT_FIRST, true, true, Width>>{});
    default:
        break;
    }
    if (!scene.textures.empty())
        return action(KernelType<Kernel<ORDER_NEAR_FIRST, true, true, Width>>{});
    if (scene.instances.empty())
        return action(KernelType<Kernel<ORDER_NEAR_FIRST, false, false, Width>>{});
    action(KernelType<Kernel<ORDER_NEAR_FIRST, true, false, Width>>{});
}

/// Calls `action` with the KernelType that leaves out what the scene has not.
template <class Action>
void withKernel(const DeviceScene& scene, const Walk& walk, Action action)
{
    if (walk.nodeWidth == 4)
        withKernelOfWidth<4>(scene, walk.order, action);
    else
        withKernelOfWidth<2>(scene, walk.order, action);
}

}  // namespace

void traceRays(const DeviceScene& scene, std::span<const TraceRay> rays, bool anyHit,
               const Walk& walk, unsigned threads, std::span<TraceHit> hits)
{
    constexpr size_t CHUNK = 4096;
    withKernel(scene, walk, [&]<class Type>(Type) {
        parallelFor((rays.size() + CHUNK - 1) / CHUNK, threads, [&](size_t chunk) {
            auto kernel = kernelFor<typename Type::Kernel>(scene);
            const size_t end = std::min(rays.size(), (chunk + 1) * CHUNK);
            for (size_t i = chunk * CHUNK; i < end; i++) hits[i] = kernel.traceRay(rays[i], anyHit);
        });
    });
}

void renderAdaptivePass(const DeviceScene& scene, const TileRequest& tile, const AdaptiveRule& rule,
                        uint pass, const Walk& walk, unsigned threads,
                        std::span<const uint32_t> queue, std::span<AdaptivePixel> pixels)
{
    constexpr size_t CHUNK = 64;  // pixels, since making a kernel is not free
    withKernel(scene, walk, [&]<class Type>(Type) {
        parallelFor((queue.size() + CHUNK - 1) / CHUNK, threads, [&](size_t chunk) {
            auto kernel = kernelFor<typename Type::Kernel>(scene);
            size_t first = chunk * CHUNK;
            for (uint32_t i : queue.subspan(first, std::min(CHUNK, queue.size() - first))) {
                kernel.renderBlock(tile.x + i % tile.width, tile.y + i / tile.width, pass, rule,
                                   pixels[i]);
            }
        });
    });
}

void foldBlocks(std::span<const uint32_t> queue, std::span<AdaptivePixel> pixels)
{
    Kernel<> kernel = {};
    for (uint32_t i : queue) {
        kernel.addBlock(pixels[i].block, pixels[i].firstSample, pixels[i].film);
        pixels[i].block = kernel.emptyBlock();
    }
}

void estimatePixels(const AdaptiveRule& rule, const EstimatesView& view,
                    std::span<const uint32_t> queue, std::span<const AdaptivePixel> pixels)
{
    Kernel<> kernel = {};
    for (uint32_t i : queue) {
        FilmPixel film = pixels[i].film;
        kernel.addBlock(pixels[i].block, pixels[i].firstSample, film);
        const size_t place =
            size_t{view.y + i / view.tileWidth} * view.width + view.x + i % view.tileWidth;
        view.estimates[place] = kernel.estimateOf(rule, film);
    }
}

void decidePixels(const AdaptiveRule& rule, const AdaptiveFloors& floors, uint passes,
                  const EstimatesView& view, std::span<const uint32_t> queue,
                  std::span<AdaptivePixel> pixels)
{
    Kernel<> kernel = {};
    kernel.estimates = view.estimates;
    kernel.pictureWidth = view.width;
    for (uint32_t i : queue) {
        AdaptivePixel& pixel = pixels[i];
        const uint x = view.x + i % view.tileWidth;
        const uint y = view.y + i / view.tileWidth;
        if (rule.rule == ADAPTIVE_CROSSED) {
            const uvec2 wanted = kernel.wantedByCrossed(rule, floors, x, y);
            pixel.wantedA = wanted.x;
            pixel.wantedB = wanted.y;
            pixel.state = kernel.stateByCrossed(rule, wanted.x, wanted.y, passes);
        } else {
            const uint n = kernel.samplesOf(pixel.film) + pixel.block.samplesDone;
            pixel.state = kernel.stateByJoint(rule, floors, x, y, n);
        }
    }
}

std::vector<uint32_t> advanceHalves(const AdaptiveRule& rule, uint pass,
                                    std::span<const uint32_t> queue,
                                    std::span<AdaptivePixel> pixels)
{
    Kernel<> kernel = {};
    std::vector<uint32_t> goingOn;
    for (uint32_t i : queue) {
        AdaptivePixel& pixel = pixels[i];
        pixel.state = kernel.stateByCrossed(rule, pixel.wantedA, pixel.wantedB, pass + 1);
        if (kernel.halfGoesOn(rule, pixel.wantedA, pixel.wantedB, pass)) goingOn.push_back(i);
    }
    return goingOn;
}

std::vector<uint32_t> takersOf(const AdaptiveRule& rule, uint pass,
                               std::span<const AdaptivePixel> pixels)
{
    Kernel<> kernel = {};
    std::vector<uint32_t> takers;
    for (uint32_t i = 0; i < pixels.size(); i++) {
        const AdaptivePixel& pixel = pixels[i];
        const bool lacks = pass % 2 == 0 ? kernel.lacksInA(rule, pixel.wantedA, pass)
                                         : kernel.lacksInB(rule, pixel.wantedB, pass);
        if (lacks) takers.push_back(i);
    }
    return takers;
}

void renderFirstHits(const DeviceScene& scene, const TileRequest& tile, const Walk& walk,
                     unsigned threads, std::span<FirstHits> pixels)
{
    withKernel(scene, walk, [&]<class Type>(Type) {
        parallelFor(tile.height, threads, [&](size_t row) {
            auto kernel = kernelFor<typename Type::Kernel>(scene);
            for (uint x = 0; x < tile.width; x++) {
                FirstHits sums = kernel.noFirstHits();
                for (uint i = 0; i < tile.sampleCount; i++) {
                    kernel.renderFirstHit(tile.x + x, tile.y + static_cast<uint>(row),
                                          tile.firstSample + i, i == 0, sums);
                }
                pixels[row * tile.width + x] = sums;
            }
        });
    });
}

void renderTile(const DeviceScene& scene, const TileRequest& tile, const Walk& walk,
                unsigned threads, std::span<PixelBlock> blocks)
{
    withKernel(scene, walk, [&]<class Type>(Type) {
        parallelFor(tile.height, threads, [&](size_t row) {
            auto kernel = kernelFor<typename Type::Kernel>(scene);
            for (uint x = 0; x < tile.width; x++) {
                PixelBlock block = {};
                for (uint i = 0; i < tile.sampleCount; i++) {
                    kernel.renderSample(tile.x + x, tile.y + static_cast<uint>(row),
                                        tile.firstSample + i, block);
                }
                blocks[row * tile.width + x] = block;
            }
        });
    });
}

std::string compilerName()
{
#if defined(__clang__)
    return "clang " __clang_version__;
#else
    return "gcc " __VERSION__;
#endif
}

}  // namespace sahl::reference
