// Light probes of other people's making.
#include "support/assets.h"
#include "support/pictures.h"

#include <algorithm>
#include <cmath>

namespace sahl {
namespace {

using namespace sahl::testing;

struct Probe {
    const char* name;
    uint32_t width, height;
};

const Probe PROBES[] = {
    {"probes/angular/beach_probe.hdr", 640, 640},
    {"probes/latlong/blender_city.exr", 1024, 512},
    {"probes/latlong/blender_courtyard.exr", 1024, 512},
    {"probes/latlong/blender_forest.exr", 1024, 512},
    {"probes/latlong/blender_interior.exr", 1024, 512},
    {"probes/latlong/blender_night.exr", 1024, 512},
    {"probes/latlong/blender_studio.exr", 1024, 512},
    {"probes/latlong/blender_sunrise.exr", 1024, 512},
    {"probes/latlong/blender_sunset.exr", 1024, 512},
    {"probes/latlong/ennis.hdr", 256, 128},
    {"probes/latlong/grace.hdr", 256, 128},
    {"probes/latlong/grace_latlong.exr", 1024, 512},
    {"probes/latlong/museum.exr", 512, 256},
    {"probes/latlong/nvpro_std_env.hdr", 1500, 750},
    {"probes/latlong/pisa.hdr", 256, 128},
    {"probes/latlong/spiaggia_di_mondello_1k.hdr", 1024, 512},
    {"probes/latlong/tungsten_envmap.hdr", 1024, 512},
    {"probes/latlong/uffizi.hdr", 256, 128},
    {"probes/latlong/wells.hdr", 256, 128},
    {"probes/orientation/OrientationLatLong.exr", 1024, 512},
};

TEST(Probes, readImage_readsAllProbes)
{
    SAHL_REQUIRE_ASSET("probes");
    for (const Probe& probe : PROBES) {
        SCOPED_TRACE(probe.name);
        const Image image = readImage(assetFolder() / probe.name);
        EXPECT_EQ(image.width, probe.width);
        EXPECT_EQ(image.height, probe.height);
        const auto [low, high] = std::minmax_element(image.rgb.begin(), image.rgb.end());
        EXPECT_TRUE(std::isfinite(*low) && std::isfinite(*high));
        EXPECT_GT(*high, 0.5f);
    }
}

/// Mean of all three channels over some rows.
double meanOfRows(const Image& image, uint32_t first, uint32_t count)
{
    double sum = 0;
    for (size_t i = size_t{3} * first * image.width; i < size_t{3} * (first + count) * image.width;
         i++) {
        sum += image.rgb[i];
    }
    return sum / (3.0 * count * image.width);
}

// Outdoors the sky is the brighter half.
TEST(Probes, readImage_returnsSkyOnTop)
{
    SAHL_REQUIRE_ASSET("probes");
    for (const char* name :
         {"probes/latlong/pisa.hdr", "probes/latlong/spiaggia_di_mondello_1k.hdr",
          "probes/latlong/blender_sunset.exr", "probes/latlong/uffizi.hdr"}) {
        const Image image = readImage(assetFolder() / name);
        const uint32_t half = image.height / 2;
        EXPECT_GT(meanOfRows(image, 0, half), meanOfRows(image, half, half)) << name;
    }
}

}  // namespace
}  // namespace sahl
