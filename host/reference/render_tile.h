// The CPU's executor of the text: renders blocks of samples on all cores.
#pragma once

#include "device/device.h"
#include "shared/bindings.h"

namespace sahl::reference {

/// How rays walk through a tree. None of it changes a hit.
struct Walk {
    uint order = ORDER_NEAR_FIRST;  ///< one of ORDER_*
    uint nodeWidth = 2;  ///< of the trees that scenes are given with: see walkedScene()
};

/// Renders the samples of a tile; see Device::render. 
void renderTile(const DeviceScene& scene, const TileRequest& tile, const Walk& walk, unsigned threads,
                std::span<PixelBlock> blocks);

/// See Device::renderFirstHits.
void renderFirstHits(const DeviceScene& scene, const TileRequest& tile, const Walk& walk, unsigned threads,
                     std::span<FirstHits> pixels);

/// See Device::traceRays.
void traceRays(const DeviceScene& scene, std::span<const TraceRay> rays, bool anyHit, const Walk& walk,
               unsigned threads, std::span<TraceHit> hits);

/// Pass `pass` of adaptive sampling over the pixels of `queue`, each counted within the tile: see
/// AdaptiveTile::runPass. `pixels` are those of the whole tile; blocks of the pass before are in the film.
void renderAdaptivePass(const DeviceScene& scene, const TileRequest& tile, const AdaptiveRule& rule,
                        uint pass, const Walk& walk, unsigned threads, std::span<const uint32_t> queue,
                        std::span<AdaptivePixel> pixels);

/// Puts the blocks of these pixels into their film.
void foldBlocks(std::span<const uint32_t> queue, std::span<AdaptivePixel> pixels);

/// A tile's place in a picture whose pixels say what they know of their noise. x, y: of the tile in it.
struct EstimatesView {
    std::span<PixelEstimate> estimates;  ///< of the picture, top row first
    uint32_t width = 0;                  ///< of the picture [pixels]
    uint32_t x = 0, y = 0, tileWidth = 0;
};

/// Writes what these pixels say of themselves, their newest blocks included.
void estimatePixels(const AdaptiveRule& rule, const EstimatesView& view, std::span<const uint32_t> queue,
                    std::span<const AdaptivePixel> pixels);

/// Decides by the estimates who goes on: sets `state`, and under `crossed` what is wanted of each half.
///   passes  that these pixels have had
void decidePixels(const AdaptiveRule& rule, const AdaptiveFloors& floors, uint passes,
                  const EstimatesView& view, std::span<const uint32_t> queue,
                  std::span<AdaptivePixel> pixels);

/// Under `crossed`, after its decision: sets `state` after pass `pass`, and returns which of the queue's
/// pixels take block pass + 2 as well.
std::vector<uint32_t> advanceHalves(const AdaptiveRule& rule, uint pass, std::span<const uint32_t> queue,
                                    std::span<AdaptivePixel> pixels);

/// Those of the pixels whose half A (even passes) or B (odd ones) takes block `pass`.
std::vector<uint32_t> takersOf(const AdaptiveRule& rule, uint pass, std::span<const AdaptivePixel> pixels);

/// Compiler and version, as the "driver" of the CPU.
std::string compilerName();

}  // namespace sahl::reference
