// The CPU's executor of the text: renders blocks of samples on all cores.
#pragma once

#include "device/device.h"

namespace sahl::reference {

/// Renders the samples of a tile; see Device::render. `order` is one of ORDER_*.
void renderTile(const DeviceScene& scene, const TileRequest& tile, uint order, unsigned threads,
                std::span<PixelBlock> blocks);

/// See Device::renderFirstHits.
void renderFirstHits(const DeviceScene& scene, const TileRequest& tile, unsigned threads,
                     std::span<FirstHits> pixels);

/// A pass of adaptive sampling over the pixels of `queue`, each counted within the tile: see
/// AdaptiveTile::runPass. `pixels` are those of the whole tile; blocks of the pass before are in the film.
void renderAdaptivePass(const DeviceScene& scene, const TileRequest& tile, const AdaptiveRule& rule,
                        uint order, unsigned threads, std::span<const uint32_t> queue,
                        std::span<AdaptivePixel> pixels);

/// Puts the blocks of these pixels into their film.
void foldBlocks(std::span<const uint32_t> queue, std::span<AdaptivePixel> pixels);

/// Compiler and version, as the "driver" of the CPU.
std::string compilerName();

}  // namespace sahl::reference
