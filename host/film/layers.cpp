#include "film/layers.h"

#include "film/film_error.h"

#include <algorithm>
#include <cmath>

namespace sahl {

namespace {

/// Adds channels name.tails[0], ... and fills them pixel by pixel.
template <class Value>
void addChannels(std::vector<ImageChannel>& channels, const std::string& name, const char* tails,
                 std::span<const FirstHits> hits, Value value)
{
    for (int axis = 0; tails[axis] != 0; axis++) {
        ImageChannel channel = {name + "." + tails[axis], {}};
        channel.values.reserve(hits.size());
        for (const FirstHits& pixel : hits) channel.values.push_back(value(pixel, axis));
        channels.push_back(std::move(channel));
    }
}

float share(float sum, uint32_t count)
{
    return count == 0 ? 0.0f : sum / static_cast<float>(count);
}

float unitComponent(const vec3& sum, int axis)
{
    float length = std::sqrt(sum.x * sum.x + sum.y * sum.y + sum.z * sum.z);
    return length > 0 ? sum[axis] / length : 0.0f;
}

float objectOf(uint32_t number, std::span<const uint32_t> starts)
{
    if (number == 0xffffffffu) return 0;
    return static_cast<float>(std::upper_bound(starts.begin(), starts.end(), number) - starts.begin());
}

}  // namespace

std::vector<ImageChannel> firstHitChannels(std::span<const FirstHits> hits, uint32_t samples,
                                           std::span<const uint32_t> objectStarts)
{
    std::vector<ImageChannel> channels;
    addChannels(channels, "albedo", "RGB", hits,
                [&](const FirstHits& p, int axis) { return share(p.albedo[axis], samples); });
    addChannels(channels, "normal", "XYZ", hits,
                [](const FirstHits& p, int axis) { return unitComponent(p.ns, axis); });
    addChannels(channels, "geometricNormal", "XYZ", hits,
                [](const FirstHits& p, int axis) { return unitComponent(p.ng, axis); });
    addChannels(channels, "depth", "Z", hits,
                [](const FirstHits& p, int) { return share(p.depth, p.hits); });
    addChannels(channels, "position", "XYZ", hits,
                [](const FirstHits& p, int axis) { return share(p.position[axis], p.hits); });
    addChannels(channels, "objectId", "Y", hits,
                [&](const FirstHits& p, int) { return objectOf(p.number, objectStarts); });
    addChannels(channels, "materialId", "Y", hits, [](const FirstHits& p, int) {
        return p.material == 0xffffffffu ? 0.0f : static_cast<float>(p.material + 1);
    });
    return channels;
}

std::vector<ImageChannel> statisticsChannels(const Film& film)
{
    std::vector<ImageChannel> channels = {
        {"samples.Y", {}}, {"variance.Y", {}}, {"nodeVisits.Y", {}}, {"primitiveTests.Y", {}}, {"error.Y", {}}};
    const std::vector<double> errors = pixelErrors(film);
    for (size_t i = 0; i < film.half[0].size(); i++) {
        PixelStatistics pixel = pixelStatistics(film, i);
        channels[0].values.push_back(static_cast<float>(pixel.samples));
        channels[1].values.push_back(static_cast<float>(pixel.varianceOfMean));
        channels[2].values.push_back(static_cast<float>(film.work[i].boxTests / 2));
        channels[3].values.push_back(static_cast<float>(film.work[i].primitiveTests));
        channels[4].values.push_back(std::isfinite(errors[i]) ? static_cast<float>(errors[i]) : 0.0f);
    }
    return channels;
}

}  // namespace sahl
