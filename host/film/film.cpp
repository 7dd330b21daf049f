// Adding blocks and films up, and the mean picture.
#include "film/film.h"

#include "film/replicates.h"
#include "util/error.h"
#include "util/parallel.h"

#include <cassert>
#include <limits>

namespace sahl {

void Counters::add(const Counters& other)
{
    cameraRays += other.cameraRays;
    indirectRays += other.indirectRays;
    shadowRays += other.shadowRays;
    boxTests += other.boxTests;
    primitiveTests += other.primitiveTests;
    bounces += other.bounces;
    badSamples += other.badSamples;
    clamped += other.clamped;
}

namespace {

/// Stays at the largest number rather than to wrap around, so that the order does not matter.
uint32_t saturatingSum(uint32_t a, uint32_t b)
{
    return b > std::numeric_limits<uint32_t>::max() - a ? std::numeric_limits<uint32_t>::max() : a + b;
}

}  // namespace

void PixelWork::add(const PixelWork& other)
{
    boxTests = saturatingSum(boxTests, other.boxTests);
    primitiveTests = saturatingSum(primitiveTests, other.primitiveTests);
}

namespace {

void addBlock(HalfPixel& pixel, const PixelBlock& block)
{
    for (int c = 0; c < 3; c++) pixel.sum[c].add(Fixed64x64::fromFloat(block.sum[c]));
    pixel.samples += block.samplesDone;
}

/// Samples in a replicate times the squared luminance of its mean.
///   luminance  of the sum of its samples
Fixed64x64 squareOfReplicate(double luminance, uint32_t samples)
{
    return Fixed64x64::fromDouble(luminance * luminance / samples);
}

/// Adds a block's samples to the replicate that they belong to, as its square tells.
///   before     samples that the replicate had
///   luminance  of these
void addToReplicate(HalfPixel& pixel, const PixelBlock& block, uint32_t before, double& luminance)
{
    if (block.samplesDone == 0) return;
    if (before == 0) {
        luminance = 0;
    } else {
        pixel.sumY2.subtract(squareOfReplicate(luminance, before));
    }
    luminance += 0.2126 * block.sum[0] + 0.7152 * block.sum[1] + 0.0722 * block.sum[2];
    pixel.sumY2.add(squareOfReplicate(luminance, before + block.samplesDone));
}

Counters countersOf(const PixelBlock& block)
{
    Counters counters;
    counters.cameraRays = block.samplesDone;
    counters.indirectRays = block.indirectRays;
    counters.shadowRays = block.shadowRays;
    counters.boxTests = block.boxTests;
    counters.primitiveTests = block.primitiveTests;
    counters.bounces = block.bounces;
    counters.badSamples = block.badSamples;
    counters.clamped = block.clamped;
    return counters;
}

Fixed64x64 fixedOf(const uvec4& words)
{
    return {uint64_t{words.w} << 32 | words.z, uint64_t{words.y} << 32 | words.x};
}

uint64_t countOf(const uvec2& words)
{
    return uint64_t{words.y} << 32 | words.x;
}

/// Saturates as PixelWork does.
uint32_t smallCount(const uvec2& words)
{
    return words.y != 0 ? std::numeric_limits<uint32_t>::max() : words.x;
}

PixelWork workOf(const FilmPixel& pixel)
{
    return {smallCount(pixel.boxTests), smallCount(pixel.primitiveTests)};
}

void addSums(HalfPixel& pixel, const FilmSums& sums, uint32_t samples)
{
    pixel.sum[0].add(fixedOf(sums.red));
    pixel.sum[1].add(fixedOf(sums.green));
    pixel.sum[2].add(fixedOf(sums.blue));
    pixel.sumY2.add(fixedOf(sums.y2));
    pixel.samples += samples;
}

Counters countersOf(const FilmPixel& pixel)
{
    Counters counters;
    counters.cameraRays = uint64_t{pixel.samplesA} + pixel.samplesB;
    counters.indirectRays = countOf(pixel.indirectRays);
    counters.shadowRays = countOf(pixel.shadowRays);
    counters.boxTests = countOf(pixel.boxTests);
    counters.primitiveTests = countOf(pixel.primitiveTests);
    counters.bounces = countOf(pixel.bounces);
    counters.badSamples = pixel.badSamples;
    counters.clamped = countOf(pixel.clamped);
    return counters;
}

}  // namespace

Film::Film(uint32_t filmWidth, uint32_t filmHeight) : width(filmWidth), height(filmHeight)
{
    const size_t pixels = size_t{width} * height;
    for (ZeroedVector<HalfPixel>& pixelsOfHalf : half) pixelsOfHalf.resize(pixels);
    digest.resize(pixels);
    work.resize(pixels);
}

void Film::add(uint32_t x, uint32_t y, uint32_t tileWidth, uint32_t tileHeight,
               uint32_t firstSample, std::span<const PixelBlock> blocks, unsigned threads)
{
    assert(x <= width && tileWidth <= width - x && y <= height && tileHeight <= height - y);
    assert(blocks.size() == size_t{tileWidth} * tileHeight);
    assert(firstSample % BLOCK_SIZE == 0);
    const bool largeReplicates = replicateSize > BLOCK_SIZE;
    ZeroedVector<HalfPixel>& target = half[firstSample / blockOfReplicates(replicateSize) % 2];
    if (largeReplicates) newestReplicate.resize(digest.size());
    std::vector<Counters> counted(tileHeight);
    parallelFor(tileHeight, threads, [&](size_t row) {
        for (uint32_t column = 0; column < tileWidth; column++) {
            const PixelBlock& block = blocks[row * tileWidth + column];
            assert(block.status == BLOCK_IDLE && block.samplesDone <= BLOCK_SIZE);
            const size_t pixel = (y + row) * width + x + column;
            addBlock(target[pixel], block);
            if (largeReplicates) {
                addToReplicate(target[pixel], block, firstSample % replicateSize, newestReplicate[pixel]);
            } else {
                target[pixel].sumY2.add(Fixed64x64::fromFloat(block.sumY2));
            }
            digest[pixel] += block.digest;
            work[pixel].add({block.boxTests, block.primitiveTests});
            counted[row].add(countersOf(block));
        }
    });
    for (const Counters& ofRow : counted) counters.add(ofRow);
}

void Film::add(uint32_t x, uint32_t y, uint32_t tileWidth, uint32_t tileHeight,
               std::span<const AdaptivePixel> pixels, bool withNewestPass)
{
    assert(x <= width && tileWidth <= width - x && y <= height && tileHeight <= height - y);
    assert(pixels.size() == size_t{tileWidth} * tileHeight);
    for (uint32_t row = 0; row < tileHeight; row++) {
        for (uint32_t column = 0; column < tileWidth; column++) {
            const AdaptivePixel& from = pixels[size_t{row} * tileWidth + column];
            const size_t pixel = size_t{y + row} * width + x + column;
            addSums(half[0][pixel], from.film.sumsA, from.film.samplesA);
            addSums(half[1][pixel], from.film.sumsB, from.film.samplesB);
            digest[pixel] += from.film.digest;
            work[pixel].add(workOf(from.film));
            counters.add(countersOf(from.film));
            if (!withNewestPass || from.block.samplesDone == 0) continue;
            add(x + column, y + row, 1, 1, from.firstSample, {&from.block, 1});
        }
    }
}

bool Film::operator==(const Film& other) const
{
    return width == other.width && height == other.height && half[0] == other.half[0] && half[1] == other.half[1] &&
           digest == other.digest && work == other.work && counters == other.counters &&
           halvesWeighEqually == other.halvesWeighEqually && replicateSize == other.replicateSize;
}

void Film::merge(const Film& other)
{
    if (width != other.width || height != other.height) {
        throw badInput("films of {} x {} and {} x {} pixels cannot be merged", width, height,
                       other.width, other.height);
    }
    if (replicateSize != other.replicateSize) {
        throw badInput("films of different samplers cannot be merged");
    }
    for (int h = 0; h < 2; h++) {
        for (size_t i = 0; i < half[h].size(); i++) {
            HalfPixel& pixel = half[h][i];
            const HalfPixel& added = other.half[h][i];
            for (int c = 0; c < 3; c++) pixel.sum[c].add(added.sum[c]);
            pixel.sumY2.add(added.sumY2);
            pixel.samples += added.samples;
        }
    }
    for (size_t i = 0; i < digest.size(); i++) digest[i] += other.digest[i];
    for (size_t i = 0; i < work.size(); i++) work[i].add(other.work[i]);
    counters.add(other.counters);
}

namespace {

/// Rounded to double by toDouble() and by the division.
double meanOf(const Fixed64x64& sum, uint64_t samples)
{
    return sum.toDouble() / static_cast<double>(samples);
}

}  // namespace

Image meanImage(const Film& film)
{
    Image image;
    image.width = film.width;
    image.height = film.height;
    image.rgb.resize(film.digest.size() * 3);
    for (size_t i = 0; i < film.digest.size(); i++) {
        const HalfPixel& a = film.half[0][i];
        const HalfPixel& b = film.half[1][i];
        const uint64_t samples = uint64_t{a.samples} + b.samples;
        if (samples == 0) continue;
        const bool apart = film.halvesWeighEqually && a.samples > 0 && b.samples > 0;
        for (size_t c = 0; c < 3; c++) {
            // The sum is exact; the mean is rounded to double, then to float.
            Fixed64x64 sum = a.sum[c];
            sum.add(b.sum[c]);
            const double mean =
                apart ? (meanOf(a.sum[c], a.samples) + meanOf(b.sum[c], b.samples)) / 2
                      : meanOf(sum, samples);
            image.rgb[3 * i + c] = static_cast<float>(mean);
        }
    }
    return image;
}

}  // namespace sahl
