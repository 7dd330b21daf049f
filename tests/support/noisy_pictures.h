// Pictures of known noise with what Sahl's files say about it.
#pragma once

#include "compare/compare.h"

#include <random>

namespace sahl::testing {

/// Grey pixels, each the mean of `spp` samples that `draw` gives, with its variance as the film has
/// it.
template <class Draw>
LoadedPicture noisyPicture(uint32_t width, uint32_t height, uint32_t spp, Draw draw)
{
    LoadedPicture picture;
    picture.image = {width, height, {}};
    for (uint32_t i = 0; i < width * height; i++) {
        double sum = 0, squares = 0;
        for (uint32_t k = 0; k < spp; k++) {
            const double sample = draw();
            sum += sample;
            squares += sample * sample;
        }
        const double mean = sum / spp;
        const double variance = spp > 1 ? (squares / spp - mean * mean) / (spp - 1) : 0;
        for (int c = 0; c < 3; c++) picture.image.rgb.push_back(static_cast<float>(mean));
        picture.variance.push_back(static_cast<float>(std::max(0.0, variance)));
        picture.samples.push_back(static_cast<float>(spp));
    }
    return picture;
}

/// The same picture with more light, as an error of energy would give it.
inline LoadedPicture brightened(LoadedPicture picture, double factor)
{
    for (float& value : picture.image.rgb) value = static_cast<float>(value * factor);
    for (float& value : picture.variance) value = static_cast<float>(value * factor * factor);
    return picture;
}

/// The same picture with the same noise, and a difference everywhere.
inline LoadedPicture shifted(LoadedPicture picture, double difference)
{
    for (float& value : picture.image.rgb) value = static_cast<float>(value + difference);
    return picture;
}

/// No noise: grey pixels with a stated variance.
inline LoadedPicture statedPicture(uint32_t width, uint32_t height, float value, float variance,
                                   float samples)
{
    LoadedPicture picture;
    const size_t pixels = size_t{width} * height;
    picture.image = {width, height, std::vector<float>(3 * pixels, value)};
    picture.variance.assign(pixels, variance);
    picture.samples.assign(pixels, samples);
    return picture;
}

}  // namespace sahl::testing
