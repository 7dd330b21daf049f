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

/// Compiler and version, as the "driver" of the CPU.
std::string compilerName();

}  // namespace sahl::reference
