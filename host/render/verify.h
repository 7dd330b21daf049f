// Does a device compute what the text says? Its film against the CPU reference's, bit for bit.
#pragma once

#include "device/device.h"
#include "film/film.h"

#include <functional>
#include <optional>
#include <string>

namespace sahl {

/// Where two devices part: the first differing pixel (top row first), its first differing sample and
/// the bounce at which that sample's path differs first.
struct Divergence {
    uint32_t x = 0, y = 0;
    uint32_t sample = 0;  ///< within the pixel
    uint32_t bounce = 0;  ///< 0: what the camera ray meets
    std::string stage;    ///< "hit" (the paths differ), "light" (only the radiance), "counters", or
                          ///< "not reproducible" when the pixel alone renders the same
    PixelBlock device = {};     ///< the block up to and including that sample
    PixelBlock reference = {};
};

struct VerifyResult {
    Film deviceFilm;
    Film referenceFilm;
    uint64_t differingPixels = 0;     ///< film integers, digests or counters of the pixel
    uint64_t differingFilmBits = 0;   ///< bits of the film's integers, over all pixels
    std::optional<Divergence> first;  ///< absent when nothing differs
    bool interrupted = false;
    double deviceSeconds = 0;
    double referenceSeconds = 0;
    bool equal() const { return differingPixels == 0 && deviceFilm == referenceFilm; }
};

/// All that is compared of a pixel: light, digest, counters.
bool sameBits(const PixelBlock& a, const PixelBlock& b);

/// Renders the scene on both devices (their scenes are set here) and compares every block.
/// `report` is called with the fraction done.
VerifyResult verifyDevice(Device& device, Device& reference, const DeviceScene& scene, uint32_t spp,
                          uint32_t tileSize, const std::function<void(double)>& report);

/// The same under adaptive sampling by a rule: counts and decisions are compared as well. stage may also be
/// "decision to stop", when all samples that both took of the pixel are the same.
VerifyResult verifyAdaptive(Device& device, Device& reference, const DeviceScene& scene,
                            const AdaptiveRule& rule, uint32_t tileSize,
                            const std::function<void(double)>& report);

/// Renders one pixel's block again with fewer samples and bounces, to find the first ones that differ.
/// Leaves both devices with the scene as given.
Divergence locateDivergence(Device& device, Device& reference, const DeviceScene& scene, TileRequest pixel);

/// Bits of the films' integers that differ.
uint64_t differingBits(const Film& a, const Film& b);

/// Absolute difference of the two films' mean pictures.
Image differenceImage(const Film& a, const Film& b);

}  // namespace sahl
