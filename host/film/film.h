// The film: exact per-pixel sums of what a device rendered, and pictures made from them.
#pragma once

#include "image/image.h"
#include "shared/adaptive_types.h"
#include "shared/film_types.h"
#include "util/zero_pages.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sahl {

/// Unsigned fixed point, 64 bits before and 64 after the binary point. Addition is exact and
/// saturates at the top, hence does not depend on the order of the terms.
struct Fixed64x64 {
    uint64_t whole = 0;
    uint64_t fraction = 0;

    static Fixed64x64 fromFloat(float value);    ///< value >= 0; bits below 2^-64 are cut, what is too large saturates
    static Fixed64x64 fromDouble(double value);  ///< the same
    void add(Fixed64x64 other);
    /// Takes away what was added before; what is saturated stays so.
    void subtract(Fixed64x64 other);
    double toDouble() const;
    bool operator==(const Fixed64x64&) const = default;
};

/// One half (A or B) of a pixel.
struct HalfPixel {
    Fixed64x64 sum[3];  ///< radiance of all samples, RGB
    Fixed64x64 sumY2;   ///< of the replicates (Film::replicateSize): samples in it times squared
                        ///< luminance of its mean
    uint32_t samples = 0;
    bool operator==(const HalfPixel&) const = default;
};

/// Work that the device counted for a pixel or a picture. Exact, equal on every device.
struct Counters {
    uint64_t cameraRays = 0;
    uint64_t indirectRays = 0;
    uint64_t shadowRays = 0;
    uint64_t boxTests = 0;
    uint64_t primitiveTests = 0;
    uint64_t bounces = 0;
    uint64_t badSamples = 0;
    uint64_t clamped = 0;  ///< contributions of light that were clamped
    bool operator==(const Counters&) const = default;
    void add(const Counters& other);
};

/// Work that all rays of a pixel's samples took: exact up to 2^32 - 2; 2^32 - 1 stands for that and more.
struct PixelWork {
    uint32_t boxTests = 0;
    uint32_t primitiveTests = 0;
    bool operator==(const PixelWork&) const = default;
    void add(const PixelWork& other);
};

struct Film {
    explicit Film(uint32_t filmWidth = 0, uint32_t filmHeight = 0);

    uint32_t width, height;
    ZeroedVector<HalfPixel> half[2];  ///< A: even blocks (or larger replicates), B: odd; width * height each
    ZeroedVector<uint32_t> digest;   ///< path digest of each pixel
    ZeroedVector<PixelWork> work;    ///< of each pixel
    Counters counters;
    /// The picture is the mean of the halves' means rather than of all samples: where one half's samples
    /// decided how many the other has, any other weight would bias it (the rule `crossed`).
    bool halvesWeighEqually = false;
    /// Samples of a replicate: as many as the sampler ties together (replicateSizeOf). The spread of replicates tells how
    /// noisy the picture is.
    uint32_t replicateSize = 1;
    /// Luminance of the samples of the newest replicate, of each pixel, where replicates are larger than blocks. Not
    /// compared, nor merged: it is of no use once the replicate is whole, or the picture done.
    std::vector<double> newestReplicate;

    /// Adds the blocks of a tile whose samples start at `firstSample`, a multiple of BLOCK_SIZE. Those of a replicate
    /// follow each other, from its first one on.
    void add(uint32_t x, uint32_t y, uint32_t tileWidth, uint32_t tileHeight, uint32_t firstSample,
             std::span<const PixelBlock> blocks, unsigned threads = 1);

    /// Adds pixels of a tile under adaptive sampling, with or without what their newest pass added.
    void add(uint32_t x, uint32_t y, uint32_t tileWidth, uint32_t tileHeight,
             std::span<const AdaptivePixel> pixels, bool withNewestPass);

    /// Adds a film of other samples of the same picture. The result does not depend on the order.
    void merge(const Film& other);

    bool operator==(const Film& other) const;
};

/// Memory that a film of that size takes [bytes].
constexpr uint64_t filmBytes(uint64_t width, uint64_t height, uint32_t replicateSize)
{
    const uint64_t newest = replicateSize > BLOCK_SIZE ? sizeof(double) : 0;
    return width * height * (2 * sizeof(HalfPixel) + sizeof(uint32_t) + sizeof(PixelWork) + newest);
}

/// Mean radiance of each pixel: over all samples, or of both halves' means where these weigh equally and
/// both have samples. Black where there is none.
Image meanImage(const Film& film);

}  // namespace sahl
