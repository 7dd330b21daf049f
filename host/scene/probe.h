// Light probes: pictures of the light from all directions, made ready for the device.
#pragma once

#include "image/image.h"
#include "scene/scene.h"

namespace sahl {

/// How a picture becomes a probe.
struct ProbeLook {
    uint mapping = PROBE_LATLONG;           ///< PROBE_*
    uint filter = FILTER_BILINEAR;          ///< FILTER_*
    double scale = 1;                       ///< times every value, >= 0
    glm::dmat3 rotation = glm::dmat3(1.0);  ///< from the picture's directions to the world's
};

/// Appends the texels of `picture` to `texels` and returns the probe that looks them up. Magnitudes
/// below 1e-30 become 0; so do values that are negative or not finite, with one warning that counts
/// them. In an angular map, texels whose centre lies outside the unit disc stand for no direction;
/// each takes the value of the nearest texel towards the centre that lies inside, so that bilinear
/// filtering at the rim reads sensible neighbours. A square picture taken as lat-long gets a
/// warning. Throws badInput naming `name` when an angular map is not square or a scaled value
/// overflows.
Probe appendProbe(std::vector<vec4>& texels, const Image& picture, const ProbeLook& look,
                  const std::string& name);

/// Makes `picture` the scene's environment, neither scaled nor turned, in place of all its probes.
void setProbe(Scene& scene, const Image& picture, uint mapping, uint filter,
              const std::string& name);

/// PROBE_* for "latlong" or "angular", FILTER_* for "nearest" or "bilinear"; usage error otherwise.
uint probeMapping(const std::string& word);
uint probeFilter(const std::string& word);

/// A photographer's studio as a lat-long picture (Debevec's orientation, see PROBE_LATLONG): a
/// large warm softbox, a cooler fill, a rim light behind, walls in a gradient and a floor that
/// bounces.
Image makeStudioProbe(uint32_t width, uint32_t height);

constexpr uint32_t STUDIO_WIDTH = 256, STUDIO_HEIGHT = 128;

/// Two interiors in the same orientation, the apse at -Z: a dim cathedral, red, with windows and lamps
/// that are 100 times brighter than its walls; a warm basilica of stone under a dome.
Image makeCathedralProbe(uint32_t width, uint32_t height);
Image makeBasilicaProbe(uint32_t width, uint32_t height);

constexpr uint32_t CHURCH_WIDTH = 768, CHURCH_HEIGHT = 384;

/// The names that "builtin" takes in a scene file, and their pictures.
inline constexpr std::initializer_list<const char*> BUILTIN_PROBES = {"studio", "cathedral", "basilica"};
Image makeBuiltinProbe(const std::string& name);

}  // namespace sahl
