// Which of several ways to compute a picture is the fastest of those that are right?
#pragma once

#include "device/device.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace sahl {

struct Trial {
    std::string name;
    std::unique_ptr<Device> device;     ///< with its scene
    std::vector<double> seconds = {};   ///< that the tile took, by rounds
    uint32_t wrongPixels = 0;           ///< most in any round: other light, digests or counters than expected
    bool isRight() const { return wrongPixels == 0; }
};

/// Renders the tile with all, `rounds` times in turns, so that what else the machine does meets all alike; after a
/// round that makes kernels, whose time does not count. Every picture is compared.
///   expected  what is right: the tile's pixels by the reference
void runTrials(std::span<Trial> trials, const TileRequest& tile, std::span<const PixelBlock> expected, int rounds);

/// Median of the rounds [s].
double medianSeconds(const Trial& trial);

/// The fastest whose every picture was right; nullptr where there is none.
const Trial* fastestRight(std::span<const Trial> trials);

}  // namespace sahl
