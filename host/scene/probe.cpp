#include "scene/probe.h"

#include "scene/numbers.h"
#include "util/error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sahl {

namespace {

/// Position of a texel's centre in [-1, 1].
double centered(uint32_t i, uint32_t size)
{
    return (2.0 * i + 1) / size - 1;
}

bool isInsideDisc(uint32_t x, uint32_t y, uint32_t size)
{
    double u = centered(x, size), v = centered(y, size);
    return u * u + v * v <= 1;
}

uint32_t texelAt(double position, uint32_t size)
{
    double i = std::floor((position + 1) / 2 * size);
    return static_cast<uint32_t>(std::clamp(i, 0.0, size - 1.0));
}

/// Gives the corners of an angular map the values of the rim.
void fillOutside(std::vector<vec4>& texels, uint32_t size)
{
    for (uint32_t y = 0; y < size; y++) {
        for (uint32_t x = 0; x < size; x++) {
            if (isInsideDisc(x, y, size)) continue;
            double u = centered(x, size), v = centered(y, size);
            double radius = std::sqrt(u * u + v * v);
            uint32_t insideX = x, insideY = y;
            // Half a texel (1/size) at a time from the rim towards the centre: a few steps suffice.
            for (double r = 1; r > 0 && !isInsideDisc(insideX, insideY, size); r -= 1.0 / size) {
                insideX = texelAt(u / radius * r, size);
                insideY = texelAt(v / radius * r, size);
            }
            texels[size_t{y} * size + x] = texels[size_t{insideY} * size + insideX];
        }
    }
}

void checkShape(const Image& picture, uint mapping, const std::string& name)
{
    const bool isSquare = picture.width == picture.height;
    if (mapping == PROBE_ANGULAR && !isSquare) {
        throw badInput(
            "{}: an angular map must be square, this is {} x {}; try the mapping latlong", name,
            picture.width, picture.height);
    }
    if (mapping == PROBE_LATLONG && isSquare && picture.width > 1) {
        warn(fmt::format("{}: a square picture ({} x {}) is read as lat-long; if it is an angular "
                         "map, set the mapping to angular",
                         name, picture.width, picture.height));
    }
}

std::vector<vec4> texelsOf(const Image& picture, double scale, const std::string& name)
{
    uint64_t replaced = 0;
    std::vector<vec4> texels(size_t{picture.width} * picture.height, vec4(0.0f));
    for (size_t i = 0; i < texels.size(); i++) {
        for (size_t k = 0; k < 3; k++) {
            const float value = picture.rgb[3 * i + k];
            const bool usable = std::isfinite(value) && value >= 0;
            if (!usable) replaced++;
            const double scaled = usable ? value * scale : 0;
            if (scaled > std::numeric_limits<float>::max()) {
                throw badInput("{}: scaled by {}, the value {} leaves the range of numbers", name,
                               scale, value);
            }
            texels[i][static_cast<int>(k)] = toFloat(scaled);
        }
    }
    if (replaced > 0) {
        warn(fmt::format("{}: {} values that are negative or not finite became 0", name, replaced));
    }
    return texels;
}

}  // namespace

Probe appendProbe(std::vector<vec4>& texels, const Image& picture, const ProbeLook& look,
                  const std::string& name)
{
    checkShape(picture, look.mapping, name);
    std::vector<vec4> own = texelsOf(picture, look.scale, name);
    if (look.mapping == PROBE_ANGULAR) fillOutside(own, picture.width);
    Probe probe = plainProbe(picture.width, picture.height, look.mapping, look.filter);
    probe.firstTexel = static_cast<uint>(texels.size());
    // The way back from the world: rows of the inverse, which are the columns of the rotation
    probe.axisX = toFloat(look.rotation[0]);
    probe.axisY = toFloat(look.rotation[1]);
    probe.axisZ = toFloat(look.rotation[2]);
    texels.insert(texels.end(), own.begin(), own.end());
    return probe;
}

void setProbe(Scene& scene, const Image& picture, uint mapping, uint filter,
              const std::string& name)
{
    scene.probeTexels.clear();
    scene.background.reset();
    scene.probe = appendProbe(scene.probeTexels, picture, {mapping, filter}, name);
}

uint probeMapping(const std::string& word)
{
    if (word == "latlong") return PROBE_LATLONG;
    if (word == "angular") return PROBE_ANGULAR;
    throw usageError("probe mapping \"{}\" is not known; use latlong or angular", word);
}

uint probeFilter(const std::string& word)
{
    if (word == "nearest") return FILTER_NEAREST;
    if (word == "bilinear") return FILTER_BILINEAR;
    throw usageError("probe filter \"{}\" is not known; use nearest or bilinear", word);
}

}  // namespace sahl
